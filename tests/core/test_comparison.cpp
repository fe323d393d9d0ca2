// The statistics that decide whether two pictures are the same.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "common/math/random.hpp"
#include "common/render/film.hpp"
#include "compare/comparison.hpp"
#include "compare/spread_variance.hpp"
#include "compare/verdict.hpp"
#include "support/goldens.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

/// A 32 x 32 picture of noise: uniform in [0, 2 mean), variance mean^2/3.
RenderResult noise(int samples, std::uint64_t seed, float mean = 1) {
  Film film(32, 32);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      for (int i = 0; i < samples; ++i) {
        Random random(seed, film.index(x, y), static_cast<std::uint64_t>(i));
        film.pixel(x, y).add(Vec3(2 * mean * random.uniform()));
      }
    }
  }
  RenderResult result{film.radiance(), film.variance(), {}};
  result.info.samples_per_pixel = samples;
  return result;
}

Comparison compare(const Rerender& rerender) {
  static const RenderResult reference = noise(1024, 1000);
  return compare_with_reference(rerender, 256, 1, reference);
}

void darken(RenderResult& result, const Region& r, float factor) {
  for (int y = r.top; y < r.top + r.height; ++y) {
    for (int x = r.left; x < r.left + r.width; ++x) {
      result.radiance.at(x, y) *= factor;
    }
  }
}

}  // namespace

TEST_CASE("the same picture with another seed is the same") {
  int second_looks = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Comparison comparison =
        compare([&](int samples, std::uint64_t other) {
          return noise(samples, seed * 1000 + other);
        });
    CHECK(comparison.same());
    second_looks += comparison.suspected.empty() ? 0 : 1;
  }
  CHECK(second_looks <= 2);  // 30 times 243 regions: 0.08 are expected
}

TEST_CASE("a picture that is 3 % darker everywhere is not the same") {
  const Comparison comparison = compare([](int samples, std::uint64_t seed) {
    return noise(samples, seed, 0.97f);
  });
  REQUIRE_FALSE(comparison.same());
  CHECK(comparison.confirmed[0].region == Region{0, 0, 32, 32});
  CHECK(comparison.confirmed[0].sign() == -1);
}

TEST_CASE("a darker 4x4 tile is found and reported where it is") {
  const Region tile{8, 20, 4, 4};
  const Comparison comparison = compare([&](int samples, std::uint64_t seed) {
    RenderResult result = noise(samples, seed);
    darken(result, tile, 0.6f);
    return result;
  });
  REQUIRE_FALSE(comparison.same());
  for (const RegionDifference& one : comparison.confirmed) {
    const Region& r = one.region;
    CHECK(r.left <= 8);
    CHECK(r.left + r.width >= 12);
    CHECK(r.top <= 20);
    CHECK(r.top + r.height >= 24);
  }
  const std::string text =
      describe(comparison.again, comparison.confirmed, {}, 32, 32,
               [&](const Region& r) -> std::string {
                 return r == tile ? "the cat" : "the mat";
               });
  CAPTURE(text);
  CHECK(text.find("all of it on the cat") != std::string::npos);
  CHECK(text.find("40 % too dark there") != std::string::npos);
  CHECK(text.find("(lower left)") != std::string::npos);
}

TEST_CASE("a picture with NaN is not the same") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Comparison in_mean = compare([&](int samples, std::uint64_t seed) {
    RenderResult result = noise(samples, seed);
    result.radiance.at(3, 3).y = nan;
    return result;
  });
  CHECK_FALSE(in_mean.same());
  RegionDifference difference;
  difference.z = static_cast<double>(nan);
  CHECK_FALSE(difference.same({}));
}

