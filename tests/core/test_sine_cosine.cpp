// Compares sine and cosine with those of the standard library in double
// precision.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "common/math/sine_cosine.hpp"

using namespace lightwalk;

namespace {

/// The largest error over `count` angles from `first` to `last`.
struct Errors {
  double sine = 0, cosine = 0, length = 0;
};
Errors errors(double first, double last, int count) {
  Errors worst;
  for (int i = 0; i <= count; ++i) {
    const auto angle = static_cast<float>(first + (last - first) * i / count);
    const double s = lightwalk::sin(angle), c = lightwalk::cos(angle);
    const double x = angle;
    worst.sine = std::max(worst.sine, std::abs(s - std::sin(x)));
    worst.cosine = std::max(worst.cosine, std::abs(c - std::cos(x)));
    worst.length = std::max(worst.length, std::abs(s * s + c * c - 1));
  }
  return worst;
}

}  // namespace

TEST_CASE("sine and cosine are those of the standard library") {
  // The angle in turns is rounded (2e-7), so is 1 / 2 pi, and so is the rest.
  const Errors circle = errors(0, two_pi, 1'000'000);
  CHECK(circle.sine < 5e-7);
  CHECK(circle.cosine < 5e-7);
  CHECK(circle.length < 3e-7);
}

TEST_CASE("sine and cosine repeat themselves on both sides of the circle") {
  // An angle's own rounding grows with it: at 100 it is 4e-6.
  const Errors below = errors(-100, 0, 1'000'000);
  const Errors above = errors(two_pi, 100, 1'000'000);
  CHECK(below.sine < 1e-5);
  CHECK(below.cosine < 1e-5);
  CHECK(above.sine < 1e-5);
  CHECK(above.cosine < 1e-5);
  CHECK(below.length < 3e-7);
  CHECK(above.length < 3e-7);
}

TEST_CASE("sine and cosine of the quarters") {
  CHECK(lightwalk::cos(0) == 1);
  CHECK(lightwalk::sin(0) == 0);
  CHECK(lightwalk::sin(pi / 2) == 1);
  CHECK(lightwalk::cos(pi) == -1);
  CHECK(lightwalk::sin(3 * pi / 2) == -1);
}
