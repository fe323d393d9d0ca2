#pragma once

// # Do these counts fit those probabilities?
//
// Pearson's test: sort samples into cells, and compare the counts with the
// expected ones. If sampler and probabilities match,
//
// $$\chi^2 = \sum_i \frac{(\mathrm{observed}_i - \mathrm{expected}_i)^2}
// {\mathrm{expected}_i}$$
//
// follows the chi-squared distribution with one degree of freedom fewer than
// there are cells. Its tail says how often a *right* sampler does as badly:
// the p-value. Seeds are fixed, so a test that passes once always passes; the
// bound below only says how often a new seed may fail by chance.
//
// The distribution holds for cells that expect at least a few samples; those
// that expect fewer than 5 are pooled.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace lightwalk::tests {

/// The regularized upper incomplete gamma function Q(a, x), a > 0, x >= 0: by
/// its power series (DLMF 8.11.4) where that converges quickly, otherwise by
/// its continued fraction (DLMF 8.9.2), by Lentz's method.
inline double upper_gamma(double a, double x) {
  if (x <= 0) return 1;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (double n = a + 1; term > sum * 1e-17; ++n) {
      term *= x / n;
      sum += term;
    }
    return 1 - front * sum;
  }
  constexpr double tiny = 1e-300;
  double b = x + 1 - a, c = 1 / tiny, d = 1 / b, fraction = d;
  for (double i = 1; i < 100000; ++i) {
    const double numerator = -i * (i - a);
    b += 2;
    d = numerator * d + b;
    if (std::abs(d) < tiny) d = tiny;
    c = b + numerator / c;
    if (std::abs(c) < tiny) c = tiny;
    d = 1 / d;
    fraction *= d * c;
    if (std::abs(d * c - 1) < 1e-15) break;
  }
  return front * fraction;
}

/// A p-value below this is no accident.
inline constexpr double significance = 1e-6;

/// A deviation of this many standard deviations (to either side) has that
/// p-value.
inline constexpr double significant_deviations = 4.8916;

/// The probability that a chi-squared variable with this many degrees of
/// freedom is at least `statistic`.
inline double chi_squared_p_value(double statistic,
                                  double degrees_of_freedom) {
  return upper_gamma(degrees_of_freedom / 2, statistic / 2);
}

struct ChiSquared {
  double statistic;
  int degrees_of_freedom;
  double p_value;
};

/// Tests counts against what each cell expects; both must have the same
/// total, to a thousandth. A sample where none is expected makes the p-value
/// 0.
/// Throws std::invalid_argument for counts that cannot be tested.
inline ChiSquared chi_squared_test(const std::vector<double>& observed,
                                   const std::vector<double>& expected) {
  constexpr double fewest = 5;
  if (observed.size() != expected.size()) {
    throw std::invalid_argument("as many observed cells as expected ones");
  }
  const double total = std::accumulate(observed.begin(), observed.end(), 0.0);
  const double sum = std::accumulate(expected.begin(), expected.end(), 0.0);
  if (!(std::abs(total - sum) <= 1e-3 * total)) {
    throw std::invalid_argument("as many samples observed as expected");
  }

  // Pool the small cells; if the pool is still small, the next larger joins.
  struct Cell {
    double expected, observed;
  };
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (!(expected[i] > 0) && observed[i] > 0) {
      return {std::numeric_limits<double>::infinity(), 0, 0};
    }
    if (expected[i] > 0) cells.push_back({expected[i], observed[i]});
  }
  std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) {
    return a.expected < b.expected;
  });
  Cell pool{0, 0};
  std::size_t first = 0;
  while (first < cells.size() &&
         (cells[first].expected < fewest ||
          (pool.expected > 0 && pool.expected < fewest))) {
    pool.expected += cells[first].expected;
    pool.observed += cells[first].observed;
    ++first;
  }
  if (first > 0) cells[--first] = pool;
  const auto count = static_cast<int>(cells.size() - first);
  if (count < 2) throw std::invalid_argument("fewer than two cells");

  double statistic = 0;
  for (; first < cells.size(); ++first) {
    const double difference = cells[first].observed - cells[first].expected;
    statistic += difference * difference / cells[first].expected;
  }
  return {statistic, count - 1, chi_squared_p_value(statistic, count - 1)};
}

/// The same for cells that are all equally likely.
inline ChiSquared chi_squared_test(const std::vector<double>& observed) {
  const double total = std::accumulate(observed.begin(), observed.end(), 0.0);
  return chi_squared_test(
      observed,
      std::vector<double>(observed.size(),
                          total / static_cast<double>(observed.size())));
}

}  // namespace lightwalk::tests
