#pragma once

// # The camera
//
// A pinhole at `origin`. The image plane is centered at `origin + forward`,
// and reaches from there by `left` to its left edge and by `up` to its upper:
// with $|L| = 1$ and $|F| = 3$ the picture is 2 wide at distance 3. Column 0
// is at the left, row 0 at the top. The three vectors need not be
// perpendicular, nor of the same length.

#include "common/geometry/ray.hpp"
#include "common/math/vector.hpp"

namespace lightwalk {

struct Camera {
  Vec3 origin{0, 0, -3.5f};
  Vec3 left{-1, 0, 0};
  Vec3 up{0, 1, 0};
  Vec3 forward{0, 0, 3};
  int width = 256, height = 256;  ///< in pixels

  /// The ray through a point of a pixel; `u` = (0, 0) is the pixel's upper
  /// left corner. Uniform `u` in [0, 1)^2 averages over the pixel's area.
  Ray ray(int column, int row, const Vec2& u) const {
    return {origin, direction<Vec3>(static_cast<float>(column) + u.x,
                                    static_cast<float>(row) + u.y)};
  }

  /// The direction to a point of the picture, in pixels from the upper left
  /// corner: `Vector` is a Vec3, or a row of them (see stage 6).
  template <class Vector, class Number>
  Vector direction(const Number& column, const Number& row) const {
    const Number across = column / static_cast<float>(width);
    const Number down = row / static_cast<float>(height);
    return normalize(forward + (1.0f - 2.0f * across) * Vector(left) +
                     (1.0f - 2.0f * down) * Vector(up));
  }
};

}  // namespace lightwalk
