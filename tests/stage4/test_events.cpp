// The choice of an event by itself.

#include <doctest/doctest.h>

#include <algorithm>

#include "stages/4_russian_roulette/path_tracer.hpp"
#include "support/chi_squared.hpp"
#include "support/expectations.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using namespace lightwalk::stage4;

TEST_SUITE_BEGIN("units");

namespace {

Material material(const Vec3& kd, const Vec3& ks, const Vec3& kt) {
  Material result;
  result.kd = kd;
  result.ks = ks;
  result.kt = kt;
  return result;
}

constexpr const char* events[] = {"diffuse", "specular", "refraction",
                                  "absorption"};
constexpr const char* coefficients[] = {"kd", "ks", "kt"};

/// Of the three lobes, in this order.
Vec3 probabilities(const Vec3& kd, const Vec3& ks, const Vec3& kt,
                   int bounce) {
  const LobeProbabilities p =
      lobe_probabilities(material(kd, ks, kt), bounce);
  return {p.diffuse, p.specular, p.refraction};
}

/// The index of a choice among diffuse, specular, refraction, absorption.
std::size_t event_of(const std::optional<LobeChoice>& choice) {
  return choice ? static_cast<std::size_t>(choice->lobe) : 3;
}

/// Compares the frequencies of the four events with their probabilities.
void check_frequencies(const LobeProbabilities& p) {
  constexpr int samples = 100'000;
  std::vector<double> observed(4),
      expected = {samples * static_cast<double>(p.diffuse),
                  samples * static_cast<double>(p.specular),
                  samples * static_cast<double>(p.refraction), 0};
  expected[3] =
      std::max(0.0, samples - expected[0] - expected[1] - expected[2]);
  if (expected[3] < 1) expected[3] = 0;
  Random random(7, 0, 0);
  for (int i = 0; i < samples; ++i) {
    observed[event_of(choose_lobe(p, random.uniform()))] += 1;
  }
  // An event that is certain must come every time.
  const auto certain = std::find_if(expected.begin(), expected.end(),
                                    [](double e) { return e > samples - 1; });
  const bool right =
      certain != expected.end()
          ? observed[static_cast<std::size_t>(certain - expected.begin())] ==
                samples
          : chi_squared_test(observed, expected).p_value > significance;
  if (right) return;
  std::string says = "of 100000 events";
  for (std::size_t i = 0; i < 4; ++i) {
    says += std::string(", ") + events[i] + " " + text_of(observed[i]) +
            ", expected " + text_of(std::round(expected[i]));
  }
  FAIL_CHECK(says);
}

}  // namespace

// Any probabilities will do if every lobe with a coefficient has a chance:
// the largest channel, the mean, the luminance. These tests check only what
// holds for all of them.
TEST_CASE("every lobe with a coefficient has a chance") {
  const Vec3 red(0.3f, 0, 0), green(0, 0.3f, 0), blue(0, 0, 0.3f), none(0);
  for (const Vec3& k : {red, green, blue, Vec3(0.3f)}) {
    for (const int bounce : {0, 1, 20}) {
      const Vec3 alone[] = {probabilities(k, none, none, bounce),
                            probabilities(none, k, none, bounce),
                            probabilities(none, none, k, bounce)};
      for (int lobe = 0; lobe < 3; ++lobe) {
        for (int i = 0; i < 3; ++i) {
          const float p = alone[lobe][i];
          if (i == lobe ? p > 0 : p == 0) continue;
          FAIL_CHECK("the probability of the "
                     << events[i] << " lobe is " << p << " at bounce "
                     << bounce << " where the only coefficient is "
                     << coefficients[lobe] << " = " << k << ", expected "
                     << (i == lobe
                             ? "more than 0"
                             : "0: what follows this lobe brings nothing, "
                               "and the path takes its time"));
        }
      }
    }
  }
}

TEST_CASE("lobes of different colors each have a chance") {
  const Vec3 red(0.9f, 0, 0), green(0, 0.9f, 0), blue(0, 0, 0.9f);
  const LobeProbabilities p =
      lobe_probabilities(material(red, green, blue), 0);
  INFO("kd is red, ks green, kt blue, and their probabilities are ",
       p.diffuse, ", ", p.specular, ", ", p.refraction,
       ", expected all above 0");
  CHECK(p.diffuse > 0);
  CHECK(p.specular > 0);
  CHECK(p.refraction > 0);
}

