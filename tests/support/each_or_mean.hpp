#pragma once

// # Each sample, or their mean
//
// Where nothing is left to chance each sample is right, and one that is wrong
// is a mistake. But a right program may leave more to chance than it has to,
// by roulette say. Then most samples differ, and only their mean is right.

#include <doctest/doctest.h>

#include <string>

#include "support/expectations.hpp"
#include "support/renders.hpp"

namespace lightwalk::tests {

/// Samples that should all be `expected`, to `rounding` of it.
class EachOrMean {
 public:
  EachOrMean(double expected, double rounding)
      : expected_(expected), rounding_(rounding * expected) {}

  void add(float sample) {
    pixel_.add(Vec3(sample));
    const bool right =
        std::abs(static_cast<double>(sample) - expected_) <= rounding_;
    if (!right && wrong_++ == 0) first_wrong_ = sample;
  }

  /// At most one sample in ten is wrong: each of them is a mistake then.
  bool counts_each() const { return wrong_ * 10 <= pixel_.samples; }

  /// Empty where the samples are what they should be.
  std::string wrong() const {
    const std::string expected = ", expected " + std::to_string(expected_);
    if (pixel_.dropped > 0) {
      return std::to_string(pixel_.dropped) +
             " samples are infinite or not a number" + expected;
    }
    if (counts_each()) {
      if (wrong_ == 0) return "";
      return std::to_string(wrong_) + " of " +
             std::to_string(pixel_.samples) + " samples are wrong, one is " +
             std::to_string(first_wrong_) + expected + ": " +
             factor_in_words(static_cast<double>(first_wrong_) / expected_);
    }
    const double sigma = std::sqrt(pixel_.variance(0) / pixel_.samples);
    if (std::abs(pixel_.mean[0] - expected_) <= 4.4 * sigma + rounding_) {
      return "";
    }
    return "mean " + std::to_string(pixel_.mean[0]) + " +- " +
           std::to_string(sigma) + expected + ": " +
           factor_in_words(pixel_.mean[0] / expected_,
                           sigma / std::abs(expected_));
  }

  /// Fails unless each sample is right, or else their mean.
  void check(const std::string& what) const {
    const std::string says = wrong();
    if (!says.empty()) FAIL_CHECK(what << ": " << says);
    if (says.empty() && !counts_each()) {
      MESSAGE(what,
              ": right in the mean, and noisy where no noise has to be");
    }
  }

 private:
  double expected_, rounding_;
  Pixel pixel_;
  std::uint32_t wrong_ = 0;
  float first_wrong_ = 0;
};

}  // namespace lightwalk::tests
