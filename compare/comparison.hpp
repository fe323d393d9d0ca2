#pragma once

// # Are two pictures the same?
//
// Two renders of one scene are never equal: each pixel is a mean of random
// samples. They are the same if their own noise explains the difference, and
// the variance beside each mean says how large that noise is.
//
// A single pixel's few samples are nowhere near a normal distribution: one
// bright path that one of the two happened to find is enough to fail it. So
// whole regions are compared, over which such paths average out: the image,
// for an error that is everywhere, and tiles of 8x8 and 4x4 pixels, for one
// that is in one place. A missing caustic is 3 % of the image and 64 % of its
// tile.
//
// For each region and channel, $d$ is the difference of the two means, and
//
// $$s^2 = \sum \frac{\max(v_a, v_b)}{|T|^2 n_a} + \sum \frac{v_b}{|T|^2 n_b},
// \qquad z = \frac{\max(0, |d| - \text{band})}{s}$$
//
// with $v$ the variance of one sample, $n$ the samples per pixel and $|T|$
// the pixels of the region. The larger variance counts, because a picture
// that missed the rare bright paths underestimates its noise; it counts for a
// reference of fewer samples, too. The band is what may differ for reasons
// that are not errors: the last digits of another compiler, and the
// reference's own error.
//
// Subr and Arvo test renderers with statistics of this kind ("Statistical
// Hypothesis Testing for Assessing Monte Carlo Estimators: Applications to
// Image Synthesis", Pacific Graphics 2007). So do Jung, Hanika and
// Dachsbacher, pixel by pixel or region by region ("Detecting Bias in Monte
// Carlo Renderers using Welch's t-test", JCGT 9(2), 2020): with $v_a$ for the
// larger variance and without a band, $z$ is the size of Welch's $t$.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/image/render_result.hpp"

namespace lightwalk {

/// A part of an image, in pixels.
struct Region {
  int left, top, width, height;
  bool operator==(const Region&) const = default;
};

/// How much a region's mean may differ without being an error, as a share of
/// the reference's mean. The bands are chosen. tests/core/test_comparison.cpp
/// checks that without noise 0.9 % passes and 2 % fails.
struct Bands {
  double image = 0.01;  ///< of the image's mean, for the whole image
  double tile = 0.02;   ///< of the tile's mean, for a tile
  double floor = 1e-4;  ///< of the image's mean, everywhere
  /// Beyond it a region differs. Normal noise is beyond 4.4 with a
  /// probability of 1.1e-5, and the second look squares this: see below.
  double z_critical = 4.4;
};

/// The result of comparing one region in one channel.
struct RegionDifference {
  Region region{};
  int channel = 0;
  double test = 0, reference = 0;  ///< means over the region
  double sigma = 0;                ///< standard deviation expected of them
  double z = 0;                    ///< beyond the band, in units of sigma