TEST_CASE("the probabilities never add to more than the limit") {
  Random random(3, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    // Random shares of each channel, which add to 1.
    Vec3 k[3];
    for (int c = 0; c < 3; ++c) {
      const Vec2 u(random.uniform_2d());
      k[0][c] = u.x;
      k[1][c] = (1 - u.x) * u.y;
      k[2][c] = (1 - u.x) * (1 - u.y);
    }
    for (const int bounce : {0, 15, 16, 1000}) {
      const auto p = lobe_probabilities(material(k[0], k[1], k[2]), bounce);
      const float sum = p.diffuse + p.specular + p.refraction;
      const float limit = bounce < 16 ? 1 : 0.95f;
      INFO("kd = ", k[0], ", ks = ", k[1], ", kt = ", k[2], " at bounce ",
           bounce, ": the probabilities ", p.diffuse, ", ", p.specular, ", ",
           p.refraction, " add to ", sum, ", expected at most ", limit);
      REQUIRE(sum <= limit + 1e-6f);
    }
  }
}

// kd + ks + kt is at most 1 in every channel, and still .9 + .9 + .9 = 2.7.
// By symmetry each event has the same probability, and all have a place on the
// bar.
TEST_CASE("maxima that add to more than 1 are scaled down to fit the bar") {
  const auto p = lobe_probabilities(
      material({0.9f, 0, 0}, {0, 0.9f, 0}, {0, 0, 0.9f}), 0);
  INFO("diffuse ", p.diffuse, ", specular ", p.specular, ", refraction ",
       p.refraction, " for maxima of 0.9 each, expected 1 in all, or less");
  CHECK(p.diffuse + p.specular + p.refraction <= 1 + 1e-6f);
  const auto gray =
      lobe_probabilities(material(Vec3(0.3f), Vec3(0.3f), Vec3(0.3f)), 0);
  INFO("diffuse ", gray.diffuse, ", specular ", gray.specular,
       ", refraction ", gray.refraction,
       " for kd = ks = kt = 0.3, expected three times the same");
  CHECK(gray.diffuse == doctest::Approx(gray.specular));
  CHECK(gray.specular == doctest::Approx(gray.refraction));
}

TEST_CASE("from bounce 16 on lossless materials may end, too") {
  const Material glass = material(Vec3(0), Vec3(0.1f), Vec3(0.9f));
  for (const int bounce : {16, 17, 100, 4000}) {
    const auto late = lobe_probabilities(glass, bounce);
    INFO("at bounce ", bounce, " a path on lossless glass survives with ",
         late.specular + late.refraction,
         ", expected 0.95 at most, and more than 0.5");
    CHECK(late.specular + late.refraction <= 0.95f + 1e-6f);
    CHECK(late.specular + late.refraction > 0.5f);
  }
}

TEST_CASE("each event comes as often as its probability says") {
  const Vec3 none(0);
  for (const Material& one :
       {material(Vec3(0.5f), Vec3(0.2f), Vec3(0.1f)),
        material({0.5f, 0.1f, 0}, {0, 0.2f, 0.05f}, {0.01f, 0.02f, 0.1f}),
        material({0.9f, 0, 0}, {0, 0.9f, 0}, none),
        material(none, Vec3(0.4f), none), material(none, none, Vec3(0.7f)),
        material({0.9f, 0, 0}, {0, 0.9f, 0}, {0, 0, 0.9f})}) {
    const auto p = lobe_probabilities(one, 0);
    check_frequencies(p);
  }
}

TEST_CASE("the probability that comes with a lobe is its own") {
  // In any order on the bar.
  const LobeProbabilities p{0.4f, 0.3f, 0.2f};
  const double expected[] = {0.4, 0.3, 0.2};
  int absorbed = 0;
  for (const float xi : {0.05f, 0.15f, 0.25f, 0.35f, 0.45f, 0.55f, 0.65f,
                         0.75f, 0.85f, 0.95f}) {
    const auto choice = choose_lobe(p, xi);
    absorbed += !choice;
    if (!choice) continue;
    const std::size_t event = event_of(choice);
    check_value("the probability that comes with the event for xi = " +
                    text_of(static_cast<double>(xi)) + " of (0.4, 0.3, 0.2)",
                static_cast<double>(choice->probability), expected[event]);
  }
  INFO(absorbed, " of 10 numbers xi mean absorption, expected 1");
  CHECK(absorbed == 1);
}

TEST_CASE("a lobe with probability 0 is never chosen, not even by xi = 0") {
  const float largest = 1 - 0x1p-24f;
  const auto check = [](const LobeProbabilities& p, float xi,
                        std::size_t expected) {
    const std::size_t event = event_of(choose_lobe(p, xi));
    if (event == expected) return;
    FAIL_CHECK("xi = " << xi << " with the probabilities "
                       << Vec3(p.diffuse, p.specular, p.refraction)
                       << " chooses the event " << events[event]
                       << ", expected " << events[expected]);
  };
  check({0, 1, 0}, 0, 1);
  check({0, 0, 1}, 0, 2);
  check({0, 0, 0}, 0, 3);
  check({1, 0, 0}, largest, 0);
  check({0, 1, 0}, largest, 1);
  check({0, 0, 1}, largest, 2);
}

TEST_SUITE_END();
