#pragma once

// Vectors in tests: printed when a check fails, compared with a tolerance,
// and drawn at random.

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "common/geometry/geometry.hpp"
#include "common/math/random.hpp"
#include "common/math/vector.hpp"
#include "support/printing.hpp"
#include "tests/core/exact_text.hpp"

namespace lightwalk::tests {

/// `v == Near{value, tolerance}`: at most `tolerance` apart.
struct Near {
  Vec3 value;
  float tolerance;

  friend bool operator==(const Vec3& v, const Near& near) {
    return length(v - near.value) <= near.tolerance;
  }
};

/// Uniform over the unit sphere.
inline Vec3 random_direction(Random& random) {
  const Vec2 u = random.uniform_2d();
  const float z = 1 - 2 * u.x;
  const float radius = std::sqrt(std::max(0.0f, 1 - z * z));
  return normalize(Vec3(radius * std::cos(two_pi * u.y),
                        radius * std::sin(two_pi * u.y), z));
}

/// Whether nothing lies between two points, neither of them on a surface.
inline bool visible(const Geometry& geometry, const Vec3& from,
                    const Vec3& to) {
  const Vec3 way = to - from;
  return !geometry.occluded({from, normalize(way)}, length(way));
}

/// Uniform in the cube [-size, size)^3.
inline Vec3 random_position(Random& random, float size) {
  const Vec2 u = random.uniform_2d();
  return size * (2.0f * Vec3(u.x, u.y, random.uniform()) - 1.0f);
}

}  // namespace lightwalk::tests

namespace doctest {

template <>
struct StringMaker<lightwalk::tests::Near> {
  static String convert(const lightwalk::tests::Near& near) {
    return (lightwalk::tests::text(near.value) + " +- " +
            std::to_string(near.tolerance))
        .c_str();
  }
};

}  // namespace doctest
