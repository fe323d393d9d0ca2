#pragma once

#include "common/geometry/ray.hpp"
#include "common/scene/material.hpp"

namespace lightwalk {

/// Where a path is: a hit, as seen from where the path came from.
struct Surface {
  const Hit& hit;
  const Material& material;  ///< with the coefficients that it has here
  Vec3 wo;                   ///< unit, back along the path
  Vec3 normal;               ///< unit, on the side of wo

  Surface(const Hit& hit_, const Material& material_, const Vec3& wo_)
      : hit(hit_),
        material(material_),
        wo(wo_),
        normal(normal_towards(hit_, wo_)) {}
};

}  // namespace lightwalk
