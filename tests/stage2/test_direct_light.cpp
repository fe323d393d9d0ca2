// Direct light at one point, asked for without a path around it.

#include <doctest/doctest.h>

#include <numbers>

#include "stages/2_next_event/path_tracer.hpp"
#include "support/expectations.hpp"
#include "support/renders.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage2::direct_light;

TEST_SUITE_BEGIN("units");

namespace {

/// What the lights bring to the surface that a ray meets, in the mean.
Pixel lit(const Scene& scene, const Ray& ray, int samples) {
  const std::optional<Hit> hit = scene.nearest_hit(ray);
  REQUIRE(hit.has_value());
  const Surface surface(*hit, *hit->material, -ray.direction);
  Random random(3, 1, 4);
  Pixel pixel;
  for (int i = 0; i < samples; ++i) {
    pixel.add(direct_light(scene, surface, random));
  }
  return pixel;
}

/// The share of a floor's light at the origin that comes from a square of side
/// 1 whose least corner is given: Lambert's sum over its edges, over pi.
double from_square(double x, double y, double z) {
  const DoubleVec3 corners[] = {
      {x, y, z}, {x + 1, y, z}, {x + 1, y, z + 1}, {x, y, z + 1}};
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    const DoubleVec3 a = normalize(corners[i]);
    const DoubleVec3 b = normalize(corners[(i + 1) % 4]);
    sum += std::acos(dot(a, b)) * normalize(cross(b, a)).y;
  }
  return std::abs(sum) / (2 * std::numbers::pi);
}

}  // namespace

// kd L_e F for a square, kd L_e (r/d)^2 cos for a ball. Red comes from the
// first square and the second ball, green from the second square, blue from
// the first ball.
TEST_CASE("direct light has its share from lamps of each type") {
  const Scene scene = scene_text(R"(
[materials]
floor  = { kd = 0.5 }
red    = { ke = [4, 0, 0] }
green  = { ke = [0, 5, 0] }
blue   = { ke = [0, 0, 30] }
orange = { ke = [7, 0, 0] }
[[shapes]]
type = "plane"
normal = [0, 1, 0]
distance = 0
material = "floor"
[[shapes]]
type = "rectangle"
corner = [-3, 2, -0.5]
edge_u = [1, 0, 0]
edge_v = [0, 0, 1]
material = "red"
[[shapes]]
type = "rectangle"
corner = [2, 3, -0.5]
edge_u = [1, 0, 0]
edge_v = [0, 0, 1]
material = "green"
[[shapes]]
type = "sphere"
center = [0, 2, 3]
radius = 0.5
material = "blue"
[[shapes]]
type = "sphere"
center = [0, 3, -3]
radius = 1
material = "orange"
)");
  const Pixel pixel = lit(scene, {{0, 0.1f, 0}, {0, -1, 0}}, 50'000);
  const double ball = 0.5 * 30 * (0.25 / 13) * (2 / std::sqrt(13.0));
  const double other = 0.5 * 7 * (1.0 / 18) * (3 / std::sqrt(18.0));
  check_mean(
      "red: kd L_e F of the first square and kd L_e (r/d)^2 cos of "
      "the second ball",
      pixel, 0, 0.5 * 4 * from_square(-3, 2, -0.5) + other);
  check_mean("green: kd L_e F of the second square", pixel, 1,
             0.5 * 5 * from_square(2, 3, -0.5));
  check_mean("blue: kd L_e (r/d)^2 cos of the first ball", pixel, 2, ball);
  INFO("the variance is ", pixel.variance(1),
       ": is another point of the lamp chosen each time?");
  CHECK(pixel.variance(1) > 0);
}

// Rays from the light: each point that they meet is seen by the light.
TEST_CASE("direct light is not shaded by the surface that it falls on") {
  struct Case {
    const char* name;
    const char* shape;
    Vec3 light, towards;
  };
  // Far from the origin, where floats are coarse.
  const Case cases[] = {
      {"a slanted wall",
       "type = \"plane\"\nnormal = [0.6, 0, 0.8]\ndistance = -2000\n",
       {1202, 3, 1602},
       {-0.6f, 0, -0.8f}},
      {"a ball",
       "type = \"sphere\"\ncenter = [1500, -700, 900]\nradius = 5\n",
       {1500, -690, 900},
       {0, -1, 0}},
      {"a ball from inside",
       "type = \"sphere\"\ncenter = [1500, -700, 900]\nradius = 5\n",
       {1500, -700, 900},
       {0, -1, 0}}};
  for (const Case& one : cases) {
    std::ostringstream text;
    text << "[materials]\nwall = { kd = 0.5 }\n[[shapes]]\n"
         << one.shape << "material = \"wall\"\n[[lights]]\ntype = \"point\"\n"
         << "intensity = 1\ncenter = [" << one.light.x << ", " << one.light.y
         << ", " << one.light.z << "]\n";
    const Scene scene = scene_text(text.str());
    Random random(5, 0, 0);
    int dark = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec2 u = 0.8f * random.uniform_2d() - 0.4f;
      const Vec3 aside(one.towards.z, one.towards.x, one.towards.y);
      const Vec3 direction = normalize(one.towards + u.x * aside +
                                       u.y * cross(aside, one.towards));
      dark += lit(scene, {one.light, direction}, 1).mean[0] == 0;
    }
    INFO(dark, " of 1000 points on ", one.name,
         " that see the light are dark, expected 0");
    CHECK(dark == 0);
  }
}

// The wall's own normal points down; wo is above, and so is the light.
TEST_CASE("direct light comes to the side that is seen") {
  const auto wall_under = [](const char* center) {
    return scene_text(
        "[materials]\nwall = { kd = 0.5 }\n[[shapes]]\ntype = \"plane\"\n"
        "normal = [0, -1, 0]\ndistance = 0\nmaterial = \"wall\"\n[[lights]]\n"
        "type = \"point\"\nintensity = 1\ncenter = " +
        std::string(center) + "\n");
  };
  const Ray down{{0, 0.1f, 0}, {0, -1, 0}};
  check_mean("kd/pi I/d^2 of a light above, d = 2",
             lit(wall_under("[0, 2, 0]"), down, 1), 0,
             0.5 / (4 * std::numbers::pi), 1e-4);
  check_mean("a light below, seen from above",
             lit(wall_under("[0, -2, 0]"), down, 1), 0, 0);
}

TEST_SUITE_END();
