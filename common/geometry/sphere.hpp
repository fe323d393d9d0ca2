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
//   is the part of $f$ perpendicular to the ray: nothing large is subtracted.
// - With $b = -f \cdot \omega$, one root is $q = b \pm \sqrt{\cdot}$ with the
//   sign that adds, the other is $(f \cdot f - r^2) / q$.
//
// Of a sphere of the size of the Earth, under a house, $f$ itself is rounded
// to half a meter. What $f \cdot f - r^2$ needs is the distance from the
// sphere, not from its center: let $a$ be the point of the sphere that is
// nearest to the scene's origin, $g = o - a$ and $s = a - c$. Then
// $f = g + s$ and $s \cdot s = r^2$, and what remains is $g \cdot (g + 2s)$.
//
// Of the two roots, the nearest one ahead counts. From inside, the near root
// lies behind: with that root alone a ray could never leave the sphere again.

#include "common/geometry/lanes.hpp"
#include "common/geometry/ray.hpp"

namespace lightwalk {

struct Sphere {
  Vec3 center;
  float radius;
  const Material* material;
  const Light* light = nullptr;  ///< the scene's light that it is, if any
};

/// What it takes to intersect spheres: eight with one ray, or one with many.
template <class Vector, class Number>
struct SphereIntersector {
  Vector center;
  Number radius_squared;
  bool has_large = false;
  Vector anchor, spoke;  // of a large sphere
  Number error;          // spoke . spoke - r^2

  // #region sphere-intersection
  /// Distances along the ray; what is not above 0 or not finite is no hit.
  template <class Rays>
  auto intersect(const Rays& ray) const {
    const auto f = ray.origin - center;
    const auto b = -dot(f, ray.direction);
    const auto beside = f + b * ray.direction;
    const auto discriminant = radius_squared - dot(beside, beside);
    const auto root = sqrt(discriminant);  // not a number where it misses
    const auto product =
        has_large ? product_of_roots(ray) : dot(f, f) - radius_squared;
    const auto center_is_ahead = b > 0.0f;
    const auto q = b + select(center_is_ahead, root, -root);
    const auto other = product / q;
    const auto first = select(center_is_ahead, other, q);
    const auto second = select(center_is_ahead, q, other);
    return select(first > 0.0f, first, second);
  }
  // #endregion sphere-intersection

  /// The same as f . f - r^2, with all its digits if a sphere is large.
  template <class Rays>
  auto product_of_roots(const Rays& ray) const {
    const auto g = ray.origin - anchor;
    return dot(g, g + spoke + spoke) + error;
  }
};

// For a ray from near the scene's origin, the plain $f \cdot f - r^2$ has six
// roundings, each of up to $2^{-24} r^2$: five in the square of $f$, one in
// that of $r$. They move a hit straight ahead by up to $3r \cdot 2^{-24}$.
// Where $r$ is 16 times the origin's distance from the sphere, this is
// $48 \cdot 2^{-24}$ of that distance. The 16 is chosen: beyond it a sphere
// counts as large. tests/core/test_leaving_surfaces.cpp bounds the error of
// spheres that are 100 to 100,000 times as large as their distance.

inline SphereIntersector<Vec3, float> intersector_of(const Sphere& sphere) {
  const DoubleVec3 c(sphere.center);
  const auto r = static_cast<double>(sphere.radius);
  const double away = length(c);
  const bool large = r > 16 * std::abs(away - r);
  const Vec3 anchor = large ? Vec3(c * (1 - r / away)) : sphere.center;
  const DoubleVec3 spoke = DoubleVec3(anchor) - c;
  return {.center = sphere.center,
          .radius_squared = sphere.radius * sphere.radius,
          .has_large = large,
          .anchor = anchor,
          .spoke = Vec3(spoke),
          .error = static_cast<float>(dot(spoke, spoke) - r * r)};
}

/// Eight spheres. A lane that is not set is hit by no ray.
struct SpherePack : SphereIntersector<Vec3x8, Float8> {
  SpherePack() {
    radius_squared = broadcast(-1.0f);
    error = broadcast(0.0f);
  }

  void set(int lane, const Sphere& sphere) {
    const auto form = intersector_of(sphere);
    center.set(lane, form.center);
    radius_squared[lane] = form.radius_squared;
    has_large = has_large || form.has_large;
    anchor.set(lane, form.anchor);
    spoke.set(lane, form.spoke);
    error[lane] = form.error;
  }
};

/// Completes a hit at `hit.position`, which rounding has put near the sphere,
/// and moves it back by `back` along the sphere.
inline void snap_to_surface(const Sphere& sphere, const Vec3& back,
                            Hit& hit) {
  const DoubleVec3 center(sphere.center);
  const DoubleVec3 out = DoubleVec3(hit.position) - center;
  // The center itself is hit where the sphere is smaller than rounding.
  const DoubleVec3 normal =
      dot(out, out) > 0 ? normalize(out) : DoubleVec3(0, 0, 1);
  hit.normal = Vec3(normal);
  const Vec3 along = back - dot(back, hit.normal) * hit.normal;
  hit.position = Vec3(center + static_cast<double>(sphere.radius) * normal -
                      DoubleVec3(along));
  hit.rounding = 0;
  hit.diameter = 2 * sphere.radius;
}

}  // namespace lightwalk
