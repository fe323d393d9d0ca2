// What a path does from one surface to the next: where the next ray starts,
// on which side, and with which random numbers.

#include <doctest/doctest.h>

#include "stages/1_diffuse/path_tracer.hpp"
#include "support/each_or_mean.hpp"
#include "support/expectations.hpp"
#include "support/specular_scenes.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage1::PathTracer;

TEST_SUITE_BEGIN("analytic scenes");

namespace {

constexpr const char* materials = R"(
[materials]
floor = { kd = [0.8, 0.5, 0.2] }
black = { kd = 0 }
sky   = { ke = 2 }
dim   = { ke = 0.5 }
)";

std::string plane(const std::string& normal, const std::string& distance,
                  const std::string& material) {
  return "[[shapes]]\ntype = \"plane\"\nnormal = " + normal +
         "\ndistance = " + distance + "\nmaterial = \"" + material + "\"\n";
}

PathTracer tracer(const Scene& scene, int max_bounces,
                  Sampling sampling = Sampling::cosine) {
  RenderSettings settings;
  settings.max_bounces = max_bounces;
  settings.sampling = sampling;
  return PathTracer(scene, settings);
}

}  // namespace

// Radiance does not depend on the angle at which it leaves: no cosine.
TEST_CASE("a lamp is as bright from the side as from the front") {
  const Scene scene = scene_text(materials + plane("[0, 1, 0]", "0", "sky"));
  Random random(1, 0, 0);
  for (const Vec3 direction :
       {Vec3(0, -1, 0), Vec3(0.6f, -0.8f, 0), Vec3(0, -0.1f, 1)}) {
    const Ray ray{{0, 1, 0}, normalize(direction)};
    check_color("ke toward " + text_of(-ray.direction) + ", without a cosine",
                tracer(scene, 0).radiance(ray, random), Vec3(2));
  }
}

// One wall between two skies. Whichever way its normal points, it sends back
// the light of the sky on the side that it is seen from.
TEST_CASE("a wall scatters to the side that it is seen from") {
  for (const std::string normal : {"[0, 1, 0]", "[0, -1, 0]"}) {
    INFO("the wall's normal is ", normal);
    const Scene scene = scene_text(materials + plane(normal, "0", "floor") +
                                   plane("[0, -1, 0]", "1", "sky") +
                                   plane("[0, 1, 0]", "1", "dim"));
    Random random(1, 0, 0);
    EachOrMean above(0.8 * 2, 1e-5), below(0.8 * 0.5, 1e-5);
    for (int i = 0; i < 100; ++i) {
      const Ray down{{0, 0.5f, 0}, {0.6f, -0.8f, 0}};
      const Ray up{{0, -0.5f, 0}, {0.6f, 0.8f, 0}};
      above.add(tracer(scene, 1).radiance(down, random).x);
      below.add(tracer(scene, 1).radiance(up, random).x);
    }
    above.check("kd ke of the sky above, seen from above");
    below.check("kd ke of the dim sky below, seen from below");
  }
}

// Every direction that leaves the surface hits white, so every sample is kd.
// A ray that hits the surface again has used up its bounce, and brings
// nothing.
TEST_CASE("a floor has no dark spots where rays hit it again") {
  const Scene slanted =
      scene_text(materials + plane("[0.48, 0.6, 0.64]", "10000", "floor") +
                 plane("[-0.48, -0.6, -0.64]", "-9000", "sky"));
  const Vec3 normal(0.48f, 0.6f, 0.64f);
  Random random(1, 0, 0);
  EachOrMean floor(0.8 * 2, 1e-5), round(0.8, 1e-5);
  for (int i = 0; i < 10'000; ++i) {
    const Vec2 u(random.uniform_2d());
    const Vec3 aside = 5000 * (u.x - 0.5f) * Vec3(0.8f, -0.64f, 0) +
                       5000 * (u.y - 0.5f) * Vec3(0, -0.64f, 0.6f);
    const Ray ray{-9500.0f * normal + aside, -normal};
    floor.add(tracer(slanted, 1).radiance(ray, random).x);
  }
  floor.check("kd ke of a slanted floor far away");
  const Scene ball_in_room = in_white_room("{ kd = 0.8 }", ball("thing"));
  for (int i = 0; i < 10'000; ++i) {
    const Ray ray = ray_at_thing(random);
    round.add(tracer(ball_in_room, 1).radiance(ray, random).x);
  }
  round.check("kd ke of a ball in a white room");
}

// The plate lies just over the floor, and the floor below it is dark.
TEST_CASE("no light leaks through a crack a hundredth wide") {
  const Scene scene = scene_text(
      materials + plane("[0, 1, 0]", "0", "floor") +
      plane("[0, -1, 0]", "0.01", "black") + plane("[0, -1, 0]", "1", "sky"));
  Random random(1, 0, 0);
  for (int i = 0; i < 100; ++i) {
    const Ray ray{{0, 0.005f, 0}, {0.6f, -0.8f, 0}};
    require_color("a floor under a plate",
                  tracer(scene, 1).radiance(ray, random), Vec3(0));
  }
}

// A wall that shines stands at one side of the floor; the other side is open.
// Half of the directions hit the wall, whatever their angle: a sample is kd
// ke or 0, each with probability 1/2. With cosine sampling the mean is kd ke
// / 2, and the variance (kd ke)^2 / 4.
TEST_CASE("a floor seen from anywhere under half a sky is half as bright") {
  const char* walls[] = {"[-1, 0, 0]", "[1, 0, 0]", "[0, 0, -1]", "[0, 0, 1]",
                         "[3, 0, 4]"};
  const double whole = 0.8 * 2;
  for (const std::string wall : walls) {
    INFO("the sky's normal is ", wall);
    const Scene scene =
        scene_text(materials + plane("[0, 1, 0]", "1", "floor") +
                   plane(wall, "5", "sky"));
    for (const Vec3 direction :
         {Vec3(0, -1, 0), Vec3(0.8f, -0.6f, 0), Vec3(-0.5f, -0.5f, 0.6f)}) {
      const Ray ray{{0, 0, 0}, normalize(direction)};
      const Pixel pixel = estimate(tracer(scene, 1), ray, 20'000);
      check_mean("kd ke / 2 with p = cos/pi", pixel, 0, whole / 2);
      check_variance("kd ke / 2, (kd ke)^2/4", pixel, 0, whole * whole / 4,
                     0.01);
      const Pixel uniform =
          estimate(tracer(scene, 1, Sampling::uniform), ray, 20'000);
      check_mean("kd ke / 2 with p = 1/(2 pi)", uniform, 0, whole / 2);
    }
  }
}

// Under half a sky a thousand samples cannot all be alike.
TEST_CASE("every sample takes another direction") {
  const Scene scene =
      scene_text(materials + plane("[0, 1, 0]", "1", "floor") +
                 plane("[-1, 0, 0]", "5", "sky"));
  int bright = 0;
  constexpr int samples = 1000;
  for (std::uint64_t i = 0; i < samples; ++i) {
    Random random(1, 0, i);
    const Ray ray{{0, 0, 0}, {0, -1, 0}};
    if (tracer(scene, 1).radiance(ray, random).x > 0) ++bright;
  }
  INFO(
      bright, " of ", samples,
      " paths met the sky, expected about half, or fewer where roulette ends "
      "some: each sample needs its own random numbers");
  CHECK(bright > samples / 10);
  CHECK(bright < samples * 9 / 10);
}

TEST_SUITE_END();
