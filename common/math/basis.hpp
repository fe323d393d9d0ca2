#pragma once

// # A basis
//
// Directions are sampled about the z axis, where the formulas are short, and
// then turned so that z becomes the surface's normal. Any two axes
// perpendicular to the normal will do, but they must exist for every normal:
// the cross product with a fixed "up" vector is zero when the normal *is* up,
// and then just the floor and the ceiling turn black.
//
// The construction by Duff et al., "Building an Orthonormal Basis, Revisited"
// (JCGT 6(1), 2017) has no such direction and needs no square root. Its two
// halves meet at $z = 0$, where `copysign` also settles the sign of a zero.

#include <cmath>

#include "common/math/vector.hpp"

namespace lightwalk {

// `Vector` is a Vec3, or a row of them: see stage 6.

// #region basis
/// Three unit axes, each perpendicular to the others, right-handed.
template <class Vector>
struct BasisOf {
  Vector tangent, bitangent, normal;

  /// `n` must be a unit vector.
  explicit BasisOf(const Vector& n) : normal(n) {
    const auto sign = copysign(1.0f, n.z);
    const auto a = -1.0f / (sign + n.z);
    const auto b = n.x * n.y * a;
    tangent = {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x};
    bitangent = {b, sign + n.y * n.y * a, -n.y};
  }

  /// From coordinates along the three axes to the world's.
  Vector to_world(const Vector& v) const {
    return v.x * tangent + v.y * bitangent + v.z * normal;
  }

  /// From the world's coordinates to those along the three axes.
  Vector to_local(const Vector& v) const {
    return {dot(v, tangent), dot(v, bitangent), dot(v, normal)};
  }
};
using Basis = BasisOf<Vec3>;
// #endregion basis

}  // namespace lightwalk
