#pragma once

// # Planes
//
// A plane is every $x$ with $n \cdot x + d = 0$, for a unit normal $n$. So
// $n = (1, 0, 0)$ with $d = 1$ is the wall at $x = -1$, facing right. Planes
// have no edge: the box made of five of them is a corridor, open towards -z.
//
// Along the ray $o + t\omega$ the left side is $n \cdot o + d + t\,(n \cdot
// \omega)$, which is zero at $t = -(n \cdot o + d) / (n \cdot \omega)$. A ray
// within the plane divides zero by zero and a ray beside it divides by zero:
// not a number and infinity, and neither counts as a hit.

#include "common/geometry/lanes.hpp"
#include "common/geometry/ray.hpp"

namespace lightwalk {

struct Plane {
  Vec3 normal;     ///< unit
  float distance;  ///< d, the signed distance from the plane to the origin
  const Material* material;
};

/// What is needed to meet a plane: of one plane, for eight rays, or of eight
/// planes, for one ray.
template <class Vector, class Number>
struct PlaneForm {
  Vector normal{};
  Number distance{};

  // #region plane-intersection
  /// Distances along the ray; what is not above 0 or not finite is no hit.
  template <class Rays>
  Float8 intersect(const Rays& ray) const {
    const Float8 height = dot(normal, ray.origin) + distance;
    return -height / dot(normal, ray.direction);
  }
  // #endregion plane-intersection
};

/// Eight planes. A lane that is not set is hit by no ray.
struct PlanePack : PlaneForm<Vec3x8, Float8> {
  void set(int lane, const Plane& plane) {
    normal.set(lane, plane.normal);
    distance[lane] = plane.distance;
  }
  PlaneForm<Vec3, float> one(int lane) const {
    return {normal[lane], distance[lane]};
  }
};

/// Completes a hit at `hit.position`, which rounding has put near the plane.
inline void place_hit(const Plane& plane, Hit& hit) {
  hit.normal = plane.normal;
  hit.position -=
      plane.normal * (dot(plane.normal, hit.position) + plane.distance);
  hit.magnitude =
      std::max(max_abs_component(hit.position), std::abs(plane.distance));
}

}  // namespace lightwalk