  /// Written so that a NaN is not the same.
  bool same(const Bands& bands) const { return z <= bands.z_critical; }
  /// 1 where the test's mean is larger, -1 where it is smaller.
  int sign() const { return test < reference ? -1 : 1; }
};

/// The mean of an image's channel over a region.
inline double mean_over(const Image& image, const Region& region,
                        int channel) {
  double sum = 0;
  for (int y = region.top; y < region.top + region.height; ++y) {
    for (int x = region.left; x < region.left + region.width; ++x) {
      sum += static_cast<double>(image.at(x, y)[channel]);
    }
  }
  return sum / (region.width * region.height);
}

/// Compares one region in one channel. Both images must have variances.
inline RegionDifference compare_region(const RenderResult& test,
                                       const RenderResult& reference,
                                       const Region& region, int channel,
                                       double band) {
  const double n_a = test.info.samples_per_pixel;
  const double n_b = reference.info.samples_per_pixel;
  double test_variance = 0, reference_variance = 0;
  for (int y = region.top; y < region.top + region.height; ++y) {
    for (int x = region.left; x < region.left + region.width; ++x) {
      const auto a = static_cast<double>(test.variance.at(x, y)[channel]);
      const auto b =
          static_cast<double>(reference.variance.at(x, y)[channel]);
      test_variance += a < b ? b : a;
      reference_variance += a > b && n_a > n_b ? a : b;
    }
  }
  const double pixels = region.width * region.height;
  RegionDifference result{region, channel};
  result.test = mean_over(test.radiance, region, channel);
  result.reference = mean_over(reference.radiance, region, channel);
  result.sigma =
      std::sqrt(test_variance / n_a + reference_variance / n_b) / pixels;
  const double excess = std::abs(result.test - result.reference) - band;
  result.z = excess <= 0 ? 0 : excess / result.sigma;
  return result;
}

/// The factor by which tiles are larger than 8x8 and 4x4 pixels, so that the
/// smaller ones hold 4096 samples: enough for a mean that is nearly normal.
inline int tile_scale(const RenderResult& test,
                      const RenderResult& reference) {
  const double samples =
      std::min(test.info.samples_per_pixel, reference.info.samples_per_pixel);
  int scale = 1;
  while (samples * 16 * scale * scale < 4096 && scale < 1024) scale *= 2;
  return scale;
}

/// The image, and its tiles of 8x8 and 4x4 pixels, both times `scale`; at the
/// edges smaller ones. `steps` of a tile lead to the next tile.
inline std::vector<Region> regions_of(int width, int height, int scale,
                                      int steps = 1) {
  std::vector<Region> regions{{0, 0, width, height}};
  for (const int size : {8 * scale, 4 * scale}) {
    if (size >= std::max(width, height)) continue;
    for (int top = 0; top < height; top += size / steps) {
      for (int left = 0; left < width; left += size / steps) {
        regions.push_back({left, top, std::min(size, width - left),
                           std::min(size, height - top)});
      }
    }
  }
  return regions;
}

/// These, tiles moved by half their size, and rows and columns that are wide
/// enough to hold as many pixels as a small tile.
inline std::vector<Region> more_regions_of(int width, int height, int scale) {
  std::vector<Region> regions = regions_of(width, height, scale, 2);
  const int pixels = 16 * scale * scale;
  const int high = std::min(height, (pixels + width - 1) / width);
  for (int top = 0; top + high <= height; top += high) {
    regions.push_back({0, top, width, high});
  }
  const int wide = std::min(width, (pixels + height - 1) / height);
  for (int left = 0; left + wide <= width; left += wide) {
    regions.push_back({left, 0, wide, height});
  }
  return regions;
}

/// Every region in every channel, the image's own three first.
inline std::vector<RegionDifference> compare_regions(
    const RenderResult& test, const RenderResult& reference,
    const Bands& bands, const std::vector<Region>& regions) {
  const Image& image = reference.radiance;
  std::vector<RegionDifference> result;
  for (const Region& region : regions) {
    for (int channel = 0; channel < 3; ++channel) {
      const double whole = std::abs(mean_over(image, regions[0], channel));
      const double own = std::abs(mean_over(image, region, channel));
      const double share = region == regions[0] ? bands.image : bands.tile;
      result.push_back(compare_region(test, reference, region, channel,
                                      share * own + bands.floor * whole));
    }
  }
  return result;
}

inline std::vector<RegionDifference> compare_regions(
    const RenderResult& test, const RenderResult& reference,
    const Bands& bands, int scale) {
  return compare_regions(
      test, reference, bands,
      regions_of(reference.radiance.width, reference.radiance.height, scale));
}

// Two pictures may agree in each region and be different: two columns are
// exchanged, or a texture is shifted by a pixel. Then pixels are further
// apart than their noise, and a sum over the picture shows it:
//
// $$S = \sum t^2 = \sum \frac{(a - b)^2}{v_a/n_a + v_b/n_b}$$
//
// Without an error the mean of $t^2$ is Student's, $\nu/(\nu - 2)$, and a
// rare bright path makes no large $t$: its pixel's variance has it, too. A
// picture of fewer samples misses more such paths, so there the larger
// variance counts for both. A difference of the band adds its own square to
// $(a - b)^2$.

struct PixelSum {
  double times = 0;  ///< S over what noise makes; the worst channel's
  double z = 0;      ///< of S, a chi-squared sum (Wilson and Hilferty, 1931)
};

/// Of all pixels, or of squares of pixels that hold 64 samples.
inline PixelSum sum_over_pixels(const RenderResult& test,
                                const RenderResult& reference,
                                const Bands& bands) {
  const Image& image = reference.radiance;
  const double n_a = test.info.samples_per_pixel;
  const double n_b = reference.info.samples_per_pixel;
  int size = 1;
  while (std::min(n_a, n_b) * size * size < 64) size *= 2;
  const double nu = std::min(n_a, n_b) * size * size - 1;
  PixelSum result{0, -HUGE_VAL};
  for (int c = 0; c < 3; ++c) {
    const double whole =
        mean_over(image, {0, 0, image.width, image.height}, c);
    double sum = 0, count = 0;
    for (int top = 0; top + size <= image.height; top += size) {
      for (int left = 0; left + size <= image.width; left += size) {
        const Region square{left, top, size, size};
        const double b = mean_over(image, square, c);
        const double d = std::abs(mean_over(test.radiance, square, c) - b);
        double v_a = mean_over(test.variance, square, c);
        double v_b = mean_over(reference.variance, square, c);
        if (n_a != n_b) v_a = v_b = std::max(v_a, v_b);
        const double variance = (v_a / n_a + v_b / n_b) / (size * size);
        const double band = bands.tile * b + bands.floor * whole;
        // Where the noise is less than the band, only the rest counts.
        const double rest = std::max(0.0, d - band);
        const bool quiet = variance < band * band;
        const double excess = quiet ? rest * rest : d * d - band * band;
        if (excess == 0 && variance == 0) continue;
        sum += excess / variance;
        count += nu / (nu - 2);
      }
    }
    const double e = 2 / (9 * count);
    const double z = (std::cbrt(sum / count) - 1 + e) / std::sqrt(e);
    if (count > 0 && !(z <= result.z)) result = {sum / count, z};
  }
  return result;
}

/// How many of `count` correct comparisons are expected beyond z, of either
/// sign, if they are normal.
inline double false_alarm_rate(double z, double count) {
  return count * std::erfc(z / std::sqrt(2.0));
}

/// Renders a picture anew: with this many samples per pixel, and this seed.
using Rerender = std::function<RenderResult(int samples, std::uint64_t seed)>;

/// The outcome of a comparison, all regions and those that differ for sure.
struct Comparison {
  std::vector<RegionDifference> all;        ///< of the first render
  std::vector<RegionDifference> again;      ///< of the last render
  std::vector<RegionDifference> suspected;  ///< beyond z_critical at first
  std::vector<RegionDifference> confirmed;  ///< and again with a fresh seed
  RenderResult test;                        ///< the last render

