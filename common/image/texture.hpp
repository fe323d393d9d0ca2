#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace lightwalk {

/// Colors as an image file stores them: sRGB bytes, row 0 at the top.
struct Texture {
  int width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 3>> texels;

  const std::array<std::uint8_t, 3>& at(int column, int row) const {
    return texels[static_cast<std::size_t>(row) *
                      static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column)];
  }
};

}  // namespace lightwalk
