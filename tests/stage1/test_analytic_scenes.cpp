// Scenes whose radiance can be written down. Most have no noise at all.

#include <doctest/doctest.h>

#include "stages/1_diffuse/path_tracer.hpp"
#include "support/each_or_mean.hpp"
#include "support/expectations.hpp"
#include "support/renders.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage1::PathTracer;

TEST_SUITE_BEGIN("analytic scenes");

namespace {

constexpr const char* floor_and_ceiling = R"(
[materials]
floor = { kd = [0.7, 0.4, 0.1] }
sky   = { ke = [1.5, 3, 6] }
[[shapes]]
type = "plane"
normal = [0, 1, 0]
distance = 1
material = "floor"
[[shapes]]
type = "plane"
normal = [0, -1, 0]
distance = 1
material = "sky"
)";

const Ray down{{0, 0, 0}, {0.6f, -0.8f, 0}};

RenderSettings settings(int max_bounces, Sampling sampling) {
  RenderSettings result;
  result.max_bounces = max_bounces;
  result.sampling = sampling;
  return result;
}

}  // namespace

// Every direction above the floor hits the sky, so L = kd/pi * ke * pi.
// With density cos/pi the weight is kd, whatever the direction: no noise.
TEST_CASE("a floor under a uniform sky is kd ke, in every single sample") {
  const Scene scene = scene_text(floor_and_ceiling);
  const Vec3 expected = Vec3(0.7f, 0.4f, 0.1f) * Vec3(1.5f, 3, 6);
  const PathTracer tracer(scene, settings(1, Sampling::cosine));
  for (int c = 0; c < 3; ++c) {
    EachOrMean all(static_cast<double>(expected[c]), 2e-6);
    for (std::uint64_t sample = 0; sample < 1000; ++sample) {
      Random random(1, 0, sample);
      all.add(tracer.radiance(down, random)[c]);
    }
    all.check("L = kd ke with p = cos/pi, channel " + std::to_string(c));
  }
}

// Uniformly sampled the weight is 2 kd cos with cos uniform in [0, 1]: mean
// kd, second moment 4 kd^2/3, so the variance is kd^2/3.
TEST_CASE(
    "uniform sampling has the same mean, and the variance (kd ke)^2/3") {
  const Scene scene = scene_text(floor_and_ceiling);
  const Vec3 expected = Vec3(0.7f, 0.4f, 0.1f) * Vec3(1.5f, 3, 6);
  const Pixel pixel = estimate(
      PathTracer(scene, settings(1, Sampling::uniform)), down, 100'000);
  for (int c = 0; c < 3; ++c) {
    const double truth = static_cast<double>(expected[c]);
    const std::string what =
        "L = kd ke with p = 1/(2 pi), channel " + std::to_string(c);
    check_mean(what, pixel, c, truth);
    check_variance(what + ", (kd ke)^2/3", pixel, c, truth * truth / 3, 0.02);
  }
}

TEST_CASE("without bounces only what emits is seen") {
  const Scene scene = scene_text(floor_and_ceiling);
  const PathTracer tracer(scene, settings(0, Sampling::cosine));
  Random random(1, 0, 0);
  check_color("a floor with max_bounces 0", tracer.radiance(down, random),
              Vec3(0));
  const Ray up{{0, 0, 0}, {0.6f, 0.8f, 0}};
  check_color("a sky of radiance ke with max_bounces 0",
              tracer.radiance(up, random), Vec3(1.5f, 3, 6));
}

TEST_CASE("a lamp shines on the side of its normal only") {
  const Scene scene = scene_text(R"(
[materials]
lamp = { ke = 2 }
[[shapes]]
type = "rectangle"
corner = [-1, -1, 0]
edge_u = [2, 0, 0]
edge_v = [0, 2, 0]
material = "lamp"
)");
  const PathTracer tracer(scene, settings(8, Sampling::cosine));
  Random random(1, 0, 0);
  check_color("ke of a lamp from the front",
              tracer.radiance({{0, 0, 5}, {0, 0, -1}}, random), Vec3(2));
  check_color("ke of a lamp from behind",
              tracer.radiance({{0, 0, -5}, {0, 0, 1}}, random), Vec3(0));
}

TEST_CASE("a ray that meets nothing brings nothing") {
  const Scene scene = scene_text(floor_and_ceiling);
  const PathTracer tracer(scene, settings(8, Sampling::cosine));
  Random random(1, 0, 0);
  check_color("a ray along the floor that never meets it",
              tracer.radiance({{0, 0, 0}, {1, 0, 0}}, random), Vec3(0));
}

// A ball of radius r = 1/2 that emits ke, within a diffuse sphere of radius 1.
// From any point of the outer sphere the ball fills F = r^2 of the
// cosine-weighted hemisphere, and the rest is the outer sphere again. With N
// bounces: L = kd ke F (1 + q + ... + q^(N-1)), q = kd (1 - F).
TEST_CASE("a lamp within a sphere: N bounces are N terms of a power series") {
  const Scene scene = scene_text(R"(
[materials]
wall = { kd = 0.8 }
lamp = { ke = 3 }
[[shapes]]
type = "sphere"
center = [0, 0, 0]
radius = 1
material = "wall"
[[shapes]]
type = "sphere"
center = [0, 0, 0]
radius = 0.5
material = "lamp"
)");
  const Ray outwards{{0.6f, 0, 0}, {1, 0, 0}};
  const double kd = 0.8, form_factor = 0.25, q = kd * (1 - form_factor);
  double expected = 0, term = kd * 3 * form_factor;
  for (const int max_bounces : {1, 2, 3, 4}) {
    expected += term;
    term *= q;
    for (const Sampling sampling : {Sampling::cosine, Sampling::uniform}) {
      const PathTracer tracer(scene, settings(max_bounces, sampling));
      const Pixel pixel = estimate(tracer, outwards, 40'000);
      check_mean("kd ke F (1 + q + ...), " + bounces_in_words(max_bounces) +
                     ", " +
                     (sampling == Sampling::uniform ? "uniform" : "cosine") +
                     " sampling",
                 pixel, 0, expected);
    }
  }
}

// The box's walls: what bounces off a colored wall has its color.
TEST_CASE("red and blue swapped in the scene are swapped in the radiance") {
  std::string text = floor_and_ceiling;
  const Scene scene = scene_text(text);
  text.replace(text.find("[0.7, 0.4, 0.1]"), 15, "[0.1, 0.4, 0.7]");
  text.replace(text.find("[1.5, 3, 6]"), 11, "[6, 3, 1.5]");
  const Scene swapped = scene_text(text);
  Random a(1, 0, 0), b(1, 0, 0);
  const auto cosine = settings(1, Sampling::cosine);
  const Vec3 one = PathTracer(scene, cosine).radiance(down, a);
  const Vec3 other = PathTracer(swapped, cosine).radiance(down, b);
  check_color("the same colors, with red and blue swapped", one,
              Vec3(other.z, other.y, other.x), 0);
}

TEST_SUITE_END();
