#pragma once

// # Which way up
//
// Cameras store pictures as the sensor lay and note how to turn them: EXIF's
// orientation, 1 to 8. It names the edges of the upright picture that the
// stored first row and first column are:
//
// | | first row | first column | |
// |---|---|---|---|
// | 1 | top | left | upright |
// | 2 | top | right | mirrored |
// | 3 | bottom | right | turned by 180 degrees |
// | 4 | bottom | left | upside down |
// | 5 | left | top | transposed |
// | 6 | right | top | turn it clockwise |
// | 7 | right | bottom | transposed the other way |
// | 8 | left | bottom | turn it counterclockwise |

#include <cstddef>
#include <utility>
#include <vector>

namespace lightwalk {

/// Turns pixels, stored row by row from the top, upright. An orientation that
/// is not from 2 to 8 changes nothing.
template <class Pixel>
void turn_upright(int orientation, int& width, int& height,
                  std::vector<Pixel>& pixels) {
  if (orientation < 2 || orientation > 8) return;
  const auto columns = static_cast<std::size_t>(width);
  const auto rows = static_cast<std::size_t>(height);
  const bool transposed = orientation >= 5;
  const bool from_right = orientation == 2 || orientation == 3 ||
                          orientation == 6 || orientation == 7;
  const bool from_bottom = orientation == 3 || orientation == 4 ||
                           orientation == 7 || orientation == 8;
  const std::size_t new_columns = transposed ? rows : columns;
  const std::size_t new_rows = transposed ? columns : rows;
  std::vector<Pixel> upright(pixels.size());
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      std::size_t x = transposed ? row : column;
      std::size_t y = transposed ? column : row;
      if (from_right) x = new_columns - 1 - x;
      if (from_bottom) y = new_rows - 1 - y;
      upright[y * new_columns + x] = pixels[row * columns + column];
    }
  }
  pixels = std::move(upright);
  if (transposed) std::swap(width, height);
}

}  // namespace lightwalk
