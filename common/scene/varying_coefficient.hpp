#pragma once

// Coefficients that are not the same everywhere: what a scene file says of
// them. What they are at a given point, a stage says.

#include "common/image/texture.hpp"
#include "common/math/vector.hpp"

namespace lightwalk {

enum class VaryingType {
  image,             ///< the texture, over uv
  checker,           ///< squares of `first` and `second` over uv
  position_checker,  ///< cubes of `first` and `second` over the position
  schlick,           ///< from `first`, seen squarely, to `second`, at grazing
};

/// One of kd, ks or kt, as a function of place or of viewing direction.
struct VaryingCoefficient {
  VaryingType type;
  Vec3 first{0}, second{0};
  float scale = 1;  ///< checks per unit
  const Texture* texture = nullptr;
};

}  // namespace lightwalk
