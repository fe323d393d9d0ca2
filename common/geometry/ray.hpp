#pragma once

// # Rays and hits

#include <cstdint>

#include "common/math/vector.hpp"

namespace lightwalk {

struct Material;

/// A half-line. `direction` is a unit vector.
struct Ray {
  Vec3 origin, direction;
};

enum class ShapeType : std::uint8_t { plane, sphere, rectangle, triangle };

/// Where a ray meets a surface.
struct Hit {
  float distance;  ///< from the ray's origin
  Vec3 position;   ///< on the surface, to rounding
  Vec3 normal;     ///< unit, outwards: the shape's own, not turned to the ray
  float magnitude;  ///< the size of the numbers `position` was made from
  ShapeType shape_type;
  std::uint32_t shape_index;  ///< among the scene's shapes of that type
  const Material* material;
};

// ## Leaving a surface
//
// A hit point is rounded to floats, so it lies a little above or below its
// surface, and a ray that starts exactly there may hit the same surface again
// at once: half of the floor is then in its own shadow, in a pattern of black
// dots. So a ray starts a little off the surface, along the normal, on the
// side that it leaves to.
//
// How little? Floats have 24 bits, so rounding moves a coordinate of 1 by up
// to $6 \cdot 10^{-8}$, and a coordinate of 1000 by a thousand times as much.
// A fixed offset that suits the box near the origin is lost in the rounding a
// kilometre away, and one that suits the far end lets light leak under the
// spheres here. The offset is therefore in proportion to the size of the
// numbers that the position was computed from: 2^-16 of it, some 256
// roundings.

// #region leave-surface
inline constexpr float surface_offset = 0x1p-16f;

/// `position` moved off its surface, to the side that `direction` points to.
inline Vec3 off_surface(const Vec3& position, const Vec3& normal,
                        float magnitude, const Vec3& direction) {
  const float offset =
      std::copysign(surface_offset * magnitude, dot(direction, normal));
  return position + offset * normal;
}

/// Where a ray in `direction` starts that leaves the surface at `hit`.
inline Vec3 leave(const Hit& hit, const Vec3& direction) {
  return off_surface(hit.position, hit.normal, hit.magnitude, direction);
}

/// The ray that leaves the surface at `hit` in the unit vector `direction`.
inline Ray spawn_ray(const Hit& hit, const Vec3& direction) {
  return {leave(hit, direction), direction};
}
// #endregion leave-surface

/// The hit's normal, turned to the side that `direction` is on.
inline Vec3 normal_towards(const Hit& hit, const Vec3& direction) {
  return std::copysign(1.0f, dot(hit.normal, direction)) * hit.normal;
}

}  // namespace lightwalk
