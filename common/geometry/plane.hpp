#pragma once

// # Planes
//
// A plane is every $x$ with $n \cdot x + d = 0$, for a unit normal $n$. So
// $n = (1, 0, 0)$ with $d = 1$ is the wall at $x = -1$, facing right. Planes
// have no edge: the box made of five of them is a corridor, open toward -z.
//
// Along the ray $o + t\omega$ the left side is $n \cdot o + d + t\,(n \cdot
// \omega)$, which is zero at $t = -(n \cdot o + d) / (n \cdot \omega)$. A ray
// within the plane divides zero by zero and a ray parallel to it divides by
// zero: not a number and infinity, and neither counts as a hit.

#include "common/geometry/lanes.hpp"
#include "common/geometry/ray.hpp"

namespace lightwalk {

struct Plane {
  Vec3 normal;     ///< unit
  float distance;  ///< d, the signed distance from the plane to the origin
  const Material* material;
  static constexpr const Light* light = nullptr;  ///< never sampled
};

/// What it takes to intersect planes: eight with one ray, or one with many.
template <class Vector, class Number>
struct PlaneIntersector {
  Vector normal;
  Number distance{};

  // #region plane-intersection
  /// Distances along the ray; what is not above 0 or not finite is no hit.
  template <class Rays>
  auto intersect(const Rays& ray) const {
    const auto height = dot(normal, ray.origin) + distance;
    return -height / dot(normal, ray.direction);
  }
  // #endregion plane-intersection
};

inline PlaneIntersector<Vec3, float> intersector_of(const Plane& plane) {
  return {plane.normal, plane.distance};
}

/// Eight planes. A lane that is not set is hit by no ray.
struct PlanePack : PlaneIntersector<Vec3x8, Float8> {
  void set(int lane, const Plane& plane) {
    normal.set(lane, plane.normal);
    distance[lane] = plane.distance;
  }
};

/// The point of a plane below `x`, which is `height` lengths of the normal
/// `n` off the plane. That length is 1 only up to rounding, which is too
/// coarse near the origin, where floats are fine. So `height` is divided by
/// the square $1 + \epsilon$ of that length: multiplied by $1 - \epsilon$.
template <class DoubleVector, class Double>
DoubleVector project_onto_plane(const DoubleVector& x, const Double& height,
                                const DoubleVector& n) {
  return x - height * (2.0 - dot(n, n)) * n;
}

/// Completes a hit at `hit.position`, which rounding has put near the plane,
/// and moves it back by `back` within the plane.
inline void snap_to_surface(const Plane& plane, const Vec3& back, Hit& hit) {
  hit.normal = plane.normal;
  const DoubleVec3 x(hit.position - back), n(plane.normal);
  const double height = dot(n, x) + static_cast<double>(plane.distance);
  hit.position = Vec3(project_onto_plane(x, height, n));
  hit.diameter = 0;
}

}  // namespace lightwalk
