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
// over tiles and channels. Two mistakes may have one picture, and a picture
// that is hardly wrong agrees with many; so a mistake is named only if the
// picture is far from the golden one, if hardly another mistake agrees with
// it, and if the same parts of the picture are wrong (`parts.hpp`).

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
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
  std::string wrong_parts = {};  ///< "bounces-2,kd"; empty: not known
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
/// name, which parts are wrong ("wrong=bounces-2,kd"), and then mean and
/// variance of each tile and channel in turn.
inline std::string signature_path(const std::string& folder, int stage,
                                  const std::string& scene) {
  return folder + "/stage" + std::to_string(stage) + "_" + scene + ".txt";
}

inline std::string signature_line(const Signature& signature) {
  std::string line = signature.mistake;
  if (!signature.wrong_parts.empty())
    line += " wrong=" + signature.wrong_parts;
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
    words >> signature.mistake >> std::ws;
    if (words.peek() == 'w') {
      words >> signature.wrong_parts;
      signature.wrong_parts.erase(0, std::string("wrong=").size());
    }
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

/// How far two signatures are from being one picture: the mean of the squared
/// differences, in variances. 1 is what noise makes.
inline double distance(const Signature& a, const Signature& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.mean.size(); ++i) {
    const double rounding = 1e-3 * std::max(std::abs(a.mean[i]), 1e-9);
    const double variance =
        a.variance[i] + b.variance[i] + rounding * rounding;
    sum += (a.mean[i] - b.mean[i]) * (a.mean[i] - b.mean[i]) / variance;
  }
  return sum / static_cast<double>(a.mean.size());
}

/// How many names two lists "a,b" and "b,c" do not have in common.
inline std::size_t unlike_parts(const std::string& a, const std::string& b) {
  const auto names = [](const std::string& text) {
    std::set<std::string> result;
    std::istringstream words(text);
    for (std::string one; std::getline(words, one, ',');) {
      if (one != "-") result.insert(one);
    }
    return result;
  };
  const std::set<std::string> x = names(a), y = names(b);
  std::vector<std::string> unlike;
  std::set_symmetric_difference(x.begin(), x.end(), y.begin(), y.end(),
                                std::back_inserter(unlike));
  return unlike.size();
}

/// The known mistakes, one or two, whose pictures cannot be told from the
/// failing one; none where more agree, or where that says little.
inline std::vector<std::string> known_mistakes(
    const RenderResult& test, const RenderResult& golden,
    const std::string& wrong_parts, const std::vector<Signature>& known) {
  constexpr double likely = 1e-3, far = 8;
  constexpr std::size_t most = 2;
  const Signature mine = signature_of(test, "yours");
  if (distance(mine, signature_of(golden, "golden")) < far) return {};
  std::vector<std::pair<double, std::string>> fits;
  for (const Signature& signature : known) {
    const double p = agreement(mine, signature);
    if (p < likely) continue;
    // Not known is not enough: two pictures may agree by chance.
    if (signature.wrong_parts.empty() || wrong_parts.empty() ||
        unlike_parts(signature.wrong_parts, wrong_parts) > 1) {
      continue;
    }
    fits.emplace_back(p, signature.mistake);
  }
  if (fits.size() > most) return {};
  std::sort(fits.rbegin(), fits.rend());
  std::vector<std::string> names;
  for (const auto& [p, name] : fits) names.push_back(name);
  return names;
}

}  // namespace lightwalk
