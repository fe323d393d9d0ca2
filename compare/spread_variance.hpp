#pragma once

// # What a picture has missed
//
// Stage 1 finds a small lamp by chance. Where none of a tile's paths found it,
// the tile is dark, and so is its variance: it does not know how wrong it may
// be. Its neighbors know. So in a picture that is much noisier than the other
// a pixel's variance is at least the mean variance around it.

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "common/image/render_result.hpp"

namespace lightwalk {

/// Raises the variance of each pixel to the mean over the at most 17x17 pixels
/// around it.
inline void spread_variance(RenderResult& result) {
  constexpr int reach = 8;
  const int width = result.variance.width, height = result.variance.height;
  const auto index = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width + 1) +
           static_cast<std::size_t>(x);
  };
  // sums at (x, y): over all pixels to the left and above.
  std::vector<std::array<double, 3>> sums(index(0, height + 1));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto c = [&](std::size_t i) {
        return static_cast<double>(
                   result.variance.at(x, y)[static_cast<int>(i)]) +
               sums[index(x, y + 1)][i] + sums[index(x + 1, y)][i] -
               sums[index(x, y)][i];
      };
      sums[index(x + 1, y + 1)] = {c(0), c(1), c(2)};
    }
  }
  for (int y = 0; y < height; ++y) {
    const int top = std::max(0, y - reach),
              end = std::min(height, y + reach + 1);
    for (int x = 0; x < width; ++x) {
      const int left = std::max(0, x - reach);
      const int right = std::min(width, x + reach + 1);
      const double pixels = (end - top) * (right - left);
      for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<std::size_t>(c);
        const double sum =
            sums[index(right, end)][i] - sums[index(left, end)][i] -
            sums[index(right, top)][i] + sums[index(left, top)][i];
        float& own = result.variance.at(x, y)[c];
        own = std::max(own, static_cast<float>(sum / pixels));
      }
    }
  }
}

}  // namespace lightwalk
