#pragma once

// Checks that say, in a sentence, what was seen and what was expected: a mean
// beside the number it should be, and between the two the factor, where it is
// one that mistakes are made of.

#include <doctest/doctest.h>

#include <string>

#include "common/image/image.hpp"
#include "common/render/film.hpp"
#include "support/printing.hpp"

namespace lightwalk::tests {

/// A mean of a right program is farther off than so many of its standard
/// deviations once in 92,000 times.
inline constexpr double max_deviations = 4.4;

/// A line of a test: by default, of the one that calls.
struct SourceLine {
  const char* file = __builtin_FILE();
  int line = __builtin_LINE();
};

/// "pi times what it should be", for a ratio that is known to a share of
/// `uncertainty`. Names a factor where there is one of which mistakes are made.
std::string factor_in_words(double ratio, double uncertainty = 1e-4);

/// Fails where `actual` is not `expected`, to a share of `epsilon`; 0 must be
/// 0. `what` names it: "L = kd/pi I/d^2". False where it fails.
bool check_value(const std::string& what, double actual, double expected,
                 double epsilon = 1e-4,
                 SourceLine place = {__builtin_FILE(), __builtin_LINE()});

/// The same for each channel.
bool check_color(const std::string& what, const Vec3& actual,
                 const Vec3& expected, double epsilon = 1e-4,
                 SourceLine place = {__builtin_FILE(), __builtin_LINE()});

/// The same for loops: the first failure ends the test.
void require_value(const std::string& what, double actual, double expected,
                   double epsilon = 1e-4,
                   SourceLine place = {__builtin_FILE(), __builtin_LINE()});
void require_color(const std::string& what, const Vec3& actual,
                   const Vec3& expected, double epsilon = 1e-4,
                   SourceLine place = {__builtin_FILE(), __builtin_LINE()});

/// Fails where the mean of many samples is not `expected`, but for their
/// noise and a share `rounding` of it, or where a sample is no number.
bool check_mean(const std::string& what, const Pixel& pixel, int channel,
                double expected, double rounding = 1e-6,
                SourceLine place = {__builtin_FILE(), __builtin_LINE()});

/// Fails where the samples' variance is less than `expected`, but for a share
/// of `epsilon`: something is not random that should be. More of it is only
/// told, for a right program may leave more to chance.
bool check_variance(const std::string& what, const Pixel& pixel, int channel,
                    double expected, double epsilon,
                    SourceLine place = {__builtin_FILE(), __builtin_LINE()});

}  // namespace lightwalk::tests