// One pixel has a path of 1000 times its brightness: its mean grows by 1/64 of
// 1000, and its variance accordingly. That is noise, and must count as noise.
TEST_CASE("a firefly is noise") {
  const Comparison comparison = compare([](int samples, std::uint64_t seed) {
    RenderResult result = noise(samples, seed);
    const auto n = static_cast<float>(samples);
    result.radiance.at(5, 5) += Vec3(1000 / n);
    result.variance.at(5, 5) += Vec3(1e6f / n);
    return result;
  });
  CHECK(comparison.same());
}

TEST_CASE("without noise the band alone decides") {
  const auto constant = [](float value) {
    RenderResult result{Image(8, 8), Image(8, 8), {}};
    for (Vec3& pixel : result.radiance.pixels) pixel = Vec3(value);
    result.info.samples_per_pixel = 4096;
    return result;
  };
  const auto same = [&](float value) {
    return compare_with_reference(
               [&](int, std::uint64_t) { return constant(value); }, 4096, 1,
               constant(1))
        .same();
  };
  CHECK(same(1));
  CHECK(same(1.009f));
  CHECK_FALSE(same(1.02f));
  CHECK_FALSE(same(0.98f));
}

TEST_CASE("tiles grow where there are few samples to a pixel") {
  const RenderResult few = noise(4, 1), many = noise(256, 1);
  CHECK(tile_scale(many, many) == 1);
  CHECK(tile_scale(few, many) == 8);
  CHECK(regions_of(32, 32, 1).size() == 1 + 16 + 64);
}

TEST_CASE("rows and columns are as wide as few samples make necessary") {
  const auto has = [](const std::vector<Region>& all, const Region& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  };
  const auto fine = more_regions_of(32, 32, 1);
  CHECK(has(fine, {0, 7, 32, 1}));
  CHECK(has(fine, {7, 0, 1, 32}));
  CHECK(has(fine, {4, 12, 8, 8}));                 // moved by half a tile
  const auto coarse = more_regions_of(32, 32, 2);  // tiles of 64 pixels
  CHECK_FALSE(has(coarse, {0, 6, 32, 1}));
  CHECK(has(coarse, {0, 6, 32, 2}));
}

// The three channels of this noise are equal, so the sum has 1024 terms of
// variance 2: it scatters by sqrt(2/1024) = 0.044, and the mean of 40 sums by
// 0.007. Four times that are allowed.
TEST_CASE("the squared differences of pixels add up to their noise") {
  Bands none;
  none.tile = none.floor = 0;
  for (const int samples : {16, 64}) {  // 16 samples: squares of 4 pixels
    double times = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const PixelSum sum = sum_over_pixels(noise(samples, seed),
                                           noise(samples, seed + 1000), none);
      times += sum.times / 40;
      CHECK(std::abs(sum.z) < 4.4);
    }
    const double terms = samples == 16 ? 256 : 1024;
    CAPTURE(samples);
    CHECK(std::abs(times - 1) < 4 * std::sqrt(2 / terms / 40));
  }
}

// Columns of radiance 1 and 1.4 in turn. A difference of 0.4 is 4 standard
// deviations of a pixel, and the mean of each tile is right.
TEST_CASE("exchanged columns are further apart than their noise") {
  const auto columns = [](std::uint64_t seed, int bright) {
    RenderResult result = noise(64, seed);
    for (int x = bright; x < 32; x += 2) {
      for (int y = 0; y < 32; ++y) result.radiance.at(x, y) += Vec3(0.4f);
    }
    return result;
  };
  const RenderResult reference = columns(1, 0);
  CHECK(sum_over_pixels(columns(2, 0), reference, {}).z < 4.4);
  CHECK(sum_over_pixels(columns(2, 1), reference, {}).z > 20);
  for (const auto& one : compare_regions(columns(2, 1), reference, {}, 1)) {
    CHECK(one.same({}));
  }
}

