#pragma once

// Coefficients that are not the same everywhere: what a scene file says of
// them. What they are at a given point, a stage says.

#include <array>
#include <cstdint>
#include <vector>

#include "common/vector.hpp"

namespace lightwalk {

/// Colours as an image file stores them: sRGB bytes, row 0 at the top.
struct Texture {
  int width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 3>> texels;

  const std::array<std::uint8_t, 3>& at(int column, int row) const {
    return texels[static_cast<std::size_t>(row) *
                      static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column)];
  }
};

enum class PatternType {
  image,             ///< the texture, over uv
  checker,           ///< squares of `first` and `second` over uv
  position_checker,  ///< cubes of `first` and `second` over the position
  schlick,           ///< from `first`, seen squarely, to `second`, at grazing
};

/// One of kd, ks or kt, as a function of place or of viewing direction.
struct Pattern {
  PatternType type;
  Vec3 first{0}, second{0};
  float scale = 1;  ///< checks per unit
  const Texture* texture = nullptr;
};

}  // namespace lightwalk
