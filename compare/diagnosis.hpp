#pragma once

// # Which mistake is it?
//
// A wrong picture often looks like itself only: forget the shadow ray and the
// light under the balls is there, wherever they stand. So the picture of each
// known mistake was rendered once, and its *signature* kept: mean and
// variance of each 4x4-pixel tile. A failing picture is compared with all of
// them by
//
// $$\chi^2 = \sum \frac{(\mathrm{test} - \mathrm{signature})^2}
// {\sigma_\mathrm{test}^2 + \sigma_\mathrm{signature}^2}$$
//
// over tiles and channels, and those that it cannot be told from are named.
// Another source is simpler: a factor that is everywhere the same and that is
// one of those which formulas are made of.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "common/image/render_result.hpp"
#include "compare/gamma_function.hpp"

namespace lightwalk {

/// Means and variances of the means of an image's 4x4 tiles, in all channels.
struct Signature {
  std::string mistake;
  std::vector<double> mean, variance;
};

inline Signature signature_of(const RenderResult& result,
                              const std::string& mistake) {
  constexpr int size = 4;
  Signature signature{mistake, {}, {}};
  for (int top = 0; top < result.radiance.height; top += size) {
    for (int left = 0; left < result.radiance.width; left += size) {
      const int right = std::min(left + size, result.radiance.width);
      const int bottom = std::min(top + size, result.radiance.height);
      const double pixels = (right - left) * (bottom - top);
      for (int channel = 0; channel < 3; ++channel) {
        double mean = 0, variance = 0;
        for (int y = top; y < bottom; ++y) {
          for (int x = left; x < right; ++x) {
            mean += static_cast<double>(result.radiance.at(x, y)[channel]);
            variance +=
                static_cast<double>(result.variance.at(x, y)[channel]);
          }
        }
        signature.mean.push_back(mean / pixels);
        signature.variance.push_back(variance / (pixels * pixels) /
                                     result.info.samples_per_pixel);
      }
    }
  }
  return signature;
}

/// The file of a stage's and scene's signatures: a line each, the mistake's
/// name and then mean and variance of each tile and channel in turn.
inline std::string signature_path(const std::string& folder, int stage,
                                  const std::string& scene) {
  return folder + "/stage" + std::to_string(stage) + "_" + scene + ".txt";
}

inline std::string signature_line(const Signature& signature) {
  std::string line = signature.mistake;
  for (std::size_t i = 0; i < signature.mean.size(); ++i) {
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, " %.4g %.2g", signature.mean[i],
                  signature.variance[i]);
    line += numbers;
  }
  return line;
}

/// Those that there are; none where there is no file.
inline std::vector<Signature> load_signatures(const std::string& folder,
                                              int stage,
                                              const std::string& scene) {
  std::vector<Signature> signatures;
  std::ifstream file(signature_path(folder, stage, scene));
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    Signature signature;
    words >> signature.mistake;
    for (double mean, variance; words >> mean >> variance;) {
      signature.mean.push_back(mean);
      signature.variance.push_back(variance);
    }
    signatures.push_back(std::move(signature));
  }
  return signatures;
}

/// How likely two signatures of one picture differ as much as these do. The
/// squared difference of a tile may be a thousandth of its mean by rounding.
inline double agreement(const Signature& a, const Signature& b) {
  if (a.mean.size() != b.mean.size()) return 0;
  double chi_squared = 0;
  for (std::size_t i = 0; i < a.mean.size(); ++i) {
    const double rounding = 1e-3 * std::max(std::abs(a.mean[i]), 1e-9);
    const double variance =
        2 * std::max(a.variance[i], b.variance[i]) + rounding * rounding;
    const double difference = a.mean[i] - b.mean[i];
    // A single tile with a rare bright path must not decide alone.
    chi_squared += std::min(difference * difference / variance, 25.0);
  }
  return upper_gamma(static_cast<double>(a.mean.size()) / 2, chi_squared / 2);
}

/// A factor that the whole picture is off by, and what it comes from.
struct TellingRatio {
  double ratio;
  const char* meaning;
};

inline constexpr TellingRatio telling_ratios[] = {
    {3.14159265, "pi: is a division by pi missing?"},
    {0.31830989, "1/pi: is it divided by pi twice?"},
    {6.28318531, "2 pi: is the density of uniform sampling multiplied?"},
    {0.15915494, "1/(2 pi): is the division by the density missing?"},
    {12.5663706, "4 pi: intensity is not power"},
    {0.07957747, "1/(4 pi): intensity is power per steradian already"},
    {2.0, "2: is something counted twice, or a cosine forgotten?"},
    {0.5, "1/2: is a hemisphere taken for a sphere?"},
    {0.66666667, "2/3: is there a cosine too many with cosine sampling?"},
    {2.25, "1.5^2: is the radiance factor applied once too often?"},
    {0.44444444, "1/1.5^2: is the radiance factor inverted, or left out?"},
};

/// The ratio test/golden, where all tiles agree on it; otherwise 0.
inline double common_ratio(const Signature& test, const Signature& golden) {
  double weighted = 0, weights = 0;
  for (std::size_t i = 0; i < golden.mean.size(); ++i) {
    if (!(golden.mean[i] > 0)) continue;
    const double ratio = test.mean[i] / golden.mean[i];
    const double variance =
        (test.variance[i] + golden.variance[i] * ratio * ratio) /
        (golden.mean[i] * golden.mean[i]);
    const double weight = 1 / std::max(variance, 1e-8);
    weighted += weight * ratio;
    weights += weight;
  }
  const double ratio = weighted / weights;
  int off = 0, counted = 0;
  for (std::size_t i = 0; i < golden.mean.size(); ++i) {
    if (!(golden.mean[i] > 0)) continue;
    ++counted;
    const double expected = ratio * golden.mean[i];
    const double sigma =
        std::sqrt(test.variance[i] + golden.variance[i] * ratio * ratio);
    if (std::abs(test.mean[i] - expected) > 4 * sigma + 0.02 * expected) {
      ++off;
    }
  }
  return off * 50 > counted ? 0 : ratio;
}

/// What the failing picture looks like: known mistakes that it agrees with,
/// or a telling ratio. Empty where nothing fits.
inline std::string diagnose(const RenderResult& test,
                            const RenderResult& golden,
                            const std::vector<Signature>& known) {
  const Signature mine = signature_of(test, "yours");
  std::vector<std::pair<double, std::string>> fits;
  for (const Signature& signature : known) {
    const double p = agreement(mine, signature);
    if (p > 1e-3) fits.emplace_back(p, signature.mistake);
  }
  std::sort(fits.rbegin(), fits.rend());
  std::string text;
  char line[200];
  if (!fits.empty()) {
    text = "it agrees with";
    for (std::size_t i = 0; i < fits.size() && i < 3; ++i) {
      std::snprintf(line, sizeof line, "%s '%s' (p = %.2g)", i > 0 ? "," : "",
                    fits[i].second.c_str(), fits[i].first);
      text += line;
    }
    std::snprintf(line, sizeof line, " and with no other of %zu mistakes",
                  known.size());
    text += fits.size() > 3 ? " and others" : line;
  }
  const double ratio = common_ratio(mine, signature_of(golden, "golden"));
  for (const TellingRatio& one : telling_ratios) {
    if (ratio > 0 && std::abs(ratio / one.ratio - 1) < 0.01) {
      std::snprintf(line, sizeof line,
                    "%sthe whole picture is off by the factor %.3g, which is "
                    "%s",
                    text.empty() ? "" : "\n", ratio, one.meaning);
      text += line;
    }
  }
  return text;
}

}  // namespace lightwalk
