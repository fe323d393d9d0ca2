// PFM files: refused with a reason, or read, and then written and read again
// to the same bits.

#include <cstring>

#include "common/image/pfm.hpp"
#include "tests/fuzz/decoded.hpp"
#include "tests/fuzz/limited_memory.hpp"

using namespace lightwalk;
using namespace lightwalk::fuzz;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const LimitedMemory limited;
  const std::optional<RenderResult> read = decoded(decode_pfm, data, size);
  if (!read) return 0;
  const Image& image = read->radiance;
  const std::size_t count = image.pixels.size();
  expect(count * sizeof(float) < size, "every pixel was in the file");

  const RenderResult written = decode_pfm(encode_pfm(*read));
  const Image& again = written.radiance;
  expect(again.width == image.width && again.height == image.height,
         "the size is kept");
  expect(std::memcmp(again.pixels.data(), image.pixels.data(),
                     count * sizeof(Vec3)) == 0,
         "the pixels are kept to the bit");
  expect(written.variance.pixels.size() == read->variance.pixels.size(),
         "the variance is kept");
  return 0;
}
