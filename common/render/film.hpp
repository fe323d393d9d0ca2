#pragma once

// # The film
//
// Each pixel keeps the mean of its samples and how much they scatter about
// it. The variance says how noisy the pixel is: the mean of $n$ samples is
// off by about $\sqrt{\mathrm{variance}/n}$. Without that number we cannot
// tell whether two pictures differ or are two throws of the same dice.
// Both are updated sample by sample (Welford, Technometrics 4(3), 1962), in
// double precision: a float's 24 bits are spent after a few million samples.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "common/image/image.hpp"
#include "common/image/render_result.hpp"
#include "common/math/vector.hpp"

namespace lightwalk {

/// The running statistics of one pixel.
struct Pixel {
  double mean[3] = {0, 0, 0};     ///< of the samples, W/(m^2 sr)
  double squares[3] = {0, 0, 0};  ///< sum of squared differences to the mean
  std::uint32_t samples = 0;
  std::uint32_t dropped = 0;        ///< samples that were not finite
  std::uint32_t first_dropped = 0;  ///< number of the first of them

  /// Adds the next sample, or counts it as dropped if it is not finite.
  void add(const Vec3& radiance) {
    if (!is_finite(radiance)) {
      if (dropped == 0) first_dropped = samples;
      ++dropped;
      return;
    }
    ++samples;
    const double share = 1.0 / samples;
    for (int c = 0; c < 3; ++c) {
      const double x = radiance[c];
      const double before = x - mean[c];
      mean[c] += before * share;
      squares[c] += before * (x - mean[c]);
    }
  }

  /// The unbiased variance of one sample, (W/(m^2 sr))^2; 0 below two.
  double variance(int channel) const {
    return samples < 2 ? 0 : squares[channel] / (samples - 1);
  }
};

/// Where a pixel is in the picture, counted row by row from the top.
inline std::size_t pixel_index(int width, int column, int row) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
         static_cast<std::size_t>(column);
}

class Film {
 public:
  Film(int width, int height)
      : width_(width),
        height_(height),
        pixels_(static_cast<std::size_t>(width) *
                static_cast<std::size_t>(height)) {}

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t index(int column, int row) const {
    return pixel_index(width_, column, row);
  }
  Pixel& pixel(int column, int row) { return pixels_[index(column, row)]; }
  const std::vector<Pixel>& pixels() const { return pixels_; }

  /// Mean radiance of each pixel, W/(m^2 sr).
  Image radiance() const {
    return image([](const Pixel& p, int c) { return p.mean[c]; });
  }
  /// Variance of one sample of each pixel, (W/(m^2 sr))^2. That of the mean
  /// of n samples is 1/n of it. If a pixel is so bright that its variance
  /// does not fit in a float, this is the largest float.
  Image variance() const {
    return image([](const Pixel& p, int c) { return p.variance(c); });
  }

 private:
  template <class Value>
  Image image(Value value) const {
    Image result(width_, height_);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        constexpr double largest = std::numeric_limits<float>::max();
        result.pixels[i][c] =
            static_cast<float>(std::min(value(pixels_[i], c), largest));
      }
    }
    return result;
  }

  int width_, height_;
  std::vector<Pixel> pixels_;
};

/// The film as a picture. Adds to `info` how many samples there are, and
/// which were dropped.
inline RenderResult develop(const Film& film, RenderInfo info) {
  std::uint32_t fewest = std::numeric_limits<std::uint32_t>::max();
  for (int row = 0; row < film.height(); ++row) {
    for (int column = 0; column < film.width(); ++column) {
      const Pixel& pixel = film.pixels()[film.index(column, row)];
      const std::uint32_t samples = pixel.samples + pixel.dropped;
      fewest = std::min(fewest, samples);
      info.samples += samples;
      info.dropped += pixel.dropped;
      if (pixel.dropped > 0 && !info.first_dropped) {
        info.first_dropped = {column, row,
                              info.first_sample + pixel.first_dropped};
      }
    }
  }
  info.samples_per_pixel = fewest;
  return {film.radiance(), film.variance(), std::move(info)};
}

}  // namespace lightwalk
