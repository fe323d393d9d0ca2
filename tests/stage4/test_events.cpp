// The choice of an event by itself.

#include <doctest/doctest.h>

#include "stages/4_russian_roulette/path_tracer.hpp"
#include "support/chi_squared.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using namespace lightwalk::stage4;

namespace {

Material material(const Vec3& kd, const Vec3& ks, const Vec3& kt) {
  Material result;
  result.kd = kd;
  result.ks = ks;
  result.kt = kt;
  return result;
}

/// The frequencies of the four events against their probabilities.
double event_p_value(const EventProbabilities& p) {
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
    const Event event = choose_event(p, random.uniform()).event;
    observed[static_cast<std::size_t>(event)] += 1;
  }
  return chi_squared_test(observed, expected).p_value;
}

}  // namespace

TEST_CASE("grey coefficients are the probabilities") {
  const auto p =
      event_probabilities(material(Vec3(0.5f), Vec3(0.2f), Vec3(0.1f)), 0);
  CHECK(p.diffuse == doctest::Approx(0.5));
  CHECK(p.specular == doctest::Approx(0.2));
  CHECK(p.refraction == doctest::Approx(0.1));
}

TEST_CASE("coloured coefficients count by their largest channel") {
  const auto p = event_probabilities(
      material({0.5f, 0.1f, 0}, {0, 0.2f, 0.05f}, {0.01f, 0.02f, 0.1f}), 0);
  CHECK(p.diffuse == doctest::Approx(0.5));
  CHECK(p.specular == doctest::Approx(0.2));
  CHECK(p.refraction == doctest::Approx(0.1));
}

// kd + ks + kt is at most 1 in every channel, and still .9 + .9 = 1.8.
TEST_CASE("maxima that add to more than 1 are scaled down to 1") {
  const auto p = event_probabilities(
      material({0.9f, 0, 0}, {0, 0.9f, 0}, {0, 0, 0.9f}), 0);
  CHECK(p.diffuse == doctest::Approx(1 / 3.0));
  CHECK(p.specular == doctest::Approx(1 / 3.0));
  CHECK(p.refraction == doctest::Approx(1 / 3.0));
}

TEST_CASE("lossless materials go on for certain until bounce 16") {
  const Material glass = material(Vec3(0), Vec3(0.1f), Vec3(0.9f));
  const auto early = event_probabilities(glass, 15);
  CHECK(early.specular + early.refraction == doctest::Approx(1));
  const auto late = event_probabilities(glass, 16);
  CHECK(late.specular + late.refraction == doctest::Approx(0.95));
  CHECK(late.specular == doctest::Approx(0.095));
  const Material dark = material(Vec3(0.3f), Vec3(0), Vec3(0));
  CHECK(event_probabilities(dark, 100).diffuse == doctest::Approx(0.3));
}

TEST_CASE("each event comes as often as its probability says") {
  const Vec3 none(0);
  for (const Material& one :
       {material(Vec3(0.5f), Vec3(0.2f), Vec3(0.1f)),
        material({0.5f, 0.1f, 0}, {0, 0.2f, 0.05f}, {0.01f, 0.02f, 0.1f}),
        material({0.9f, 0, 0}, {0, 0.9f, 0}, none),
        material(none, Vec3(0.4f), none), material(none, none, Vec3(0.7f)),
        material({0.9f, 0, 0}, {0, 0.9f, 0}, {0, 0, 0.9f})}) {
    const auto p = event_probabilities(one, 0);
    CAPTURE(p.diffuse);
    CAPTURE(p.specular);
    CAPTURE(p.refraction);
    CHECK(event_p_value(p) > significance);
  }
}

TEST_CASE("the probability that comes with an event is its own") {
  const EventProbabilities p{0.5f, 0.2f, 0.1f};
  CHECK(choose_event(p, 0.3f).probability == doctest::Approx(0.5));
  CHECK(choose_event(p, 0.6f).probability == doctest::Approx(0.2));
  CHECK(choose_event(p, 0.75f).probability == doctest::Approx(0.1));
  CHECK(choose_event(p, 0.9f).probability == doctest::Approx(0.2));
}

TEST_CASE("an event with probability 0 is never chosen, not even by xi = 0") {
  const float largest = 1 - 0x1p-24f;
  CHECK(choose_event({0, 1, 0}, 0).event == Event::specular);
  CHECK(choose_event({0, 0, 1}, 0).event == Event::refraction);
  CHECK(choose_event({0, 0, 0}, 0).event == Event::absorption);
  CHECK(choose_event({1, 0, 0}, largest).event == Event::diffuse);
  CHECK(choose_event({0, 1, 0}, largest).event == Event::specular);
  CHECK(choose_event({0, 0, 1}, largest).event == Event::refraction);
}

TEST_CASE("an event's lobe is the one of its name") {
  CHECK(lobe_of(Event::diffuse) == stage3::Lobe::diffuse);
  CHECK(lobe_of(Event::specular) == stage3::Lobe::specular);
  CHECK(lobe_of(Event::refraction) == stage3::Lobe::refraction);
}
