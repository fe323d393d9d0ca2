// Scenes whose radiance can be written down. Most have no noise at all.

#include <doctest/doctest.h>

#include <string>

#include "stages/2_next_event/path_tracer.hpp"
#include "support/exact_radiance.hpp"
#include "support/expectations.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage2::PathTracer;

TEST_SUITE_BEGIN("analytic scenes");

namespace {

RenderSettings bounces(int max_bounces) {
  RenderSettings settings;
  settings.max_bounces = max_bounces;
  return settings;
}

constexpr const char* floor_only = R"(
[materials]
floor = { kd = [0.5, 0.25, 1] }
lamp  = { ke = 4 }
wall  = { kd = 0 }
[[shapes]]
type = "plane"
normal = [0, 1, 0]
distance = 0
material = "floor"
)";

std::string point_light(const std::string& center,
                        const std::string& intensity) {
  return "[[lights]]\ntype = \"point\"\ncenter = " + center +
         "\nintensity = " + intensity + "\n";
}

/// A ray straight down onto (x, 0, 0), from below all lights.
Ray onto(float x) {
  return {{x, 0.005f, 0}, {0, -1, 0}};
}

Vec3 one_sample(const Scene& scene, const Ray& ray, int max_bounces) {
  Random random(3, 1, 4);
  return PathTracer(scene, bounces(max_bounces)).radiance(ray, random);
}

}  // namespace

// Inside a sphere of radius 1 with kd = 1/2, a point light of intensity pi at
// the center gives each point of the wall kd/pi * pi / 1^2 = 1/2, and each
// further bounce half of the previous one: 1/2 + 1/4 + ... = 1 - 2^-N.
TEST_CASE("a light at the center of a sphere: 1 - 2^-N after N bounces") {
  const Scene scene = scene_text(R"(
[materials]
wall = { kd = 0.5 }
[[shapes]]
type = "sphere"
center = [0, 0, 0]
radius = 1
material = "wall"
)" + point_light("[0, 0, 0]", "3.14159265"));
  for (int n = 0; n <= 6; ++n) {
    const Ray ray{{0.2f, 0.1f, -0.3f}, normalize(Vec3(1, 2, 3))};
    check_radiance<PathTracer>("the wall", scene, ray, bounces(n),
                               DoubleVec3(1 - std::exp2(-n)));
  }
}

// Seen from a point at distance r from the point below the light, the light
// is at distance sqrt(h^2 + r^2) and cos = h / sqrt(h^2 + r^2).
TEST_CASE("a point light at height h over a plane: kd/pi I h/(h^2+r^2)^1.5") {
  const Scene scene =
      scene_text(floor_only + point_light("[0, 2, 0]", "[1, 2, 3]"));
  for (const float r : {0.0f, 0.5f, 2.0f, 10.0f}) {
    const Vec3 radiance = one_sample(scene, onto(r), 1);
    const float law = 2 / std::pow(4 + r * r, 1.5f) / pi;
    check_color("kd/pi I cos/d^2 of a light 2 above the floor, " +
                    text_of(static_cast<double>(r)) + " aside",
                radiance, Vec3(0.5f * 1, 0.25f * 2, 1.0f * 3) * law);
  }
}

TEST_CASE("two lights are the sum of each, and two halves are the whole") {
  const auto with = [](const std::string& lights) {
    return one_sample(scene_text(floor_only + lights), onto(0.3f), 1);
  };
  const DoubleVec3 a(with(point_light("[0, 2, 0]", "3")));
  const DoubleVec3 b(with(point_light("[1, 1, 1]", "1")));
  // On average: a program may sample one of two lights and count it twice.
  const auto check = [](const char* what, const std::string& lights,
                        const DoubleVec3& expected) {
    check_radiance<PathTracer>(what, scene_text(floor_only + lights),
                               onto(0.3f), bounces(1), expected);
  };
  check("two lights",
        point_light("[0, 2, 0]", "3") + point_light("[1, 1, 1]", "1"), a + b);
  check("two halves of a light",
        point_light("[0, 2, 0]", "1.5") + point_light("[0, 2, 0]", "1.5"), a);
}

TEST_CASE("a light behind the surface does not shine through it") {
  const Scene scene = scene_text(floor_only + point_light("[0, -1, 0]", "9"));
  check_color("a light below the floor, where cos < 0",
              one_sample(scene, onto(0), 1), Vec3(0));
  check_color("a light below the floor, seen from aside",
              one_sample(scene, onto(2), 1), Vec3(0));
}

TEST_CASE("what lies between casts a shadow, what lies beyond does not") {
  const auto with_wall_at = [](const std::string& height) {
    const Scene scene = scene_text(floor_only +
                                   point_light("[0, 2, 0]", "9") +
                                   R"([[shapes]]
type = "rectangle"
corner = [-1, )" + height + R"(, -1]
edge_u = [2, 0, 0]
edge_v = [0, 0, 2]
material = "wall"
)");
    return red(one_sample(scene, onto(0), 1));
  };
  const double unshadowed = 0.5 / std::acos(-1.0) * 9 / 4;
  check_value("a light at 2 behind a wall at 1", with_wall_at("1"), 0);
  check_value("a light at 2 behind a wall at 1.999", with_wall_at("1.999"),
              0);
  check_value("kd/pi I/d^2 of a light at 2 before a wall at 2.001",
              with_wall_at("2.001"), unshadowed);
  check_value("kd/pi I/d^2 of a light at 2 before a wall at 3",
              with_wall_at("3"), unshadowed);
}

