// Scenes whose mean, variance and path length are known.

#include <doctest/doctest.h>

#include "stages/4_russian_roulette/path_tracer.hpp"
#include "support/specular_scenes.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage4::PathTracer;

namespace {

// A diffuse sphere from inside, with a point light of intensity pi in its
// centre: each hit sees the light with radiance kd.
std::string lit_sphere(const std::string& kd) {
  return "[materials]\nwall = { kd = " + kd +
         " }\n[[shapes]]\ntype = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\n"
         "material = \"wall\"\n[[lights]]\ntype = \"point\"\n"
         "center = [0, 0, 0]\nintensity = 3.14159265\n";
}

const Ray inside{{0.2f, 0.1f, -0.3f}, {0, 0, 1}};

}  // namespace

// Grey: survival is kd = 1/2, so the throughput stays 1 and a path of n hits
// brings n/2. n is geometric with mean 2 and variance 2: the mean is 1 and the
// variance 2/4. Roulette that is switched off has the same mean and no variance.
TEST_CASE("roulette: mean 1, variance 1/2, and 2 hits on average") {
  const Scene scene = scene_text(lit_sphere("0.5"));
  const PathTracer tracer(scene, {});
  constexpr int samples = 200'000;
  const std::uint64_t rays_before = rays_cast;
  const Pixel pixel = estimate(tracer, inside, samples);
  const double rays = static_cast<double>(rays_cast - rays_before) / samples;
  INFO("mean ", pixel.mean[0], ", variance ", pixel.variance(0), ", rays ",
       rays);
  CHECK(deviations(pixel, 0, 1) < 4.4);
  CHECK(pixel.variance(0) == doctest::Approx(0.5).epsilon(0.03));
  // A ray and a shadow ray for each hit; sigma of the mean is 0.006.
  CHECK(rays == doctest::Approx(4).epsilon(0.008));
}

// 1/2 + 1/4 + ... = 1, and for kd = 0.8: 0.8 / (1 - 0.8) = 4.
TEST_CASE("without a bound all the light is there") {
  const Scene scene = scene_text(lit_sphere("[0.8, 0.4, 0.1]"));
  const Pixel pixel = estimate(PathTracer(scene, {}), inside, 200'000);
  const double truth[] = {4, 2.0 / 3, 1.0 / 9};
  for (int c = 0; c < 3; ++c) {
    CAPTURE(c);
    CAPTURE(pixel.mean[c]);
    CHECK(deviations(pixel, c, truth[c]) < 4.4);
  }
}

TEST_CASE("with a bound of N bounces there are N terms of the series") {
  const Scene scene = scene_text(lit_sphere("0.5"));
  for (const int n : {0, 1, 2, 3, 5}) {
    CAPTURE(n);
    RenderSettings settings;
    settings.max_bounces = n;
    const Pixel pixel =
        estimate(PathTracer(scene, settings), inside, 100'000);
    const double truth = 1 - std::exp2(-n);
    INFO("mean ", pixel.mean[0], ", expected ", truth);
    CHECK(std::abs(pixel.mean[0] - truth) <=
          4.4 * std::sqrt(pixel.variance(0) / pixel.samples) + 1e-6);
  }
}

// A room's wall seen through every lobe at once: kd + ks of the room's light
// comes directly, and for kt the ball's inside is diffuse and specular too.
// Where only one lobe has a colour, the others must not lose theirs.
TEST_CASE("each lobe keeps its colour, whichever event is drawn") {
  const Scene scene = in_white_room(
      "{ kd = [0.8, 0, 0.1], ks = [0.1, 0.9, 0] }", ball("thing"));
  RenderSettings settings;
  settings.max_bounces = 1;
  const Pixel pixel =
      estimate(PathTracer(scene, settings), {{0, 0, -5}, {0, 0, 1}}, 100'000);
  const double truth[] = {0.9, 0.9, 0.1};
  for (int c = 0; c < 3; ++c) {
    CAPTURE(c);
    CAPTURE(pixel.mean[c]);
    CHECK(deviations(pixel, c, truth[c]) < 4.4);
  }
}

// kd + ks = 1 in red, ks + kt = 1 in green: nothing is lost, as long as a path
// can end anywhere. Beyond bounce 16 roulette adds noise, not light.
TEST_CASE("what loses no light is invisible in a white room, in the mean") {
  struct Case {
    std::string material, shape;
    bool exact;  // every path of fewer than 16 bounces
  };
  const Case cases[] = {
      {"{ ks = 1 }", ball("thing"), true},
      {"{ kt = 1 }", ball("thing"), true},
      {"{ ks = 0.1, kt = 0.9 }", ball("thing"), false},
      {"{ kd = 0.5, ks = 0.5 }", ball("thing"), false},
      {"{ kd = 0.2, ks = 0.3, kt = 0.5 }", ball("thing"), false},
  };
  for (const Case& one : cases) {
    CAPTURE(one.material);
    const Scene scene = in_white_room(one.material, one.shape);
    const PathTracer tracer(scene, {});
    Pixel pixel;
    for (std::uint64_t i = 0; i < 40'000; ++i) {
      Random random(8, 0, i);
      const Ray ray = ray_at_thing(random);
      const float radiance = tracer.radiance(ray, random).x;
      if (one.exact) REQUIRE(radiance == doctest::Approx(1).epsilon(1e-5));
      pixel.add(Vec3(radiance));
    }
    CAPTURE(pixel.mean[0]);
    CHECK(std::abs(pixel.mean[0] - 1) <=
          4.4 * std::sqrt(pixel.variance(0) / pixel.samples) + 1e-6);
  }
}

// Most paths find out of the cube within 16 bounces, and bring 1. The rest are
// played for at 0.95, and bring 1/0.95^n or nothing: 1 in the mean, but for
// those that no number of bounces frees, which stage 3's test counts.
TEST_CASE("a glass cube in a white room: 1, to rounding, before bounce 16") {
  const Scene scene = in_white_room("{ kt = 1 }", cube("thing"));
  RenderSettings settings;
  settings.max_bounces = 15;
  const PathTracer tracer(scene, settings);
  int seen = 0;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    Random random(8, 0, i);
    const Ray ray = ray_at_thing(random);
    const float radiance = tracer.radiance(ray, random).x;
    if (radiance == 0) continue;
    ++seen;
    CAPTURE(i);
    REQUIRE(radiance == doctest::Approx(1).epsilon(1e-4));
  }
  CHECK(seen > 10'000);
}

TEST_CASE("a path that glass never lets out ends all the same") {
  const Scene scene = in_white_room("{ kt = 1 }", ball("thing"));
  const PathTracer tracer(scene, {});
  const Ray grazing{{0.99f, 0, 0}, normalize(Vec3(0.01f, 1, 0))};
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Random random(1, 0, i);
    const std::uint64_t before = rays_cast;
    CHECK(tracer.radiance(grazing, random) == Vec3(0));
    // Beyond 16 bounces each survives with 0.95: 600 more has p = 4e-14.
    REQUIRE(rays_cast - before < 616);
  }
}
