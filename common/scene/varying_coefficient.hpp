#pragma once

// Coefficients that are not the same everywhere, as a scene file describes
// them. A stage evaluates them at a point.

#include "common/image/texture.hpp"
#include "common/math/vector.hpp"

namespace lightwalk {

enum class VaryingType {
  image,             ///< the texture, over uv
  checker,           ///< squares of `first` and `second` over uv
  position_checker,  ///< cubes of `first` and `second` over the position
  schlick,           ///< `first` at normal incidence, `second` at grazing
};

/// One of kd, ks or kt, as a function of place or of viewing direction.
struct VaryingCoefficient {
  VaryingType type;
  Vec3 first{0}, second{0};
  float scale = 1;  ///< checks per unit of uv or of length
  const Texture* texture = nullptr;
};

}  // namespace lightwalk
