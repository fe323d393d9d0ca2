#include "support/expectations.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace lightwalk::tests {

namespace {

/// A value with a name: "1/pi".
struct NamedValue {
  double value;
  std::string name;
};

/// The usual factors of formulas.
std::vector<NamedValue> usual_factors() {
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

std::string formatted(const char* format, double number) {
  char text[64];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

/// Whether a number is the expected one, to a relative error of `epsilon`; an
/// expected 0 must be met exactly. NaN is never the expected number.
bool is_value(double actual, double expected, double epsilon) {
  return std::abs(actual - expected) <= epsilon * std::abs(expected);
}

std::string seen_and_expected(const std::string& what,
                              const std::string& seen,
                              const std::string& expected,
                              const std::string& difference) {
  return what + ": " + seen + ", expected " + expected +
         (difference.empty() ? "" : ": " + difference);
}

/// The difference between `actual` and `expected`, in words.
std::string difference_in_words(double actual, double expected,
                                double uncertainty) {
  if (std::isnan(actual)) return "it is not a number";
  if (std::isinf(actual)) return "it is infinite";
  if (actual == 0) return "there is none";
  if (expected == 0) return "there should be none";
  if (std::abs(actual / expected - 1) < 0.002) return "";
  return factor_in_words(actual / expected, uncertainty);
}

/// Empty where the value is right.
std::string wrong_value(const std::string& what, double actual,
                        double expected, double epsilon) {
  if (is_value(actual, expected, epsilon)) return "";
  return seen_and_expected(what, text_of(actual), text_of(expected),
                           difference_in_words(actual, expected, 1e-4));
}

/// The same for three channels: one factor if it is the same in all.
std::string wrong_color(const std::string& what, const Vec3& actual,
                        const Vec3& expected, double epsilon) {
  std::string words;
  bool wrong = false, alike = true;
  for (int c = 0; c < 3; ++c) {
    const auto a = static_cast<double>(actual[c]);
    const auto e = static_cast<double>(expected[c]);
    if (is_value(a, e, epsilon)) {
      alike = alike && e == 0;
      continue;
    }
    const std::string one = difference_in_words(a, e, 1e-4);
    alike = alike && (!wrong || one == words);
    if (!wrong || !alike) words = one;
    if (!alike && !one.empty())
      words = std::string(channel_names[static_cast<std::size_t>(c)]) + ": " +
              one;
    wrong = true;
  }
  return wrong ? seen_and_expected(what, text_of(actual), text_of(expected),
                                   words)
               : "";
}

}  // namespace

std::string factor_in_words(double ratio, double uncertainty) {
  static const std::vector<NamedValue> factors = [] {
    std::vector<NamedValue> values = usual_factors();
    for (const NamedValue& one :
         {NamedValue{3, "3"}, NamedValue{1.0 / 3, "1/3"},
          NamedValue{1.5, "1.5"}, NamedValue{1 / 1.5, "1/1.5"},
          NamedValue{2.25, "2.25 (eta^2)"},
          NamedValue{1 / 2.25, "1/2.25 (1/eta^2)"},
          NamedValue{5.0625, "5.0625 (eta^4)"},
          NamedValue{1 / 5.0625, "1/5.0625 (1/eta^4)"}}) {
      values.push_back(one);
    }
    return values;
  }();
  if (ratio == 0) return "there is none";
  const double tolerance = std::max(3 * uncertainty, 1e-4);
  std::string name = formatted("%.4g", ratio);
  // If the noise allows several factors, none is named.
  int found = 0;
  for (const NamedValue& one : factors) {
    if (uncertainty > 0.02 || std::abs(ratio / one.value - 1) >= tolerance) {
      continue;
    }
    name = ++found > 1 ? formatted("%.4g", ratio) : one.name;
  }
  return name + " times what it should be";
}

bool check_value(const std::string& what, double actual, double expected,
                 double epsilon, SourceLine place) {
  const std::string wrong = wrong_value(what, actual, expected, epsilon);
  if (!wrong.empty()) ADD_FAIL_CHECK_AT(place.file, place.line, wrong);
  return wrong.empty();
}

bool check_color(const std::string& what, const Vec3& actual,
                 const Vec3& expected, double epsilon, SourceLine place) {
  const std::string wrong = wrong_color(what, actual, expected, epsilon);
  if (!wrong.empty()) ADD_FAIL_CHECK_AT(place.file, place.line, wrong);
  return wrong.empty();
}

void require_value(const std::string& what, double actual, double expected,
                   double epsilon, SourceLine place) {
  if (is_value(actual, expected, epsilon)) return;
  ADD_FAIL_AT(place.file, place.line,
              wrong_value(what, actual, expected, epsilon));
}

void require_color(const std::string& what, const Vec3& actual,
                   const Vec3& expected, double epsilon, SourceLine place) {
  const std::string wrong = wrong_color(what, actual, expected, epsilon);
  if (!wrong.empty()) ADD_FAIL_AT(place.file, place.line, wrong);
}

bool check_mean(const std::string& what, const Pixel& pixel, int channel,
                double expected, double rounding, SourceLine place) {
  const double mean = pixel.mean[channel];
  const double sigma =
      pixel.samples == 0 ? 0
                         : std::sqrt(pixel.variance(channel) / pixel.samples);
  const double size = std::abs(expected);
  if (pixel.samples > 0 && pixel.dropped == 0 &&
      std::abs(mean - expected) <= max_deviations * sigma + rounding * size) {
    return true;
  }
  std::string words =
      difference_in_words(mean, expected, expected == 0 ? 1 : sigma / size);
  if (pixel.dropped > 0) {
    words = std::to_string(pixel.dropped) +
            " samples are infinite or not a number";
  } else if (sigma > 0 && words.empty()) {
    words = formatted("%.1f", std::abs(mean - expected) / sigma) +
            " standard deviations off";
  }
  ADD_FAIL_CHECK_AT(
      place.file, place.line,
      seen_and_expected(
          what, "mean " + text_of(mean) + " +- " + formatted("%.1g", sigma),
          text_of(expected), words));
  return false;
}

bool check_variance(const std::string& what, const Pixel& pixel, int channel,
                    double expected, double epsilon, SourceLine place) {
  const double variance = pixel.variance(channel);
  if (!(variance > 0)) {
    return check_value("the variance of " + what, variance, expected, epsilon,
                       place);
  }
  if (std::abs(variance - expected) > epsilon * expected) {
    const std::string note = what + ": correct on average; " +
                             text_of(variance / expected) +
                             " times the noise of the course's own program";
    MESSAGE(note);
  }
  return true;
}

}  // namespace lightwalk::tests
