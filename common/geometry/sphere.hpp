#pragma once

// # Spheres
//
// With $f = o - c$ and a unit direction $\omega$, the ray meets the sphere
// where $t^2 + 2 (f \cdot \omega)\,t + (f \cdot f - r^2) = 0$. The school
// formula loses all digits when the ray starts far away or on the sphere
// itself, which every reflected ray does, so two of its steps are replaced
// (Haines et al., "Precision Improvements for Ray/Sphere Intersection", Ray
// Tracing Gems, 2019):
//
// - The discriminant is $r^2 - |h|^2$, where $h = f - (f \cdot \omega)\omega$
//   is the part of $f$ beside the ray: nothing large is subtracted.
// - With $b = -f \cdot \omega$, one root is $q = b \pm \sqrt{\cdot}$ with the
//   sign that adds, the other is $(f \cdot f - r^2) / q$.
//
// Of the two, the nearer that lies ahead counts. From inside, the nearer one
// lies behind: a sphere that only knows its near root cannot be left again.

#include "common/geometry/lanes.hpp"
#include "common/geometry/ray.hpp"

namespace lightwalk {

struct Sphere {
  Vec3 center;
  float radius;
  const Material* material;
  const Light* light = nullptr;  ///< the scene's light that it is, if any
};

/// What it takes to intersect eight spheres. A lane that is not set is hit by
/// no ray.
struct SpherePack {
  Vec3x8 center;
  Float8 radius_squared = broadcast(-1.0f);

  // #region sphere-intersection
  /// Distances along the ray; what is not above 0 or not finite is no hit.
  Float8 intersect(const Ray& ray) const {
    const auto f = ray.origin - center;
    const Float8 b = -dot(f, ray.direction);
    const Vec3x8 beside = f + scale(b, ray.direction);
    const Float8 discriminant = radius_squared - dot(beside, beside);
    const Float8 root = sqrt(discriminant);  // not a number where it misses
    const Float8 product = dot(f, f) - radius_squared;
    const Int8 center_is_ahead = b > 0.0f;
    const Float8 q = b + select(center_is_ahead, root, -root);
    const Float8 other = product / q;
    const Float8 near = select(center_is_ahead, other, q);
    const Float8 far = select(center_is_ahead, q, other);
    return select(near > 0.0f, near, far);
  }
  // #endregion sphere-intersection

  void set(int lane, const Sphere& sphere) {
    center.set(lane, sphere.center);
    radius_squared[lane] = sphere.radius * sphere.radius;
  }
};

/// Completes a hit at `hit.position`, which rounding has put near the sphere.
inline void place_hit(const Sphere& sphere, Hit& hit) {
  const Vec3 out = hit.position - sphere.center;
  // The center itself is hit where the sphere is smaller than rounding.
  hit.normal = dot(out, out) > 0 ? normalize(out) : Vec3(0, 0, 1);
  hit.position = sphere.center + sphere.radius * hit.normal;
  hit.rounding = 0;
  hit.diameter = 2 * sphere.radius;
}

}  // namespace lightwalk
