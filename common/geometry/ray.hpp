#pragma once

// # Rays and hits

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/math/vector.hpp"

namespace lightwalk {

struct Light;
struct Material;

/// A slot that no shape has: see Geometry.
inline constexpr std::int32_t no_slot = -1;

/// A half-line. `direction` is a unit vector. `origin_slot` is the slot of
/// the shape that it starts on. The ray meets that shape again at the
/// distance `self_hit_distance`, or never where that is not above 0.
struct Ray {
  Vec3 origin, direction;
  std::int32_t origin_slot = no_slot;
  float self_hit_distance = 0;
};

enum class ShapeType : std::uint8_t { plane, sphere, rectangle, triangle };
inline constexpr std::array<std::string_view, 4> shape_names = {
    "plane", "sphere", "rectangle", "triangle"};

/// The name of a shape in messages.
inline std::string shape_name(ShapeType type) {
  return std::string(shape_names[static_cast<std::size_t>(type)]);
}

/// Where a ray meets a surface.
struct Hit {
  float distance;  ///< from the ray's origin
  Vec3 position;   ///< on the surface, to rounding
  Vec3 normal;     ///< unit, outwards: the shape's own, not turned to the ray
  float rounding;  ///< how far off the surface `position` may be
  float diameter;  ///< of a sphere; 0 for what is flat
  std::int32_t slot;  ///< the shape's, as Geometry counts them
  ShapeType shape_type;
  std::uint32_t shape_index;  ///< among the scene's shapes of that type
  const Material* material;
  const Light* light;  ///< the light that the shape is; null if it is none
};

// ## Leaving a surface
//
// A hit's position is rounded to floats, so it lies a little above or below
// its surface. A ray that starts there would often meet the same surface
// again at once. Half of the floor is then in its own shadow, in a pattern of
// black dots that is called shadow acne.
//
// The usual cure starts the ray a small step away from the surface, and is
// never right: a step that is large enough for acne jumps over whatever is
// thinner, a pane of glass or the gap under a ball.
//
// But we know where a ray can meet the shape that it leaves again. Something
// flat: nowhere. A sphere: outside nowhere, and inside at one point on the
// far side. A chord of a sphere of diameter $2r$ that makes an angle $\theta$
// with the normal has the length $2r\,|\cos\theta|$. So a ray carries the
// shape that it leaves and the distance to that point, and this shape is not
// intersected like the others.
//
// What remains is rounding itself: in a position on something flat, the last
// of 24 bits is off. The ray starts that far in front of the surface, so that
// a neighbor in the same plane is behind it. It does not start much farther
// off, because every step into a room makes the room smaller: 10 km from the
// origin, the step is 1 mm.

// #region leave-surface
/// How far a hit may be off something flat, relative to the hit's largest
/// coordinate: one unit in the last place.
inline constexpr float flat_rounding = 0x1p-23f;

/// The origin of a ray that leaves the surface at `hit` in `direction`.
inline Vec3 leave(const Hit& hit, const Vec3& direction) {
  const float side = std::copysign(1.0f, dot(direction, hit.normal));
  return hit.position + side * hit.rounding * hit.normal;
}
// #endregion leave-surface

// #region spawn-ray
/// The ray that leaves the surface at `hit` in the unit vector `direction`.
inline Ray spawn_ray(const Hit& hit, const Vec3& direction) {
  const float cos_theta = dot(direction, hit.normal);
  return {leave(hit, direction), direction, hit.slot,
          -hit.diameter * cos_theta};
}
// #endregion spawn-ray

/// The hit's normal, turned to the side that `direction` is on.
inline Vec3 normal_towards(const Hit& hit, const Vec3& direction) {
  return std::copysign(1.0f, dot(hit.normal, direction)) * hit.normal;
}

}  // namespace lightwalk
