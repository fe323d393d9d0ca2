// Random numbers. All seeds here are fixed, so that these tests do the same
// each time; the bounds come from statistics.

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "common/math/random.hpp"
#include "tests/support/chi_squared.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

/// Chi-squared of points over a grid of 32 x 32 equal cells.
void check_uniform_in_square(
    const std::function<Vec2(std::uint64_t)>& point) {
  constexpr std::size_t side = 32;
  std::vector<double> cells(side * side);
  for (std::uint64_t i = 0; i < 200000; ++i) {
    const Vec2 u = 32.0f * point(i);
    ++cells.at(static_cast<std::size_t>(u.y) * side +
               static_cast<std::size_t>(u.x));
  }
  const ChiSquared result = chi_squared_test(cells);
  CAPTURE(result.statistic);
  CAPTURE(result.degrees_of_freedom);
  CHECK(result.p_value > significance);
}

float first(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample) {
  return Random(seed, pixel, sample).uniform();
}

}  // namespace

// 2^25 draws of 2^24 values: the largest is among them with probability
// 1 - e^-2, the least too, and with this seed both are. A number that rounds
// up to 1 would be drawn just as surely, and 1 - u^2 or a logarithm would be
// wrong in one pixel of thousands.
TEST_CASE("uniform numbers reach 0 and the last number before 1, never 1") {
  Random random(2, 2, 3);
  float least = 1, largest = 0;
  for (int i = 0; i < 1 << 25; ++i) {
    const float u = random.uniform();
    least = std::min(least, u);
    largest = std::max(largest, u);
  }
  CHECK(least == 0);
  CHECK(largest == 1 - 0x1p-24f);
}

// The mean of n uniform numbers has the standard deviation 1 / sqrt(12 n).
TEST_CASE("uniform numbers have the mean one half") {
  constexpr int n = 1000000;
  const double bound = significant_deviations / std::sqrt(12.0 * n);
  Random random(1, 0, 0);
  double sum = 0, sum_x = 0, sum_y = 0;
  for (int i = 0; i < n; ++i) {
    sum += static_cast<double>(random.uniform());
    const Vec2 u = random.uniform_2d();
    sum_x += static_cast<double>(u.x);
    sum_y += static_cast<double>(u.y);
  }
  CHECK(std::abs(sum / n - 0.5) < bound);
  CHECK(std::abs(sum_x / n - 0.5) < bound);
  CHECK(std::abs(sum_y / n - 0.5) < bound);
}

TEST_CASE("uniform numbers fill 256 cells evenly, by high and by low bits") {
  for (const float scale : {0x1p8f, 0x1p16f, 0x1p24f}) {
    std::vector<double> cells(256), cells_x(256), cells_y(256);
    const auto cell = [&](float u) {
      return static_cast<std::size_t>(u * scale) % 256;
    };
    Random random(1, 0, 0);
    for (int i = 0; i < 500000; ++i) {
      ++cells[cell(random.uniform())];
      const Vec2 u = random.uniform_2d();
      ++cells_x[cell(u.x)];
      ++cells_y[cell(u.y)];
    }
    CAPTURE(scale);
    CHECK(chi_squared_test(cells).p_value > significance);
    CHECK(chi_squared_test(cells_x).p_value > significance);
    CHECK(chi_squared_test(cells_y).p_value > significance);
  }
}

TEST_CASE("the two numbers of a pair are independent") {
  Random random(1, 0, 0);
  check_uniform_in_square([&](std::uint64_t) { return random.uniform_2d(); });
}

// Both are cut from one 64-bit number. Compares each bit of the one with each
// bit of the other: in n pairs they agree n/2 times, with a standard
// deviation of sqrt(n)/2. At the significance of the other tests the extremes
// of 24 x 24 comparisons lie within 6 deviations; a bit that both share is
// 141 off.
TEST_CASE("the two numbers of a pair share no bit") {
  constexpr int n = 20000;
  std::vector<int> agreements(24 * 24);
  Random random(1, 0, 0);
  for (int k = 0; k < n; ++k) {
    const Vec2 u = 0x1p24f * random.uniform_2d();
    const auto x = static_cast<unsigned>(u.x), y = static_cast<unsigned>(u.y);
    for (unsigned i = 0; i < 24; ++i) {
      for (unsigned j = 0; j < 24; ++j) {
        agreements[24 * i + j] += (x >> i & 1) == (y >> j & 1);
      }
    }
  }
  for (const int count : agreements) {
    CHECK(std::abs(count - n / 2) < 6 * std::sqrt(1.0 * n) / 2);
  }
}

