#pragma once

// # Lights
//
// Light comes from points, which no ray can hit, and from surfaces with an
// emission `ke`. Rectangles and spheres that emit are also listed here, so
// that a point on them can be chosen. On an infinite plane no point can be
// chosen. Emitting planes and triangles are found only by rays that happen to
// hit them.

#include <variant>

#include "common/math/vector.hpp"

namespace lightwalk {

struct PointLight {
  Vec3 center;
  Vec3 intensity;  ///< radiant intensity, W/sr
};

/// Emits `radiance` on the side of its normal, edge_u x edge_v.
struct RectangleLight {
  Vec3 corner, edge_u, edge_v;
  Vec3 radiance;  ///< W/(m^2 sr)
};

/// Emits `radiance` outward.
struct SphereLight {
  Vec3 center;
  float radius;
  Vec3 radiance;  ///< W/(m^2 sr)
};

/// One light of a scene. Shapes that are lights point to it.
struct Light {
  std::variant<PointLight, RectangleLight, SphereLight> form;
};

}  // namespace lightwalk
