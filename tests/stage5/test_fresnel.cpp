// Fresnel's equations at the angles where their value is known.

#include <doctest/doctest.h>

#include "stages/5_fresnel_textures/path_tracer.hpp"
#include "support/each_or_mean.hpp"
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

/// F must be what Fresnel's equations say or, which is accepted, what Schlick's
/// curve says: R0 + (1 - R0) (1 - cos)^5, with the cosine on the side outside.
void check_fresnel(double degrees, float eta_ratio, double exact) {
  const double n = static_cast<double>(eta_ratio);
  const double c = std::cos(degrees * std::acos(-1.0) / 180);
  const double outer =
      n <= 1 ? c : std::sqrt(std::max(0.0, 1 - n * n * (1 - c * c)));
  const double r0 = std::pow((n - 1) / (n + 1), 2);
  const double schlick = r0 + (1 - r0) * std::pow(1 - outer, 5);
  const auto f = static_cast<double>(
      fresnel_reflectance(static_cast<float>(c), eta_ratio));
  INFO(degrees, " degrees: ", f, ", Fresnel ", exact, ", Schlick ", schlick);
  const auto is = [f](double value) {
    return std::abs(f - value) < 1e-4 * value + 1e-9;
  };
  CHECK((is(exact) || is(schlick)));
}

}  // namespace

// ((1.5 - 1) / (1.5 + 1))^2 = 0.04
TEST_CASE("glass seen squarely reflects 4 %, from either side") {
  CHECK(fresnel_reflectance(1, into) == doctest::Approx(0.04).epsilon(1e-5));
  CHECK(fresnel_reflectance(1, out_of) ==
        doctest::Approx(0.04).epsilon(1e-5));
  // Water, 1.33: (0.33 / 2.33)^2. Diamond, 2.42: (1.42 / 3.42)^2.
  CHECK(fresnel_reflectance(1, 1 / 1.33f) == doctest::Approx(0.0200594));
  CHECK(fresnel_reflectance(1, 1 / 2.42f) == doctest::Approx(0.1723949));
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

TEST_CASE("at grazing angles everything is reflected") {
  CHECK(fresnel_reflectance(0, into) == doctest::Approx(1));
  CHECK(fresnel_reflectance(cosine(89.99), into) > 0.99f);
}

TEST_CASE("beyond the critical angle, 41.81 degrees, F is 1 inside") {
  CHECK(fresnel_reflectance(cosine(41.9), out_of) == 1);
  CHECK(fresnel_reflectance(cosine(60), out_of) == 1);
  CHECK(fresnel_reflectance(0, out_of) == 1);
  CHECK(fresnel_reflectance(cosine(41.0), out_of) < 0.5f);
}

TEST_CASE("F is the same for both directions of a ray") {
  for (double degrees = 0; degrees < 89; degrees += 4) {
    CAPTURE(degrees);
    const double sin_i = std::sin(degrees * std::acos(-1.0) / 180) / 1.5;
    const auto cos_i = static_cast<float>(std::sqrt(1 - sin_i * sin_i));
    CHECK(fresnel_reflectance(cosine(degrees), into) ==
          doctest::Approx(fresnel_reflectance(cos_i, out_of)).epsilon(1e-3));
  }
}

TEST_CASE("no border, no reflection") {
  for (const double degrees : {0.0, 30.0, 80.0}) {
    check_fresnel(degrees, 1, 0);
  }
}

TEST_CASE("F lies in [0, 1] and is a number, for every angle and index") {
  for (const float eta : {0.1f, 0.5f, 0.999f, 1.0f, 1.001f, 1.5f, 10.0f}) {
    for (int i = 0; i <= 1000; ++i) {
      const float f = fresnel_reflectance(static_cast<float>(i) / 1000, eta);
      CAPTURE(eta);
      CAPTURE(i);
      REQUIRE(f >= 0);
      REQUIRE(f <= 1);
    }
  }
}

TEST_CASE(
    "fresnel turns ks into F ks and kt into (1 - F) kt, at either side") {
  const Scene scene = scene_text(
      "[materials]\nglass = { ks = 0.8, kt = 0.6, eta = 1.5, fresnel = true "
      "}\n" +
      ball("glass"));
  Hit hit = *scene.nearest_hit({{0, 0, -5}, {0, 0, 1}});
  const Material outside = material_at(scene, hit, {0, 0, -1});
  CHECK(outside.ks.x == doctest::Approx(0.04 * 0.8).epsilon(1e-5));
  CHECK(outside.kt.x == doctest::Approx(0.96 * 0.6).epsilon(1e-5));
  hit = *scene.nearest_hit({{0, 0, 0}, {0, 0, 1}});
  const Vec3 slanted = normalize(Vec3(0.8f, 0, -0.6f));  // 53 degrees, inside
  const Material inside = material_at(scene, hit, slanted);
  CHECK(inside.ks.x == doctest::Approx(0.8));
  CHECK(inside.kt.x == 0);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("analytic scenes");

// F + (1 - F) = 1: nothing is lost, and each event's weight is k/p = 1.
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
    CHECK(seen > 1000);
    if (each.counts_each()) {
      each.check("rays that found out");
      continue;
    }
    // Events with other probabilities: what is still inside counts, too.
    const PathTracer endless(scene, {});
    for (std::uint64_t i = 0; i < 20'000; ++i) {
      Random random(8, 0, i);
      const Ray ray = ray_at_thing(random);
      unbounded.add(endless.radiance(ray, random).x);
    }
    unbounded.check("rays without a bound");
  }
}

