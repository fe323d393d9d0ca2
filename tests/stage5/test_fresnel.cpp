// Fresnel's equations at the angles where their value is known.

#include <doctest/doctest.h>

#include "stages/5_fresnel_textures/path_tracer.hpp"
#include "support/each_or_mean.hpp"
#include "support/expectations.hpp"
#include "support/specular_scenes.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using namespace lightwalk::stage5;

TEST_SUITE_BEGIN("units");

namespace {

constexpr float into = 1 / 1.5f, out_of = 1.5f;

float cosine(double degrees) {
  return static_cast<float>(std::cos(degrees * std::acos(-1.0) / 180));
}

/// F must be that of Fresnel's equations. Schlick's approximation, R0 + (1 - R0)
/// (1 - cos)^5 with the cosine on the side outside, passes with a note.
void check_fresnel(double degrees, float eta_ratio, double exact) {
  const double n = static_cast<double>(eta_ratio);
  const double c = std::cos(degrees * std::acos(-1.0) / 180);
  const double outer =
      n <= 1 ? c : std::sqrt(std::max(0.0, 1 - n * n * (1 - c * c)));
  const double r0 = std::pow((n - 1) / (n + 1), 2);
  const double schlick = r0 + (1 - r0) * std::pow(1 - outer, 5);
  const auto f = static_cast<double>(
      fresnel_reflectance(static_cast<float>(c), eta_ratio));
  const auto is = [f](double value) {
    return std::abs(f - value) < 1e-4 * value + 1e-9;
  };
  if (is(exact)) return;
  if (is(schlick)) {
    MESSAGE(
        "F is Schlick's approximation, which passes; for glass, Fresnel's "
        "equations differ from it by up to 0.04");
    return;
  }
  FAIL_CHECK("F at " << degrees << " degrees with eta_o/eta_i = " << n << ": "
                     << f << ", expected " << exact
                     << " by Fresnel's equations");
}

}  // namespace

// ((1.5 - 1) / (1.5 + 1))^2 = 0.04
TEST_CASE("glass seen squarely reflects 4 %, from either side") {
  const auto squarely = [](float eta_ratio) {
    return static_cast<double>(fresnel_reflectance(1, eta_ratio));
  };
  check_value("F = ((1.5 - 1) / (1.5 + 1))^2 into glass", squarely(into),
              0.04, 2e-4);
  check_value("F = ((1.5 - 1) / (1.5 + 1))^2 out of glass", squarely(out_of),
              0.04, 2e-4);
  check_value("F = (0.33 / 2.33)^2 into water", squarely(1 / 1.33f),
              0.0200594, 2e-4);
  check_value("F = (1.42 / 3.42)^2 into diamond", squarely(1 / 2.42f),
              0.1723949, 2e-4);
}

TEST_CASE("at grazing angles everything is reflected") {
  check_value("F at 90 degrees into glass",
              static_cast<double>(fresnel_reflectance(0, into)), 1);
  const float near = fresnel_reflectance(cosine(89.99), into);
  INFO("F at 89.99 degrees into glass is ", near, ", expected above 0.99");
  CHECK(near > 0.99f);
}

// At Brewster's angle, arctan(1.5) = 56.3099 degrees, r_p = 0 and F = r_s^2/2.
// There cos_i = sin_o, so r_s = (1 - 1.5^2) / (1 + 1.5^2) = -0.384615.
TEST_CASE("at Brewster's angle nothing of the parallel part is reflected") {
  check_fresnel(56.309932, into, 0.384615385 * 0.384615385 / 2);
}

// 45 degrees: cos_i = sqrt(1 - 2/9) = 0.8819171, r_s = -0.3034, r_p = 0.0920.
TEST_CASE("at 45 degrees glass reflects 5.0 %") {
  check_fresnel(45, into, 0.0502398);
  // The same ray from inside: sin 45 / 1.5 = sin 28.1255.
  check_fresnel(28.125506, out_of, 0.0502398);
}

TEST_CASE("beyond the critical angle, 41.81 degrees, F is 1 inside") {
  for (const double degrees : {41.9, 60.0, 90.0}) {
    const float c = degrees == 90 ? 0 : cosine(degrees);
    check_value("F inside glass at " + text_of(degrees) + " degrees",
                static_cast<double>(fresnel_reflectance(c, out_of)), 1);
  }
  const float below = fresnel_reflectance(cosine(41.0), out_of);
  INFO("F inside glass at 41 degrees is ", below, ", expected less than 0.5");
  CHECK(below < 0.5f);
}

TEST_CASE("F is the same for both directions of a ray") {
  for (double degrees = 0; degrees < 89; degrees += 4) {
    const double sin_i = std::sin(degrees * std::acos(-1.0) / 180) / 1.5;
    const auto cos_i = static_cast<float>(std::sqrt(1 - sin_i * sin_i));
    check_value(
        "F inside glass for the ray that comes in at " + text_of(degrees) +
            " degrees, the F outside",
        static_cast<double>(fresnel_reflectance(cos_i, out_of)),
        static_cast<double>(fresnel_reflectance(cosine(degrees), into)),
        2e-3);
  }
}

TEST_CASE("no reflection where the index does not change") {
  for (const double degrees : {0.0, 30.0, 80.0}) {
    check_fresnel(degrees, 1, 0);
  }
}

