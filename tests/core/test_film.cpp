#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "common/render/film.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

struct Statistics {
  double mean[3], variance[3];
};

/// Mean and unbiased variance, with the mean known before differences are
/// taken.
Statistics two_passes(const std::vector<Vec3>& samples) {
  Statistics result{};
  const double n = static_cast<double>(samples.size());
  for (int c = 0; c < 3; ++c) {
    double sum = 0, squares = 0;
    for (const Vec3& s : samples) sum += static_cast<double>(s[c]);
    const double mean = sum / n;
    for (const Vec3& s : samples) {
      const double difference = static_cast<double>(s[c]) - mean;
      squares += difference * difference;
    }
    result.mean[c] = mean;
    result.variance[c] = squares / (n - 1);
  }
  return result;
}

void check_against_two_passes(const std::vector<Vec3>& samples) {
  Pixel pixel;
  for (const Vec3& sample : samples) pixel.add(sample);
  const Statistics expected = two_passes(samples);
  CHECK(pixel.samples == samples.size());
  for (int c = 0; c < 3; ++c) {
    CAPTURE(c);
    CHECK(pixel.mean[c] == doctest::Approx(expected.mean[c]).epsilon(1e-12));
    CHECK(pixel.variance(c) ==
          doctest::Approx(expected.variance[c]).epsilon(1e-9));
  }
}

}  // namespace

// Half of the samples are 1e30: the variance, about 2.5e59, is beyond a float.
TEST_CASE("a variance too large for a float is the largest float") {
  Film film(1, 1);
  for (const float x : {0.0f, 1e30f, 0.0f, 1e30f}) {
    film.pixel(0, 0).add(Vec3(x));
  }
  CHECK(film.radiance().at(0, 0).x == doctest::Approx(5e29));
  CHECK(film.variance().at(0, 0).x == std::numeric_limits<float>::max());
}

// Mean 4, squared differences 9 + 1 + 1 + 9 = 20, divided by 3.
TEST_CASE("mean and variance of four numbers are those worked out by hand") {
  Pixel pixel;
  for (const float x : {1.0f, 3.0f, 5.0f, 7.0f}) pixel.add({x, 2 * x, 0});
  CHECK(pixel.samples == 4);
  CHECK(pixel.mean[0] == doctest::Approx(4));
  CHECK(pixel.mean[1] == doctest::Approx(8));
  CHECK(pixel.mean[2] == 0);
  CHECK(pixel.variance(0) == doctest::Approx(20.0 / 3));
  CHECK(pixel.variance(1) == doctest::Approx(80.0 / 3));
  CHECK(pixel.variance(2) == 0);
}

TEST_CASE("mean and variance equal those taken in two passes") {
  Random random(1, 0, 0);
  std::vector<Vec3> samples;
  for (int i = 0; i < 10000; ++i) {
    const float rare = random.uniform() < 0.01f ? 500.0f : 0.0f;
    samples.push_back({random.uniform(), rare, 3 + random.uniform()});
  }
  check_against_two_passes(samples);
}

// The mean of squares minus the square of the mean would lose all digits: the
// squares are 10^12, the variance about 1/12.
TEST_CASE("a small variance around a large mean is not lost") {
  Random random(2, 0, 0);
  std::vector<Vec3> samples;
  for (int i = 0; i < 10000; ++i) {
    samples.push_back(1e6f + random_position(random, 0.5f));
  }
  check_against_two_passes(samples);
}

TEST_CASE("equal samples have a variance of exactly zero") {
  for (const float value : {0.0f, 0.1f, 0.8f, 1.0f / 3, 12345.678f}) {
    Pixel pixel;
    for (int i = 0; i < 1000; ++i) pixel.add(Vec3(value));
    CAPTURE(value);
    CHECK(pixel.mean[0] == static_cast<double>(value));
    CHECK(pixel.variance(0) == 0);
  }
}

TEST_CASE("one sample is its own mean, with no variance") {
  Pixel pixel;
  CHECK(pixel.variance(0) == 0);
  pixel.add({1, 2, 3});
  CHECK(pixel.mean[1] == 2);
  CHECK(pixel.variance(1) == 0);
}

TEST_CASE("samples that are not finite are counted and left out") {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  Pixel pixel;
  pixel.add({1, 1, 1});
  pixel.add({nan, 1, 1});
  pixel.add({1, infinity, 1});
  pixel.add({1, 1, -infinity});
  pixel.add({3, 3, 3});
  CHECK(pixel.samples == 2);
  CHECK(pixel.dropped == 3);
  CHECK(pixel.first_dropped == 1);
  CHECK(pixel.mean[0] == doctest::Approx(2));
  CHECK(pixel.variance(2) == doctest::Approx(2));
}

TEST_CASE("a pixel of the film is the same pixel of its images") {
  Film film(3, 2);
  film.pixel(2, 1).add({1, 2, 3});
  film.pixel(2, 1).add({3, 6, 3});
  const Image radiance = film.radiance(), variance = film.variance();
  CHECK(radiance.width == 3);
  CHECK(radiance.height == 2);
  CHECK(radiance.at(2, 1) == Vec3(2, 4, 3));
  CHECK(variance.at(2, 1) == Vec3(2, 8, 0));
  CHECK(radiance.pixels.back() == Vec3(2, 4, 3));
  CHECK(radiance.at(0, 0) == Vec3(0));
  CHECK(radiance.at(1, 1) == Vec3(0));
  CHECK(film.index(2, 1) == 5);
}
