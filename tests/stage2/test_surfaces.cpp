// Surfaces under lights: which side is lit, what casts shadows on them, and
// what each lamp adds.

#include <doctest/doctest.h>

#include <set>

#include "stages/2_next_event/path_tracer.hpp"
#include "support/expectations.hpp"
#include "support/renders.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage2::PathTracer;

TEST_SUITE_BEGIN("analytic scenes");

namespace {

constexpr const char* materials = R"(
[materials]
floor = { kd = 0.5 }
black = { kd = 0 }
lamp  = { ke = 4 }
)";

std::string plane(const std::string& normal, const std::string& distance,
                  const std::string& material) {
  return "[[shapes]]\ntype = \"plane\"\nnormal = " + normal +
         "\ndistance = " + distance + "\nmaterial = \"" + material + "\"\n";
}

std::string point_light(const std::string& center) {
  return "[[lights]]\ntype = \"point\"\ncenter = " + center +
         "\nintensity = 9\n";
}

std::string rectangle(const std::string& corner, const std::string& edge_u,
                      const std::string& edge_v) {
  return "[[shapes]]\ntype = \"rectangle\"\ncorner = " + corner +
         "\nedge_u = " + edge_u + "\nedge_v = " + edge_v +
         "\nmaterial = \"lamp\"\n";
}

RenderSettings bounces(int max_bounces) {
  RenderSettings settings;
  settings.max_bounces = max_bounces;
  return settings;
}

const Ray down{{0, 0.005f, 0}, {0, -1, 0}};

/// What a rectangle a x b, parallel to the floor at height h, fills of the
/// cosine-weighted hemisphere over the point below its corner (Howell, B-3).
double form_factor(double a, double b, double h) {
  const double x = a / h, y = b / h;
  const double big_x = std::sqrt(1 + x * x), big_y = std::sqrt(1 + y * y);
  return (x / big_x * std::atan(y / big_x) +
          y / big_y * std::atan(x / big_y)) /
         (2 * std::acos(-1.0));
}

}  // namespace

// One plane, far from the origin, without shadows, which does not see itself:
// each point has its direct light and no more, however many bounces are
// allowed.
TEST_CASE("a lit wall has no dark spots where it shades itself") {
  Scene scene =
      scene_text(materials + plane("[0.48, 0.6, 0.64]", "1000", "floor"));
  const Vec3 normal(0.48f, 0.6f, 0.64f);
  const Vec3 center = -900.0f * normal;
  scene.add(PointLight{center, Vec3(1e4f)});
  scene.prepare();
  const PathTracer tracer(scene, bounces(8));
  Random random(1, 0, 0);
  for (int i = 0; i < 10'000; ++i) {
    const Vec2 u(random.uniform_2d());
    const Vec3 aside = 500 * (u.x - 0.5f) * Vec3(0.8f, -0.64f, 0) +
                       500 * (u.y - 0.5f) * Vec3(0, -0.64f, 0.6f);
    const Vec3 origin = -950.0f * normal + aside;
    const float squared = 100 * 100 + dot(aside, aside);
    const float expected =
        0.5f / pi * 1e4f * 100 / (squared * std::sqrt(squared));
    require_value("kd/pi I cos/d^2 of a wall that nothing shades, at " +
                      text_of(-1000.0f * normal + aside),
                  red(tracer.radiance({origin, -normal}, random)),
                  static_cast<double>(expected), 1e-3);
  }
}

TEST_CASE("a plate a hundredth over the floor shades it") {
  const Scene scene = scene_text(
      materials + plane("[0, 1, 0]", "0", "floor") +
      plane("[0, -1, 0]", "0.01", "black") + point_light("[0, 2, 0]"));
  Random random(1, 0, 0);
  check_color("a floor a hundredth under a plate",
              PathTracer(scene, bounces(4)).radiance(down, random), Vec3(0));
}