// Stage 1 finds a small lamp by chance, stage 2 asks it: one in 100 samples
// brings 100, against 1 always. A pixel whose samples all missed has a variance
// of 0.
TEST_CASE("a picture that finds its light by chance is the same picture") {
  const auto by_chance = [](std::uint64_t seed) {
    RenderResult result = noise(64, seed);
    Random random(seed, 0, 0);
    for (std::size_t i = 0; i < 1024; ++i) {
      Pixel pixel;
      for (int k = 0; k < 64; ++k) {
        pixel.add(Vec3(random.uniform() < 0.01f ? 100.0f : 0.0f));
      }
      result.radiance.pixels[i] = Vec3(static_cast<float>(pixel.mean[0]));
      result.variance.pixels[i] = Vec3(static_cast<float>(pixel.variance(0)));
    }
    return result;
  };
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const RenderResult asked = noise(64, seed + 1000);
    RenderResult found = by_chance(seed);
    CHECK(sum_over_pixels(found, asked, {}).z > 20);  // it does not know
    spread_variance(found);
    CHECK(sum_over_pixels(found, asked, {}).z < 4.4);
    CHECK(sum_over_pixels(asked, found, {}).z < 4.4);
  }
}

// A caustic's path that one picture found and the other did not.
TEST_CASE("a firefly in every tenth pixel is noise") {
  const auto with_fireflies = [](std::uint64_t seed) {
    RenderResult result = noise(64, seed);
    Random random(seed, 0, 0);
    for (std::size_t i = 0; i < 1024; ++i) {
      if (random.uniform() > 0.1f) continue;
      result.radiance.pixels[i] += Vec3(1000.0f / 64);
      result.variance.pixels[i] += Vec3(1e6f / 64);
    }
    return result;
  };
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CHECK(
        sum_over_pixels(with_fireflies(seed), with_fireflies(seed + 1000), {})
            .z < 4.4);
  }
}

// Uniform noise of mean 1 has the variance 1/3. A tile of 64 pixels and 64
// samples has sigma = sqrt(2/3/4096) = 0.0128; the larger of two variances
// counts, which is 9 % more of one of them. Seen is band + (4.4 + 2) sigma.
TEST_CASE("what would have been seen is computed from the noise") {
  const RenderResult a = noise(64, 1), b = noise(64, 2);
  const auto all =
      compare_regions(a, b, {}, more_regions_of(32, 32, tile_scale(a, b)));
  CHECK(tile_scale(a, b) == 2);
  const std::string said = same_as_far_as_seen(all, {}, 8);
  CAPTURE(said);
  const double percent = std::stod(said.substr(said.find(" is ") + 4));
  CHECK(percent > 100 * (0.02 + 6.4 * 0.0128));
  CHECK(percent < 100 * (0.02 + 6.4 * 0.0128) * 1.2);
}

// 2 Q(4.4) = 1.08e-5, and a few thousand regions.
TEST_CASE("the computed false alarms are those of the normal distribution") {
  CHECK(false_alarm_rate(4.4, 1) == doctest::Approx(1.0825e-5).epsilon(1e-3));
  const Comparison comparison = compare(
      [](int samples, std::uint64_t seed) { return noise(samples, seed); });
  CHECK(comparison.false_alarms({}) ==
        doctest::Approx(243 * 1.0825e-5 * 1.0825e-5 / 2).epsilon(1e-2));
}

// Compares every golden with every other one of its size: a test that accepts
// two different scenes would accept anything.
TEST_CASE("no golden is taken for another scene's") {
  std::vector<Golden> goldens;
  for (int stage = 1; stage <= 5; ++stage) {
    for (const std::string& name : golden_names(stage)) {
      goldens.push_back(load_golden(stage, name));
    }
  }
  for (const Golden& a : goldens) {
    for (const Golden& b : goldens) {
      if (a.name == b.name) continue;
      CAPTURE(a.name);
      CAPTURE(b.name);
      const auto all = compare_regions(a.image, b.image, {}, 1);
      int differing = 0;
      for (const RegionDifference& one : all) {
        differing += one.same({}) ? 0 : 1;
      }
      CHECK(differing > 0);
    }
  }
}
