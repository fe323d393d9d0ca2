#pragma once

// Checks that report in a sentence what was seen and what was expected: the
// mean, the expected number, and the factor between them where it is one that
// mistakes typically cause.

#include <doctest/doctest.h>

#include <string>

#include "common/image/image.hpp"
#include "common/render/film.hpp"
#include "support/printing.hpp"

namespace lightwalk::tests {

/// A mean of a right program is off by more than this many of its standard
/// deviations once in 92,000 times.
inline constexpr double max_deviations = 4.4;

/// A line of a test: by default, that of the caller.
struct SourceLine {
  const char* file = __builtin_FILE();
  int line = __builtin_LINE();
};

/// "pi times what it should be", for a ratio with a relative error of
/// `uncertainty`. Names the factor if it is one that mistakes typically cause.
std::string factor_in_words(double ratio, double uncertainty = 1e-4);

/// Fails unless `actual` is `expected`, to a relative error of `epsilon`; 0
/// must be 0. `what` names it: "L = kd/pi I/d^2". Returns false if it fails.
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

/// Fails unless the mean of many samples is `expected`, up to their noise and
/// a relative error of `rounding`, and all samples are finite numbers.
bool check_mean(const std::string& what, const Pixel& pixel, int channel,
                double expected, double rounding = 1e-6,
                SourceLine place = {__builtin_FILE(), __builtin_LINE()});

/// Fails if the samples have no variance: then something is not random that
/// should be. Another variance than `expected`, up to a relative error of
/// `epsilon`, is only reported: a right program may leave more to chance, or
/// follow two paths from the first surface and have half of the variance.
bool check_variance(const std::string& what, const Pixel& pixel, int channel,
                    double expected, double epsilon,
                    SourceLine place = {__builtin_FILE(), __builtin_LINE()});

}  // namespace lightwalk::tests
