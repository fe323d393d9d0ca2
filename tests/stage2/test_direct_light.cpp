// Direct light at one point, without a path around it.

#include <doctest/doctest.h>

#include <numbers>

#include "stages/2_next_event/path_tracer.hpp"
#include "support/exact_radiance.hpp"
#include "support/specular_scenes.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage2::direct_light;

TEST_SUITE_BEGIN("units");

namespace {

/// The statistics of `direct_light` at the surface that a ray hits.
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

/// The same by paths of one bounce, which may also hit a lamp.
Pixel lit_by_paths(const Scene& scene, const Ray& ray, int samples) {
  const stage2::PathTracer tracer(scene, {.max_bounces = 1});
  Random random(3, 1, 4);
  Pixel pixel;
  for (int i = 0; i < samples; ++i) pixel.add(tracer.radiance(ray, random));
  return pixel;
}

/// The share of a floor's light at the origin that comes from a square of side
/// 1 at a height, which begins at x = `from` and has the origin's z in its
/// middle.
double from_square(double from, double height) {
  return 2 * (rectangle_form_factor(from + 1, 0.5, height) -
              rectangle_form_factor(from, 0.5, height));
}

}  // namespace

// kd L_e F for a square, kd L_e (r/d)^2 cos for a ball. Red comes from the
// first square and the second ball, green from the second square, blue from
// the first ball.
//
// A program may sample lamps and also count them when hit, with weights whose
// sum is 1 (multiple importance sampling). Then `direct_light` is less, and
// paths of one bounce bring the rest.
TEST_CASE("direct light has its share from lamps of each type") {
  const Scene scene = scene_text(
      "[materials]\nfloor = { kd = 0.5 }\nred = { ke = [4, 0, 0] }\n"
      "green = { ke = [0, 5, 0] }\nblue = { ke = [0, 0, 30] }\n"
      "orange = { ke = [7, 0, 0] }\n" +
      text::plane("0, 1, 0", "0", "floor") +
      text::rectangle("-3, 2, -0.5", "1, 0, 0", "0, 0, 1", "red") +
      text::rectangle("2, 3, -0.5", "1, 0, 0", "0, 0, 1", "green") +
      text::sphere("0, 2, 3", "0.5", "blue") +
      text::sphere("0, 3, -3", "1", "orange"));
  const Ray down{{0, 0.1f, 0}, {0, -1, 0}};
  const double square = 0.5 * 5 * from_square(2, 3);
  const Pixel asked = lit(scene, down, 50'000);
  const bool all_is_asked = asked.mean[1] > 0.99 * square;
  const Pixel pixel =
      all_is_asked ? asked : lit_by_paths(scene, down, 50'000);
  const double ball = 0.5 * 30 * (0.25 / 13) * (2 / std::sqrt(13.0));
  const double other = 0.5 * 7 * (1.0 / 18) * (3 / std::sqrt(18.0));
  check_mean(
      "red: kd L_e F of the first square and kd L_e (r/d)^2 cos of "
      "the second ball",
      pixel, 0, 0.5 * 4 * from_square(2, 2) + other);
  check_mean("green: kd L_e F of the second square", pixel, 1, square);
  check_mean("blue: kd L_e (r/d)^2 cos of the first ball", pixel, 2, ball);
  INFO("the variance is ", pixel.variance(1),
       ": is another point of the lamp chosen each time?");
  CHECK(pixel.variance(1) > 0);
}

// Rays from the light: each point that they hit is seen by the light.
TEST_CASE("direct light is not shaded by the surface that it falls on") {
  struct Case {
    const char* name;
    std::string shape, center;
    Vec3 light, toward;
  };
  // Far from the origin, where floats are coarse.
  const std::string ball = text::sphere("1500, -700, 900", "5", "wall");
  const Case cases[] = {
      {"a slanted wall",
       text::plane("0.6, 0, 0.8", "-2000", "wall"),
       "1202, 3, 1602",
       {1202, 3, 1602},
       {-0.6f, 0, -0.8f}},
      {"a ball", ball, "1500, -690, 900", {1500, -690, 900}, {0, -1, 0}},
      {"a ball from inside",
       ball,
       "1500, -700, 900",
       {1500, -700, 900},
       {0, -1, 0}}};
  for (const Case& one : cases) {
    const Scene scene =
        scene_text("[materials]\nwall = { kd = 0.5 }\n" + one.shape +
                   text::point_light(one.center, "1"));
    Random random(5, 0, 0);
    int dark = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec2 u = 0.8f * random.uniform_2d() - 0.4f;
      const Vec3 aside(one.toward.z, one.toward.x, one.toward.y);
      const Vec3 direction = normalize(one.toward + u.x * aside +
                                       u.y * cross(aside, one.toward));
      dark += lit(scene, {one.light, direction}, 1).mean[0] == 0;
    }
    if (dark == 0) continue;
    FAIL_CHECK(dark << " of 1000 points on " << one.name
                    << " that see the light are dark, expected 0");
  }
}

// The wall's own normal points down; wo is above, and so is the light.
TEST_CASE("direct light falls on the side that is seen") {
  const auto wall_under = [](const std::string& center) {
    return scene_text("[materials]\nwall = { kd = 0.5 }\n" +
                      text::plane("0, -1, 0", "0", "wall") +
                      text::point_light(center, "1"));
  };
  const Ray down{{0, 0.1f, 0}, {0, -1, 0}};
  check_mean("kd/pi I/d^2 of a light above, d = 2",
             lit(wall_under("0, 2, 0"), down, 1), 0,
             0.5 / (4 * std::numbers::pi), 1e-4);
  check_mean("a light below, seen from above",
             lit(wall_under("0, -2, 0"), down, 1), 0, 0);
}

TEST_SUITE_END();
