#pragma once

// # Each sample, or their mean
//
// Where nothing is random every sample must be right, and a wrong one is a
// mistake. But a right program may use more randomness than necessary, by
// roulette, say. Then most samples differ, and only their mean is right.

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
    const bool right =
        std::abs(static_cast<double>(sample) - expected_) <= rounding_;
    ++samples_;
    if (right) return;
    if (wrong_.samples == 0) first_wrong_ = sample;
    wrong_.add(Vec3(sample));
    (static_cast<double>(sample) < expected_ ? below_ : above_) += 1;
  }

  /// No sample is wrong, or all are wrong to one side: then each is a mistake.
  bool counts_each() const { return below_ == 0 || above_ == 0; }

  /// Empty if the samples are right. The mean is taken only over those that
  /// are not `expected`: the others would dilute it.
  std::string wrong() const {
    const std::string expected = ", expected " + std::to_string(expected_);
    if (wrong_.dropped > 0) {
      return std::to_string(wrong_.dropped) +
             " samples are infinite or not a number" + expected;
    }
    if (counts_each()) {
      if (wrong_.samples == 0) return "";
      return std::to_string(wrong_.samples) + " of " +
             std::to_string(samples_) + " samples are wrong, one is " +
             std::to_string(first_wrong_) + expected + ": " +
             factor_in_words(static_cast<double>(first_wrong_) / expected_);
    }
    const double sigma = std::sqrt(wrong_.variance(0) / wrong_.samples);
    if (std::abs(wrong_.mean[0] - expected_) <= 4.4 * sigma + rounding_) {
      return "";
    }
    return std::to_string(wrong_.samples) + " of " +
           std::to_string(samples_) +
           " samples differ from it, and their mean is " +
           std::to_string(wrong_.mean[0]) + " +- " + std::to_string(sigma) +
           expected + ": " +
           factor_in_words(wrong_.mean[0] / expected_,
                           sigma / std::abs(expected_));
  }

  /// Fails unless each sample is right, or at least their mean.
  void check(const std::string& what) const {
    const std::string says = wrong();
    if (!says.empty()) FAIL_CHECK(what << ": " << says);
    if (says.empty() && !counts_each()) {
      MESSAGE(what,
              ": correct on average, but noisy where no noise is needed");
    }
  }

 private:
  double expected_, rounding_;
  Pixel wrong_;
  std::uint32_t samples_ = 0, below_ = 0, above_ = 0;
  float first_wrong_ = 0;
};

}  // namespace lightwalk::tests
