// The course's PPM files: refused with a reason, or read, and then written and
// read again, to half a step of the stored numbers.

#include <cmath>
#include <limits>

#include "common/image/ppm.hpp"
#include "tests/fuzz/decoded.hpp"
#include "tests/fuzz/limited_memory.hpp"

using namespace lightwalk;
using namespace lightwalk::fuzz;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const LimitedMemory limited;
  const std::optional<RenderResult> read = decoded(decode_ppm, data, size);
  if (!read) return 0;
  const Image& image = read->radiance;
  const std::size_t count = image.pixels.size();
  expect(6 * count < size + 6, "every pixel was in the file");
  for (const Vec3& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) {
      expect(std::isfinite(pixel[c]) && pixel[c] >= 0,
             "a value is finite and not negative", text(pixel));
    }
  }

  const Image again = decode_ppm(encode_ppm(image)).radiance;
  expect(again.width == image.width && again.height == image.height,
         "the size is kept");
  const double largest = static_cast<double>(max_value(image));
  const double step = (largest > 0 ? largest : 1) / 65535;
  // A division and a product are rounded, to floats that may be the smallest.
  const double rounding =
      largest * 0x1p-22 +
      2 * static_cast<double>(std::numeric_limits<float>::denorm_min());
  for (std::size_t i = 0; i < count; ++i) {
    for (int c = 0; c < 3; ++c) {
      const double change = static_cast<double>(again.pixels[i][c]) -
                            static_cast<double>(image.pixels[i][c]);
      expect(std::abs(change) <= 0.5 * step + rounding,
             "a value is kept to half a step",
             text(image.pixels[i]) + " becomes " + text(again.pixels[i]));
    }
  }
  return 0;
}
