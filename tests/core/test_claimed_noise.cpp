// Pictures that claim more noise than they have.

#include <doctest/doctest.h>

#include <cmath>

#include "common/math/random.hpp"
#include "common/render/film.hpp"
#include "compare/claims.hpp"

using namespace lightwalk;

namespace {

/// A picture of noise with mean 1. One sample in `rarity` is bright and the
/// others black; 1: uniform in [0, 2).
RenderResult noise(int samples, std::uint64_t seed, int rarity = 1,
                   int size = 32) {
  Film film(size, size);
  const auto often = static_cast<float>(rarity);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      for (int i = 0; i < samples; ++i) {
        Random random(seed, film.index(x, y), static_cast<std::uint64_t>(i));
        const float u = random.uniform();
        const float value = rarity == 1 ? 2 * u : u * often < 1 ? often : 0;
        film.pixel(x, y).add(Vec3(value));
      }
    }
  }
  RenderResult result{film.radiance(), film.variance(), {}};
  result.info.samples_per_pixel = samples;
  return result;
}

/// Black, with this variance of a sample everywhere.
RenderResult black(float variance) {
  RenderResult result{Image(32, 32), Image(32, 32), {}};
  for (Vec3& pixel : result.variance.pixels) pixel = Vec3(variance);
  result.info.samples_per_pixel = 64;
  return result;
}

std::size_t differing(const RenderResult& a, const RenderResult& b) {
  std::size_t count = 0;
  for (const RegionDifference& one : compare_regions(a, b, {}, 1)) {
    count += one.same({}) ? 0 : 1;
  }
  return count;
}

}  // namespace

TEST_CASE("a black picture with a huge variance is not believed") {
  const RenderResult right = noise(64, 1);
  for (const float variance : {1e3f, 1e4f, 1e8f, 1e20f}) {
    CAPTURE(variance);
    const auto claim = false_claim(black(variance), right, 1);
    REQUIRE(claim);
    CHECK(claim->by_test);
    const double times = 3 * static_cast<double>(variance);  // of 1/3
    CHECK(claim->times == doctest::Approx(times).epsilon(0.05));
  }
}

TEST_CASE("a black reference with a huge variance is not believed either") {
  const auto claim = false_claim(noise(64, 1), black(1e4f), 1);
  REQUIRE(claim);
  CHECK_FALSE(claim->by_test);
}

// A variance that is not refused is too small to hide a difference.
TEST_CASE("a black picture is different or not believed") {
  const RenderResult right = noise(64, 1);
  for (float variance = 0; variance < 1e6f; variance = 2 * variance + 0.1f) {
    CAPTURE(variance);
    const RenderResult wrong = black(variance);
    CHECK((false_claim(wrong, right, 1) || differing(wrong, right) > 0));
    CHECK((false_claim(right, wrong, 1) || differing(right, wrong) > 0));
  }
}

TEST_CASE("a variance that is claimed only where the picture is wrong") {
  const RenderResult right = noise(64, 1);
  RenderResult wrong = noise(64, 2);
  for (int y = 8; y < 16; ++y) {
    for (int x = 8; x < 16; ++x) {
      wrong.radiance.at(x, y) = Vec3(0.2f);
      wrong.variance.at(x, y) = Vec3(1e4f);
    }
  }
  CHECK(false_claim(wrong, right, 1));
}

TEST_CASE("noise that a picture really has is believed") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    for (const int rarity : {1, 4, 50, 1000}) {
      CAPTURE(rarity);
      const RenderResult noisy = noise(64, seed, rarity);
      CHECK_FALSE(false_claim(noisy, noise(256, seed + 50), 1));
      CHECK_FALSE(false_claim(noise(256, seed + 50), noisy, 1));
    }
  }
}

TEST_CASE("fewer samples are no false claim") {
  CHECK_FALSE(false_claim(noise(4, 1), noise(1024, 2), 8));
}