TEST_CASE("successive numbers of a sequence are independent") {
  Random random(1, 0, 0);
  check_uniform_in_square([&](std::uint64_t) {
    const float x = random.uniform();
    return Vec2(x, random.uniform());
  });
  check_uniform_in_square([&](std::uint64_t) {
    const Vec2 u = random.uniform_2d();
    return Vec2(u.y, random.uniform_2d().x);
  });
}

// The numbers of a camera ray, over all samples of a pixel and over all pixels.
TEST_CASE("first pairs over samples, pixels and seeds fill the square") {
  check_uniform_in_square(
      [](std::uint64_t i) { return Random(1, 7, i).uniform_2d(); });
  check_uniform_in_square(
      [](std::uint64_t i) { return Random(1, i, 0).uniform_2d(); });
  check_uniform_in_square(
      [](std::uint64_t i) { return Random(i, 7, 0).uniform_2d(); });
}

// Pairs that do not overlap, so that the points are independent.
TEST_CASE("neighboring samples, pixels and seeds are independent") {
  SUBCASE("samples") {
    check_uniform_in_square([](std::uint64_t i) {
      return Vec2(first(1, 7, 2 * i), first(1, 7, 2 * i + 1));
    });
  }
  SUBCASE("pixels in a row") {
    check_uniform_in_square([](std::uint64_t i) {
      return Vec2(first(1, 2 * i, 0), first(1, 2 * i + 1, 0));
    });
  }
  SUBCASE("pixels above each other in a picture 256 wide") {
    check_uniform_in_square([](std::uint64_t i) {
      const std::uint64_t pixel = i / 256 * 512 + i % 256;
      return Vec2(first(1, pixel, 0), first(1, pixel + 256, 0));
    });
  }
  SUBCASE("seeds") {
    check_uniform_in_square([](std::uint64_t i) {
      return Vec2(first(2 * i, 7, 0), first(2 * i + 1, 7, 0));
    });
  }
  SUBCASE("the next sample against the next number of the same one") {
    check_uniform_in_square([](std::uint64_t i) {
      Random random(1, 7, 2 * i);
      random.uniform();
      return Vec2(random.uniform(), first(1, 7, 2 * i + 1));
    });
  }
  SUBCASE("pixel p of sample s against pixel s of sample p") {
    check_uniform_in_square([](std::uint64_t i) {
      const std::uint64_t p = i / 1000, s = 1000 + i % 1000;
      return Vec2(first(1, p, s), first(1, s, p));
    });
  }
}

// The correlation of n independent pairs scatters by 1 / sqrt(n).
TEST_CASE("first draws of successive samples are uncorrelated") {
  constexpr int n = 500000;
  double sum = 0;
  for (std::uint64_t i = 0; i < n; ++i) {
    sum += (static_cast<double>(first(1, 7, 2 * i)) - 0.5) *
           (static_cast<double>(first(1, 7, 2 * i + 1)) - 0.5);
  }
  const double correlation = sum / n * 12;  // the variance is 1/12
  CHECK(std::abs(correlation) < significant_deviations / std::sqrt(1.0 * n));
}

TEST_CASE("the same key gives the same numbers") {
  Random a(1, 2, 3), b(1, 2, 3);
  for (int i = 0; i < 100; ++i) {
    CHECK(a.uniform() == b.uniform());
    CHECK(a.uniform_2d() == b.uniform_2d());
  }
}

TEST_CASE("another seed, pixel or sample gives other numbers") {
  // 64 numbers of 24 bits that agree more than twice are no accident.
  const auto equal = [](Random a, Random b) {
    int count = 0;
    for (int i = 0; i < 64; ++i) count += a.uniform() == b.uniform();
    return count;
  };
  CHECK(equal(Random(1, 2, 3), Random(2, 2, 3)) <= 2);
  CHECK(equal(Random(1, 2, 3), Random(1, 3, 3)) <= 2);
  CHECK(equal(Random(1, 2, 3), Random(1, 2, 4)) <= 2);
  CHECK(equal(Random(1, 2, 3), Random(3, 2, 1)) <= 2);
  CHECK(equal(Random(0, 0, 0), Random(~0ull, ~0ull, ~0ull)) <= 2);
  CHECK(equal(Random(1, 0, 0), Random(1ull << 40, 0, 0)) <= 2);
}
