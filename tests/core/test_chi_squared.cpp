// The test of samplers is itself tested: a p-value that is always near one
// would pass every sampler.

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/chi_squared.hpp"

using namespace lightwalk::tests;

// For an even number of degrees of freedom, integrating by parts gives
//   Q(n, y) = e^-y (1 + y + y^2/2! + ... + y^(n-1)/(n-1)!)
// with n = k/2 and y = x/2.
TEST_CASE("p-values for even degrees of freedom equal their finite sum") {
  for (int k = 2; k <= 200; k += 2) {
    for (const double x : {0.01, 0.5, 0.7 * k, 1.0 * k, 1.4 * k, 3.0 * k}) {
      double term = std::exp(-x / 2), sum = 0;
      for (int j = 0; j < k / 2; ++j) {
        sum += term;
        term *= x / 2 / (j + 1);
      }
      CAPTURE(k);
      CAPTURE(x);
      CHECK(chi_squared_p_value(x, k) == doctest::Approx(sum).epsilon(1e-10));
    }
  }
}

// One degree of freedom is the square of a normal variable, so the tail is
// erfc(sqrt(x/2)); each two more add the next term of the same recurrence,
//   Q(a + 1, y) = Q(a, y) + y^a e^-y / Gamma(a + 1).
TEST_CASE("p-values for odd degrees of freedom follow from the normal tail") {
  for (const double x : {0.001, 0.5, 1.0, 4.0, 24.0, 60.0, 300.0}) {
    double p = std::erfc(std::sqrt(x / 2));
    for (int k = 1; k <= 201; k += 2) {
      CAPTURE(k);
      CAPTURE(x);
      CHECK(chi_squared_p_value(x, k) == doctest::Approx(p).epsilon(1e-10));
      p += std::exp(0.5 * k * std::log(x / 2) - x / 2 -
                    std::lgamma(0.5 * k + 1));
    }
  }
}

TEST_CASE("the 95 % quantiles are those of the printed tables") {
  const auto five_percent = doctest::Approx(0.05).epsilon(1e-6);
  CHECK(chi_squared_p_value(3.841459, 1) == five_percent);
  CHECK(chi_squared_p_value(18.307038, 10) == five_percent);
  CHECK(chi_squared_p_value(124.342113, 100) == five_percent);
  CHECK(std::erfc(significant_deviations / std::sqrt(2.0)) ==
        doctest::Approx(significance).epsilon(1e-3));
}

// A coin: 60 heads of 100 is (10^2 + 10^2) / 50 = 4, one degree of freedom.
TEST_CASE("the statistic of a coin is worked out as by hand") {
  const ChiSquared coin = chi_squared_test({60, 40}, {50, 50});
  CHECK(coin.statistic == doctest::Approx(4));
  CHECK(coin.degrees_of_freedom == 1);
  CHECK(coin.p_value == doctest::Approx(std::erfc(std::sqrt(2.0))));
  CHECK(chi_squared_test({60, 40}).statistic == doctest::Approx(4));
}

// 2 + 2 is still below 5, so 10 joins: cells of 14 and 86 are left, and
// (18 - 14)^2 / 14 + (82 - 86)^2 / 86 = 1.3289.
TEST_CASE("cells that expect fewer than five are pooled until they do") {
  const ChiSquared pooled = chi_squared_test({0, 82, 4, 14}, {2, 86, 2, 10});
  CHECK(pooled.degrees_of_freedom == 1);
  CHECK(pooled.statistic == doctest::Approx(16.0 / 14 + 16.0 / 86));

  const ChiSquared three = chi_squared_test({3, 4, 93, 0}, {3, 3, 94, 0});
  CHECK(three.degrees_of_freedom == 1);
  CHECK(three.statistic == doctest::Approx(1.0 / 6 + 1.0 / 94));
}

TEST_CASE("one sample where none is expected fails, however many fit") {
  CHECK(chi_squared_test({500, 500, 0}, {500, 500, 0}).p_value > 0.99);
  CHECK(chi_squared_test({500, 499, 1}, {500, 500, 0}).p_value == 0);
}

TEST_CASE("counts that cannot be tested are refused") {
  CHECK_THROWS_AS(chi_squared_test({1, 2}, {3}), std::invalid_argument);
  CHECK_THROWS_AS(chi_squared_test({90, 90}, {100, 100}),
                  std::invalid_argument);
  CHECK_THROWS_AS(chi_squared_test({100}, {100}), std::invalid_argument);
  CHECK_THROWS_AS(chi_squared_test({2, 2}, {2, 2}), std::invalid_argument);
}