// Up to rounding: the equations can also be written with the sines and tangents
// of angles, and then F may be 1.0000001.
TEST_CASE("F lies in [0, 1] and is a number, for every angle and index") {
  constexpr float rounding = 1e-5f;
  for (const float eta : {0.1f, 0.5f, 0.999f, 1.0f, 1.001f, 1.5f, 10.0f}) {
    for (int i = 0; i <= 1000; ++i) {
      const float cos_o = static_cast<float>(i) / 1000;
      const float f = fresnel_reflectance(cos_o, eta);
      if (f >= -rounding && f <= 1 + rounding) continue;
      FAIL("F is " << f << " at "
                   << std::acos(static_cast<double>(cos_o)) * 180 /
                          std::acos(-1.0)
                   << " degrees with eta_o/eta_i = " << eta
                   << ", expected from 0 to 1");
    }
  }
}

TEST_CASE(
    "fresnel turns ks into F ks and kt into (1 - F) kt, from either side") {
  const Scene scene = scene_text(
      "[materials]\nglass = { ks = 0.8, kt = 0.6, eta = 1.5, fresnel = true "
      "}\n" +
      ball("glass"));
  Hit hit = *scene.nearest_hit({{0, 0, -5}, {0, 0, 1}});
  const Material outside = material_at(scene, hit, {0, 0, -1});
  check_value("F ks outside, F = 0.04", red(outside.ks), 0.04 * 0.8, 2e-4);
  check_value("(1 - F) kt outside, F = 0.04", red(outside.kt), 0.96 * 0.6);
  hit = *scene.nearest_hit({{0, 0, 0}, {0, 0, 1}});
  const Vec3 slanted = normalize(Vec3(0.8f, 0, -0.6f));  // 53 degrees, inside
  const Material inside = material_at(scene, hit, slanted);
  check_value("F ks inside, beyond the critical angle, F = 1", red(inside.ks),
              0.8);
  check_value("(1 - F) kt inside, beyond the critical angle, F = 1",
              red(inside.kt), 0);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("analytic scenes");

// F + (1 - F) = 1: no light is lost, and each event's weight is k/p = 1.
TEST_CASE("a Fresnel glass ball and cube in a white room are invisible") {
  for (const std::string& shape : {ball("thing"), cube("thing")}) {
    const Scene scene =
        in_white_room("{ ks = 1, kt = 1, eta = 1.5, fresnel = true }", shape);
    RenderSettings settings;
    settings.max_bounces = 15;
    const PathTracer tracer(scene, settings);
    int seen = 0;
    EachOrMean each(1, 1e-4), unbounded(1, 1e-4);
    for (std::uint64_t i = 0; i < 20'000; ++i) {
      Random random(8, 0, i);
      const Ray ray = ray_at_thing(random);
      const float radiance = tracer.radiance(ray, random).x;
      if (radiance == 0) continue;  // still inside after 15 bounces
      ++seen;
      each.add(radiance);
    }
    INFO(seen, " of 20000 rays find out of the glass, expected over 10000");
    CHECK(seen > 1000);
    if (each.wrong().empty()) {
      each.check("rays that found out");
      continue;
    }
    // Events with other probabilities, or roulette besides: what is still
    // inside counts, too.
    const PathTracer endless(scene, {});
    for (std::uint64_t i = 0; i < 20'000; ++i) {
      Random random(8, 0, i);
      const Ray ray = ray_at_thing(random);
      unbounded.add(endless.radiance(ray, random).x);
    }
    unbounded.check("rays without a bound");
  }
}

// On average over all paths, with no bound, no light is lost either. Rays that
// enter a ball can leave it again at every turn.
TEST_CASE("Fresnel glass without a bound: the room's light, on average") {
  const Scene scene = in_white_room(
      "{ ks = 1, kt = 1, eta = 1.5, fresnel = true }", ball("thing"));
  const PathTracer tracer(scene, {});
  const Pixel pixel = estimate_of_thing(tracer, 100'000, 9);
  check_mean("a Fresnel glass ball in a room of radiance 1", pixel, 0, 1,
             1e-5);
}

// Of a ray at normal incidence 4 % are reflected at the front, which sees the
// room behind the camera, here black; the rest goes through.
TEST_CASE(
    "glass reflects with probability F, and the reflection's weight is 1") {
  const Scene scene = scene_text(
      "[materials]\nglass = { ks = 1, kt = 1, eta = 1.5, fresnel = true }\n"
      "lamp = { ke = 1 }\n[[shapes]]\ntype = \"plane\"\nnormal = [0, 0, -1]\n"
      "distance = 0\nmaterial = \"glass\"\n[[shapes]]\ntype = \"plane\"\n"
      "normal = [0, 0, 1]\ndistance = 9\nmaterial = \"lamp\"\n");
  const Ray ray{{0, 0, -5}, {0, 0, 1}};
  const Pixel pixel = estimate(PathTracer(scene, {}), ray, 100'000);
  check_mean("the reflected share of a white room, F = 0.04", pixel, 0, 0.04);
  // Each sample is 0 or 1, so the variance is F (1 - F); other probabilities
  // than F have another one.
  const double variance = pixel.variance(0) / (0.04 * 0.96);
  if (std::abs(variance - 1) > 0.07) {
    MESSAGE("glass that reflects 4 %: correct on average; ", variance,
            " times the noise of the course's own program");
  }
  // At 75 degrees Fresnel's equations say 0.2531 and Schlick's curve 0.2547.
  const Ray slanted{{0, 0, -5},
                    {std::sin(5 * pi / 12), 0, std::cos(5 * pi / 12)}};
  const Pixel aside = estimate(PathTracer(scene, {}), slanted, 100'000);
  check_value("the reflected share at 75 degrees, F = 0.2539", aside.mean[0],
              0.2539, 0.05);
}

TEST_SUITE_END();