// The same at the other end of the shadow ray. A black shell around a ball
// that shines hides all of it.
TEST_CASE("a plate just before a lamp hides it") {
  const std::string ball =
      "[[shapes]]\ntype = \"sphere\"\ncenter = [0, 3, 0]\nradius = ";
  for (const std::string& lamp :
       {rectangle("[-1, 2, -1]", "[2, 0, 0]", "[0, 0, 2]") +
            plane("[0, -1, 0]", "1.999", "black"),
        ball + "1\nmaterial = \"lamp\"\n" + ball +
            "1.001\nmaterial = \"black\"\n"}) {
    const Scene scene =
        scene_text(materials + plane("[0, 1, 0]", "0", "floor") + lamp);
    const PathTracer tracer(scene, bounces(1));
    for (std::uint64_t i = 0; i < 100; ++i) {
      Random random(1, 0, i);
      require_color("a floor under the hidden lamp\n" + lamp,
                    tracer.radiance(down, random), Vec3(0));
    }
  }
}

// No ray can hit a point, but the shadow ray hits the ceiling there, a little
// before or behind the light, depending on rounding.
TEST_CASE("a point light in a ceiling is not shaded by it") {
  const Vec3 normal(0.48f, 0.6f, 0.64f);
  Scene scene =
      scene_text(materials + plane("[0.48, 0.6, 0.64]", "1000", "floor") +
                 plane("[-0.48, -0.6, -0.64]", "-999", "black"));
  scene.add(PointLight{-999.0f * normal, Vec3(1)});
  scene.prepare();
  const PathTracer tracer(scene, bounces(1));
  Random random(1, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 u(random.uniform_2d());
    const Vec3 aside = (u.x - 0.5f) * Vec3(0.8f, -0.64f, 0) +
                       (u.y - 0.5f) * Vec3(0, -0.64f, 0.6f);
    const Vec3 origin = -999.5f * normal + aside;
    INFO("at ", -1000.0f * normal + aside,
         ": the light hangs in the ceiling, and the ceiling shades it");
    REQUIRE(tracer.radiance({origin, -normal}, random).x > 0);
  }
}

// A ball is its own wall. A ray that leaves it inwards meets the far side.
TEST_CASE("no light from outside gets into a ball") {
  const Scene scene = scene_text(
      materials +
      std::string("[[shapes]]\ntype = \"sphere\"\ncenter = [0, 0, 0]\n"
                  "radius = 1\nmaterial = \"floor\"\n") +
      point_light("[0, 3, 0]") +
      rectangle("[-1, 2, -1]", "[2, 0, 0]", "[0, 0, 2]"));
  const PathTracer tracer(scene, bounces(3));
  for (std::uint64_t i = 0; i < 100; ++i) {
    Random random(1, 0, i);
    require_color("the inside of a ball, with all lights outside",
                  tracer.radiance({{0, 0.5f, 0}, {0.6f, -0.8f, 0}}, random),
                  Vec3(0));
  }
}

// From above the wall is lit, from below it is not; its own normal does not
// matter. The light is 2 away: kd/pi I / 4.
TEST_CASE("a thin wall is lit on the side that it is seen from") {
  for (const std::string normal : {"[0, 1, 0]", "[0, -1, 0]"}) {
    INFO("the wall's normal is ", normal);
    const Scene scene = scene_text(materials + plane(normal, "0", "floor") +
                                   point_light("[0, 2, 0]"));
    const PathTracer tracer(scene, bounces(1));
    Random random(1, 0, 0);
    check_value("kd/pi I/d^2, seen from the side of the light",
                red(tracer.radiance(down, random)),
                0.5 / std::acos(-1.0) * 9 / 4);
    check_color("a wall with the light behind it",
                tracer.radiance({{0, -1, 0}, {0, 1, 0}}, random), Vec3(0));
  }
}

// The same for lamps with an area, which the thin wall hides.
TEST_CASE("a thin wall does not glow in the light of a lamp behind it") {
  for (const std::string& lamp :
       {rectangle("[-1, 2, -1]", "[2, 0, 0]", "[0, 0, 2]"),
        std::string("[[shapes]]\ntype = \"sphere\"\ncenter = [0, 2, 0]\n"
                    "radius = 1\nmaterial = \"lamp\"\n")}) {
    const Scene scene =
        scene_text(materials + plane("[0, 1, 0]", "0", "floor") + lamp);
    const PathTracer tracer(scene, bounces(1));
    for (std::uint64_t i = 0; i < 100; ++i) {
      Random random(1, 0, i);
      require_color("a wall with this lamp behind it\n" + lamp,
                    tracer.radiance({{0, -1, 0}, {0, 1, 0}}, random),
                    Vec3(0));
    }
    INFO("a wall under this lamp is black\n", lamp);
    CHECK(estimate(tracer, down, 100).mean[0] > 0);
  }
}

