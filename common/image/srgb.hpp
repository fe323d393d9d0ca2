#pragma once

// Image files that hold colors for a screen store them by the sRGB curve
// (IEC 61966-2-1), which spends most of the 256 steps on dark colors.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace lightwalk {

/// The linear value, 0 to 1, that an sRGB byte stands for.
inline float srgb_to_linear(std::uint8_t byte) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double x = static_cast<double>(i) / 255;
      values[i] = static_cast<float>(
          x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
    }
    return values;
  }();
  return table[byte];
}

}  // namespace lightwalk
