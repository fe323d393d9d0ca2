#pragma once

// # Rays and hits of many paths

#include "common/geometry/ray.hpp"
#include "stages/6_many_paths/rows/vector_row.hpp"

#ifdef LIGHTWALK_ROWS

namespace lightwalk {

/// A Ray in each lane. `origin_slot` is a line of the ShapeTable, or no_slot.
struct Rays {
  Vec3s origin, direction;
  Ints origin_slot{no_slot};
  Floats self_hit_distance{0.0f};
};

/// What the ray of each lane meets: a Hit each.
struct Hits {
  Mask found;
  Floats distance;
  Vec3s position, normal;
  Floats rounding, diameter;
  Ints line;  ///< the shape's, in the ShapeTable
};

// The formulas of geometry/ray.hpp.

HWY_INLINE Vec3s normal_towards(const Hits& hit, const Vec3s& direction) {
  return copysign(1.0f, dot(hit.normal, direction)) * hit.normal;
}
HWY_INLINE Vec3s leave(const Hits& hit, const Vec3s& direction) {
  const Floats side = copysign(1.0f, dot(direction, hit.normal));
  return hit.position + side * hit.rounding * hit.normal;
}
HWY_INLINE Rays spawn_rays(const Hits& hit, const Vec3s& direction) {
  const Floats cos_theta = dot(direction, hit.normal);
  return {leave(hit, direction), direction, hit.line,
          -hit.diameter * cos_theta};
}

}  // namespace lightwalk

#endif