// The lamp stands upright, half of it below the floor's horizon. That half
// neither adds nor subtracts light.
TEST_CASE("a lamp half below the horizon gives what its upper half gives") {
  const auto lit_by = [](const std::string& lamp) {
    const Scene scene =
        scene_text(materials + plane("[0, 1, 0]", "0", "floor") + lamp);
    return estimate(PathTracer(scene, bounces(1)), down, 50'000);
  };
  const Pixel whole =
      lit_by(rectangle("[1, -1, -1]", "[0, 0, 2]", "[0, 2, 0]"));
  const Pixel upper =
      lit_by(rectangle("[1, 0, -1]", "[0, 0, 2]", "[0, 1, 0]"));
  INFO("the whole lamp gives ", whole.mean[0], " and its upper half ",
       upper.mean[0], ", expected the same");
  CHECK(upper.mean[0] > 0.01);
  CHECK(std::abs(whole.mean[0] - upper.mean[0]) <
        4.4 * std::sqrt((whole.variance(0) + upper.variance(0)) / 50'000));
}

// Four lamps that touch over the point, each seen from its corner.
TEST_CASE("a lamp of four parts: kd ke 4 F, each part counted once") {
  const Scene scene = scene_text(
      materials + plane("[0, 1, 0]", "0", "floor") +
      rectangle("[0, 0.8, 0]", "[1.5, 0, 0]", "[0, 0, 0.7]") +
      rectangle("[-1.5, 0.8, 0]", "[1.5, 0, 0]", "[0, 0, 0.7]") +
      rectangle("[0, 0.8, -0.7]", "[1.5, 0, 0]", "[0, 0, 0.7]") +
      rectangle("[-1.5, 0.8, -0.7]", "[1.5, 0, 0]", "[0, 0, 0.7]"));
  const Pixel pixel = estimate(PathTracer(scene, bounces(1)), down, 100'000);
  const double truth = 0.5 * 4 * 4 * form_factor(1.5, 0.7, 0.8);
  check_mean("kd ke 4 F", pixel, 0, truth);
}

// Triangles cannot be sampled, so their light counts when a path hits them.
TEST_CASE("a lamp of two triangles gives what its rectangle gives") {
  const Scene scene = scene_text(
      materials + plane("[0, 1, 0]", "0", "floor") +
      "[[shapes]]\ntype = \"triangle\"\nmaterial = \"lamp\"\n"
      "vertices = [[0, 0.8, 0], [1.5, 0.8, 0], [1.5, 0.8, 0.7]]\n"
      "[[shapes]]\ntype = \"triangle\"\nmaterial = \"lamp\"\n"
      "vertices = [[0, 0.8, 0], [1.5, 0.8, 0.7], [0, 0.8, 0.7]]\n");
  const Pixel pixel = estimate(PathTracer(scene, bounces(1)), down, 100'000);
  const double truth = 0.5 * 4 * form_factor(1.5, 0.7, 0.8);
  check_mean("kd ke F", pixel, 0, truth);
}

// The contribution of a lamp's point depends on where it lies, so a hundred
// samples are a hundred numbers, except for a few that rounding makes equal.
TEST_CASE("each sample chooses another point of the lamp") {
  for (const std::string& lamp :
       {rectangle("[0, 0.8, 0]", "[1.5, 0, 0]", "[0, 0, 0.7]"),
        std::string("[[shapes]]\ntype = \"sphere\"\ncenter = [1, 2, 0]\n"
                    "radius = 1\nmaterial = \"lamp\"\n")}) {
    const Scene scene =
        scene_text(materials + plane("[0, 1, 0]", "0", "floor") + lamp);
    const PathTracer tracer(scene, bounces(1));
    std::set<float> values;
    std::size_t lit = 0;  // points on the far side bring nothing
    for (std::uint64_t i = 0; i < 100; ++i) {
      Random random(1, 0, i);
      const float value = tracer.radiance(down, random).x;
      if (value == 0) continue;
      values.insert(value);
      ++lit;
    }
    INFO(lit, " of 100 samples brought light, with ", values.size(),
         " different values, expected as many; the lamp is\n", lamp);
    CHECK(lit > 20);
    CHECK(values.size() * 10 > lit * 9);
  }
}

TEST_SUITE_END();
