#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "common/math/vector.hpp"

namespace lightwalk {

/// The names of a color's three numbers.
inline constexpr std::array channel_names = {"red", "green", "blue"};

/// Linear colors, row by row from the top, each row from the left.
struct Image {
  int width = 0, height = 0;
  std::vector<Vec3> pixels;

  Image() = default;
  Image(int width_, int height_)
      : width(width_),
        height(height_),
        pixels(static_cast<std::size_t>(width_) *
               static_cast<std::size_t>(height_)) {}

  Vec3& at(int column, int row) { return pixels[index(column, row)]; }
  const Vec3& at(int column, int row) const {
    return pixels[index(column, row)];
  }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(column);
  }
};

}  // namespace lightwalk