// The share of the cosine-weighted hemisphere that a parallel rectangle a x b
// fills, seen from below one corner at distance h, with x = a/h and y = b/h:
// F = (x/X atan(y/X) + y/Y atan(x/Y)) / 2 pi, X^2 = 1 + x^2, Y^2 = 1 + y^2
// (Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-3).
TEST_CASE("a rectangle parallel to the floor: kd ke F, F in closed form") {
  const double a = 1.5, b = 0.7, h = 0.8, x = a / h, y = b / h;
  const double big_x = std::sqrt(1 + x * x), big_y = std::sqrt(1 + y * y);
  const double form_factor =
      (x / big_x * std::atan(y / big_x) + y / big_y * std::atan(x / big_y)) /
      (2 * std::acos(-1.0));
  const Scene scene = scene_text(std::string(floor_only) + R"([[shapes]]
type = "rectangle"
corner = [0, 0.8, 0]
edge_u = [1.5, 0, 0]
edge_v = [0, 0, 0.7]
material = "lamp"
)");
  const PathTracer tracer(scene, bounces(1));
  const Pixel pixel = estimate(tracer, onto(0), 100'000);
  check_mean("kd ke F, whose weight is ke A cos'/d^2", pixel, 0,
             0.5 * 4 * form_factor);
}

TEST_CASE("a rectangle that faces away gives nothing") {
  const Scene scene = scene_text(std::string(floor_only) + R"([[shapes]]
type = "rectangle"
corner = [-1, 1, -1]
edge_u = [0, 0, 2]
edge_v = [2, 0, 0]
material = "lamp"
)");
  check_color("the light of a lamp from behind, where cos' < 0",
              one_sample(scene, onto(0), 1), Vec3(0));
}

// A sphere wholly above the horizon fills F = cos (r/d)^2.
TEST_CASE("a sphere above the floor: kd ke cos (r/d)^2, near and far") {
  struct Case {
    std::string center;
    float radius;
    double form_factor;
  };
  const Case cases[] = {
      {"[0, 2, 0]", 1.0f, 0.25},
      {"[0, 1.01, 0]", 1.0f, 1 / 1.0201},
      {"[3, 4, 0]", 2.0f, 0.8 * 4 / 25},
      {"[0, 10000, 0]", 1.0f, 1e-8},
  };
  for (const Case& one : cases) {
    const Scene scene =
        scene_text(std::string(floor_only) +
                   "[[shapes]]\ntype = \"sphere\"\ncenter = " + one.center +
                   "\nradius = " + std::to_string(one.radius) +
                   "\nmaterial = \"lamp\"\n");
    const PathTracer tracer(scene, bounces(1));
    const Pixel pixel = estimate(tracer, onto(0), 100'000);
    const double truth = 0.5 * 4 * one.form_factor;
    // Far away all directions are the same, and only rounding is left.
    check_mean("kd ke cos (r/d)^2 of a ball at " + one.center, pixel, 0,
               truth, 1e-4);
  }
}

// As for stage 1: the lamp fills F = 1/4, and L = kd ke F (1 + q + q^2 + ...).
// Here direct light has no noise at all: the lamp is seen under one angle.
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
  const double kd = 0.8, form_factor = 0.25, q = kd * (1 - form_factor);
  double expected = 0, term = kd * 3 * form_factor;
  for (const int max_bounces : {1, 2, 3, 4}) {
    expected += term;
    term *= q;
    const Pixel pixel = estimate(PathTracer(scene, bounces(max_bounces)),
                                 {{0.6f, 0, 0}, {1, 0, 0}}, 40'000);
    check_mean("kd ke F (1 + q + ...), " + bounces_in_words(max_bounces),
               pixel, 0, expected);
  }
}

TEST_CASE("the camera sees lamps as bright as they are") {
  for (const std::string shape :
       {"type = \"sphere\"\ncenter = [0, 3, 0]\nradius = 1",
        "type = \"rectangle\"\ncorner = [-1, 3, -1]\n"
        "edge_u = [2, 0, 0]\nedge_v = [0, 0, 2]",
        "type = \"triangle\"\nvertices = [[-1, 3, -1], "
        "[1, 3, -1], [0, 3, 2]]",
        "type = \"plane\"\nnormal = [0, -1, 0]\n"
        "distance = 3"}) {
    const std::string what = "ke of a lamp with\n" + shape + "\nseen with ";
    const Scene scene = scene_text(std::string(floor_only) + "[[shapes]]\n" +
                                   shape + "\nmaterial = \"lamp\"\n");
    const Ray up{{0, 0.5f, 0}, {0, 1, 0}};
    check_color(what + "max_bounces 0", one_sample(scene, up, 0), Vec3(4));
    check_color(what + "max_bounces 5", one_sample(scene, up, 5), Vec3(4));
  }
}

// Stage 2 cannot sample a plane, so its paths must hit it, as in stage 1.
TEST_CASE("a floor under an emitting plane is kd ke") {
  const Scene scene = scene_text(std::string(floor_only) + R"([[shapes]]
type = "plane"
normal = [0, -1, 0]
distance = 1
material = "lamp"
)");
  check_radiance<PathTracer>("the floor", scene, onto(0), bounces(1),
                             DoubleVec3(2, 1, 4));
  check_color("a floor with max_bounces 0", one_sample(scene, onto(0), 0),
              Vec3(0));
}

TEST_CASE("inside a lamp that shines outwards it is dark") {
  const Scene scene = scene_text(std::string(floor_only) + R"([[shapes]]
type = "sphere"
center = [0, 0, 0]
radius = 1
material = "lamp"
)");
  check_color("the floor inside a lamp", one_sample(scene, onto(0), 3),
              Vec3(0));
}

TEST_SUITE_END();