  bool same() const { return confirmed.empty(); }

  /// How often a comparison like this rejects a correct program: a region
  /// must be off by chance twice, the second time to the same side.
  double false_alarms(const Bands& bands) const {
    const double once = false_alarm_rate(bands.z_critical, 1);
    return static_cast<double>(all.size()) * once * once / 2;
  }
};

// A few thousand regions are compared in a run, and at 4.4 sigma one in a
// hundred thousand is off by chance alone. Hence a second look, with four
// times as many fresh samples: a region fails only if it is off again, and to
// the same side. By chance this happens once in several million runs.

/// Compares a program's render with a reference; renders once more, with four
/// times the samples and another seed, if a region looks different.
inline Comparison compare_with_reference(const Rerender& rerender,
                                         int samples, std::uint64_t seed,
                                         const RenderResult& reference,
                                         const Bands& bands = {}) {
  Comparison result;
  result.test = rerender(samples, seed);
  const int scale = tile_scale(result.test, reference);
  result.all = compare_regions(result.test, reference, bands, scale);
  for (const RegionDifference& one : result.all) {
    if (!one.same(bands)) result.suspected.push_back(one);
  }
  result.again = result.all;
  if (result.suspected.empty()) return result;
  result.test = rerender(4 * samples, seed + 0x9e3779b9);
  result.again = compare_regions(result.test, reference, bands, scale);
  for (std::size_t i = 0; i < result.again.size(); ++i) {
    const RegionDifference& second = result.again[i];
    if (!result.all[i].same(bands) && !second.same(bands) &&
        second.sign() == result.all[i].sign()) {
      result.confirmed.push_back(second);
    }
  }
  return result;
}

/// Sum of the test's variances over the reference's, all channels.
inline double variance_ratio(const RenderResult& test,
                             const RenderResult& reference) {
  double a = 0, b = 0;
  for (std::size_t i = 0; i < reference.variance.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      a += static_cast<double>(test.variance.pixels[i][c]);
      b += static_cast<double>(reference.variance.pixels[i][c]);
    }
  }
  return a / b;
}

}  // namespace lightwalk
