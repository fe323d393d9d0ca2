#pragma once

// # Vectors
//
// Positions, directions and colors are three floats of GLM. A color's
// channels are red, green and blue, linear, in the units of what it stands
// for: radiance, intensity, or a coefficient without a unit.

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace lightwalk {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using DoubleVec3 = glm::dvec3;  ///< where a float's 24 bits are too few

using glm::cross;
using glm::dot;
using glm::length;
using glm::normalize;

// Rows of numbers have these functions too, for formulas that serve both.
using std::abs;
using std::copysign;
using std::floor;
using std::max;
using std::min;
using std::sqrt;

inline constexpr float pi = 3.14159265358979324f;
inline constexpr float two_pi = 2 * pi;
inline constexpr float inverse_pi = 1 / pi;
inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// The largest of the three components.
inline float max_component(const Vec3& v) {
  return std::max(v.x, std::max(v.y, v.z));
}

/// Each component without its sign. `glm::abs` would branch on the sign, and
/// the processor mispredicts half of these branches.
inline Vec3 absolute(const Vec3& v) {
  return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

/// The largest absolute value of the three components.
inline float max_abs_component(const Vec3& v) {
  return max_component(absolute(v));
}

/// False where a component is infinite or not a number.
inline bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Whether all channels are 0. A channel that is negative or not a number is
/// an error, and is not black: it should be visible.
inline bool is_black(const Vec3& color) {
  return color == Vec3(0);
}

}  // namespace lightwalk