// In the mean over all paths, with no bound, nothing is lost either. Rays that
// enter a ball can leave it again at every turn.
TEST_CASE("Fresnel glass without a bound: the room's light, in the mean") {
  const Scene scene = in_white_room(
      "{ ks = 1, kt = 1, eta = 1.5, fresnel = true }", ball("thing"));
  const PathTracer tracer(scene, {});
  const Pixel pixel = estimate_of_thing(tracer, 100'000, 9);
  CAPTURE(pixel.mean[0]);
  CHECK(std::abs(pixel.mean[0] - 1) <=
        4.4 * std::sqrt(pixel.variance(0) / pixel.samples) + 1e-5);
}

// Of a ray at normal incidence 4 % are reflected at the front, which sees the
// room behind the camera, here black; the rest goes through.
TEST_CASE("how often glass reflects is F, and its picture's weight is 1") {
  const Scene scene = scene_text(
      "[materials]\nglass = { ks = 1, kt = 1, eta = 1.5, fresnel = true }\n"
      "lamp = { ke = 1 }\n[[shapes]]\ntype = \"plane\"\nnormal = [0, 0, -1]\n"
      "distance = 0\nmaterial = \"glass\"\n[[shapes]]\ntype = \"plane\"\n"
      "normal = [0, 0, 1]\ndistance = 9\nmaterial = \"lamp\"\n");
  const Ray ray{{0, 0, -5}, {0, 0, 1}};
  const Pixel pixel = estimate(PathTracer(scene, {}), ray, 100'000);
  CHECK(deviations(pixel, 0, 0.04) < 4.4);
  // Each sample is 0 or 1, so the variance is F (1 - F); other probabilities
  // than F have another one.
  const double variance = pixel.variance(0) / (0.04 * 0.96);
  if (std::abs(variance - 1) > 0.07) {
    MESSAGE("glass that reflects 4 %: right in the mean; ", variance,
            " times the noise of the course's own program");
  }
  // At 75 degrees Fresnel's equations say 0.2531 and Schlick's curve 0.2547.
  const Ray slanted{{0, 0, -5},
                    {std::sin(5 * pi / 12), 0, std::cos(5 * pi / 12)}};
  const Pixel aside = estimate(PathTracer(scene, {}), slanted, 100'000);
  CHECK(aside.mean[0] == doctest::Approx(0.2539).epsilon(0.03));
}

TEST_SUITE_END();
