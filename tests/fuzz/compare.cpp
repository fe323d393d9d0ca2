// Comparing two pictures of any numbers: not a number, infinite, negative,
// without noise or with noise beyond measure. What is not finite is never the
// same; a finite picture is the same as itself.

#include "compare/comparison.hpp"

#include <fuzzer/FuzzedDataProvider.h>

#include <cstring>

#include "compare/verdict.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace lightwalk;
using namespace lightwalk::fuzz;

namespace {

/// Any float: often one that breaks arithmetic.
float number(FuzzedDataProvider& bytes) {
  constexpr float special[] = {
      0,     -0.0f,     1,        -1,
      0.5f,  1e-30f,    1e4f,     1e30f,
      3e38f, -infinity, infinity, std::numeric_limits<float>::quiet_NaN(),
      1e-45f};
  const auto choice = bytes.ConsumeIntegral<std::uint8_t>();
  if (choice < std::size(special)) return special[choice];
  if (choice < 200) return static_cast<float>(choice) / 128;
  const auto bits = bytes.ConsumeIntegral<std::uint32_t>();
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

Image image(FuzzedDataProvider& bytes, int width, int height) {
  Image result(width, height);
  const bool is_even = bytes.ConsumeBool();  // one color everywhere
  Vec3 color(0);
  for (Vec3& pixel : result.pixels) {
    if (!is_even || &pixel == result.pixels.data()) {
      for (int c = 0; c < 3; ++c) color[c] = number(bytes);
    }
    pixel = color;
  }
  return result;
}

RenderResult render(FuzzedDataProvider& bytes, int width, int height) {
  RenderResult result;
  result.info.samples_per_pixel =
      std::abs(static_cast<double>(number(bytes)));
  result.radiance = image(bytes, width, height);
  result.variance = image(bytes, width, height);
  return result;
}

bool is_finite(const Image& image) {
  for (const Vec3& pixel : image.pixels) {
    if (!lightwalk::is_finite(pixel)) return false;
  }
  return true;
}

/// Compares two renders and says what differs; returns whether nothing does.
/// A small one is enlarged in a picture, which takes long.
bool same(const RenderResult& test, const RenderResult& reference,
          bool with_picture) {
  const Bands bands;
  const int scale = tile_scale(test, reference);
  expect(scale >= 1 && scale <= 1024, "tiles have a size");
  const auto all = compare_regions(test, reference, bands, scale);
  expect(all.size() >= 3, "the whole image is compared");
  std::vector<RegionDifference> differing;
  for (const RegionDifference& one : all) {
    if (!one.same(bands)) differing.push_back(one);
  }
  expect(worst_of(all) != nullptr, "one region is the worst");
  const int width = reference.radiance.width;
  const int height = reference.radiance.height;
  const std::string verdict = describe(
      all, differing, bands, width, height,
      [](const Region& region) { return region.left < 2 ? "a wall" : ""; });
  expect(is_one_line(verdict), "a verdict is one line", verdict);
  variance_ratio(test, reference);
  // Only pictures that are finite are shown.
  if (with_picture && is_finite(test.radiance) &&
      is_finite(reference.radiance)) {
    const Image picture = difference_picture(test, reference);
    expect(picture.width >= 4 * width && picture.height >= height,
           "the picture has four panels");
  }
  return differing.empty();
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider bytes(data, size);
  const bool with_picture = bytes.ConsumeIntegralInRange(0, 7) == 7;
  const int width = with_picture ? bytes.ConsumeIntegralInRange(100, 300)
                                 : bytes.ConsumeIntegralInRange(1, 10);
  const int height = bytes.ConsumeIntegralInRange(1, with_picture ? 2 : 10);
  const RenderResult a = render(bytes, width, height);
  const RenderResult b = render(bytes, width, height);
  const bool finite = is_finite(a.radiance) && is_finite(b.radiance);
  if (same(a, b, with_picture))
    expect(finite, "what is not finite is not the same");
  if (is_finite(a.radiance)) expect(same(a, a, false), "a picture is itself");
  return 0;
}
