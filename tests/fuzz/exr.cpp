// EXR files: refused with a reason, or read whole. OpenImageIO and OpenEXR are
// not instrumented, so this is about our choice of layers and windows, and
// about what the libraries hand on.

#include "tests/core/temporary_folder.hpp"
#include "tests/fuzz/codecs.hpp"
#include "tests/fuzz/limited_memory.hpp"

using namespace lightwalk;
using namespace lightwalk::fuzz;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const tests::TemporaryFolder folder;
  const std::string path = folder / "a.exr";
  tests::store(path, text_of(data, size));

  const LimitedMemory limited;
  RenderResult result;
  const std::string error = lightwalk_image_codecs()->read_exr(path, result);
  if (!error.empty()) return 0;
  const Image& radiance = result.radiance;
  const Image& variance = result.variance;
  check_pixels(radiance.width, radiance.height, radiance.pixels.size());
  if (variance.pixels.empty()) return 0;
  check_pixels(variance.width, variance.height, variance.pixels.size());
  expect(
      variance.width == radiance.width && variance.height == radiance.height,
      "the variance is as large as the picture");
  return 0;
}
