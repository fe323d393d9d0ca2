#pragma once

// # By how much?
//
// A factor that is the same in many tiles is most often one that formulas are
// made of, and its value says which. It is measured on the light that is
// wrong: of a picture with two bounces, whose picture with one is right, that
// is what the second bounce added.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "compare/parts.hpp"

namespace lightwalk {

/// The ratio of the test's light to the right one's, in some tiles.
struct Factor {
  double ratio = 0, sigma = 0;
  bool known = false;  ///< to 2 % or better
  bool uniform =
      false;            ///< all tiles agree on it, and three or more are sure
  bool varies = false;  ///< there are two sure tiles that contradict
  double least = 0, most = 0;  ///< of the sure tiles
};

/// Measures it on test - before and right - before.
inline Factor factor_of(const Part& test, const Part& right,
                        const Part* before, const Tiles& tiles, int channel) {
  struct Sample {
    double test, right, variance;
  };
  const auto samples = [&](double ratio) {
    std::vector<Sample> result;
    for (const std::size_t tile : tiles) {
      const double b = before ? before->mean_of(tile, channel) : 0;
      const double v = before ? before->variance_of(tile, channel) : 0;
      Sample one{test.mean_of(tile, channel) - b,
                 right.mean_of(tile, channel) - b, 0};
      const double rounding = 1e-3 * right.mean_of(tile, channel);
      one.variance = test.variance_of(tile, channel) +
                     ratio * ratio * right.variance_of(tile, channel) +
                     (1 - ratio) * (1 - ratio) * v + rounding * rounding;
      if (one.right > 0 && one.variance > 0) result.push_back(one);
    }
    return result;
  };
  Factor factor;
  factor.ratio = 1;
  for (int round = 0; round < 3; ++round) {
    double product = 0, square = 0;
    for (const Sample& one : samples(factor.ratio)) {
      // No tile is known to better than a hundredth: it is not the only one.
      const double variance = one.variance + 1e-4 * one.right * one.right *
                                                 factor.ratio * factor.ratio;
      product += one.test * one.right / variance;
      square += one.right * one.right / variance;
    }
    if (!(square > 0)) return {};
    factor.ratio = product / square;
    factor.sigma = std::sqrt(1 / square);
  }
  int sure = 0;
  factor.uniform = true;
  double least_high = 1e30, most_low = -1e30;
  for (const Sample& one : samples(factor.ratio)) {
    const double sigma = std::sqrt(one.variance);
    const double expected = factor.ratio * one.right;
    if (std::abs(one.test - expected) > 4 * sigma + 0.02 * expected) {
      factor.uniform = false;
    }
    if (sigma > 0.1 * std::max(expected, one.right)) continue;
    const double ratio = one.test / one.right;
    factor.least = sure ? std::min(factor.least, ratio) : ratio;
    factor.most = sure ? std::max(factor.most, ratio) : ratio;
    least_high = std::min(least_high, ratio + 5 * sigma / one.right);
    most_low = std::max(most_low, ratio - 5 * sigma / one.right);
    ++sure;
  }
  factor.uniform = factor.uniform && sure >= 3;
  factor.varies = most_low > 1.1 * least_high;
  factor.known = factor.sigma < 0.02 * std::abs(factor.ratio);
  return factor;
}

/// One factor of three channels, if they agree; channels without light have
/// no say.
inline std::optional<Factor> common_factor(
    const std::array<Factor, 3>& channels) {
  std::optional<Factor> result;
  double weighted = 0, weights = 0;
  for (const Factor& one : channels) {
    if (!(one.sigma > 0)) continue;
    if (!one.uniform || !one.known) return std::nullopt;
    const double weight = 1 / (one.sigma * one.sigma);
    weighted += weight * one.ratio;
    weights += weight;
  }
  if (!(weights > 0)) return std::nullopt;
  Factor factor = channels[0];
  factor.ratio = weighted / weights;
  factor.sigma = 1 / std::sqrt(weights);
  factor.known = factor.uniform = true;
  for (const Factor& one : channels) {
    if (!(one.sigma > 0)) continue;
    if (std::abs(one.ratio - factor.ratio) >
        3 * one.sigma + 0.01 * factor.ratio) {
      return std::nullopt;
    }
  }
  return factor;
}

/// A value with a name: "1/pi".
struct NamedValue {
  double value;
  std::string name;
};

/// What formulas are made of.
inline std::vector<NamedValue> usual_factors() {
  constexpr double circle = 3.14159265358979;
  std::vector<NamedValue> values;
  const auto both = [&](double value, const std::string& name,
                        const std::string& inverse) {
    values.push_back({value, name});
    values.push_back({1 / value, inverse});
  };
  both(circle, "pi", "1/pi");
  both(2 * circle, "2 pi", "1/(2 pi)");
  both(4 * circle, "4 pi", "1/(4 pi)");
  both(circle * circle, "pi^2", "1/pi^2");
  both(2, "2", "1/2");
  both(4, "4", "1/4");
  return values;
}

/// Whether a measured ratio is this value: within its noise and to 1 %.
inline bool is_value(const Factor& factor, double value) {
  const double off = std::abs(factor.ratio / value - 1);
  return off < 0.01 && off * factor.ratio < 3 * factor.sigma + 0.004 * value;
}

/// The names of the values that the ratio is; different values have none.
inline std::string name_of(const Factor& factor,
                           const std::vector<NamedValue>& values) {
  std::string name;
  double value = 0;
  for (const NamedValue& one : values) {
    if (std::abs(one.value - 1) < 0.02 || !is_value(factor, one.value)) {
      continue;
    }
    if (!name.empty() && std::abs(one.value / value - 1) > 1e-4) return "";
    name += (name.empty() ? "" : " or ") + one.name;
    value = one.value;
  }
  return name;
}

}  // namespace lightwalk
