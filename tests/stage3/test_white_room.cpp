// In a room that is equally bright in all directions, what loses no light is
// invisible.

#include <doctest/doctest.h>

#include "stages/3_specular_refraction/path_tracer.hpp"
#include "support/each_or_mean.hpp"
#include "support/exact_radiance.hpp"
#include "support/expectations.hpp"
#include "support/specular_scenes.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage3::PathTracer;

TEST_SUITE_BEGIN("analytic scenes");

namespace {

RenderSettings bounces(int max_bounces) {
  RenderSettings settings;
  settings.max_bounces = max_bounces;
  return settings;
}

/// Every ray at the thing must bring `expected`, or at least all on average.
void check_all_rays(const Scene& scene, int max_bounces, double expected) {
  const PathTracer tracer(scene, bounces(max_bounces));
  EachOrMean all(expected, 1e-5);
  std::string first;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    Random random(8, 0, i);
    const Ray ray = ray_at_thing(random);
    const float radiance = tracer.radiance(ray, random).x;
    all.add(radiance);
    if (first.empty() && !(std::abs(red(Vec3(radiance)) - expected) < 1e-4)) {
      first = ", the first from " + text_of(ray.origin) + " along " +
              text_of(ray.direction);
    }
  }
  all.check("20000 rays at the thing" + first);
}

}  // namespace

TEST_CASE("a perfect mirror ball in a white room is invisible") {
  check_all_rays(in_white_room("{ ks = 1 }", ball("thing")), 8, 1);
}

TEST_CASE("a mirror with ks = 0.7 shows 0.7 of the room") {
  check_all_rays(in_white_room("{ ks = 0.7 }", ball("thing")), 8, 0.7);
}

// In and out: the factors (1/1.5)^2 and 1.5^2 cancel.
TEST_CASE("a glass ball in a white room is invisible") {
  check_all_rays(in_white_room("{ kt = 1 }", ball("thing")), 8, 1);
}

// Two refractions, each kt.
TEST_CASE("a glass ball with kt = 0.9 shows 0.81 of the room") {
  check_all_rays(in_white_room("{ kt = 0.9 }", ball("thing")), 8, 0.81);
}

// A ray that has entered a cube through one face usually hits another one
// beyond the critical angle, and is reflected until it finds a way out. Some
// never do: those that are still inside after 60 bounces are left out.
TEST_CASE("a glass cube in a white room is invisible") {
  const Scene scene = in_white_room("{ kt = 1 }", cube("thing"));
  const PathTracer tracer(scene, bounces(60));
  int seen = 0;
  EachOrMean all(1, 1e-4), not_kept(1, 1e-4);
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    Random random(8, 0, i);
    const Ray ray = ray_at_thing(random);
    const float radiance = tracer.radiance(ray, random).x;
    all.add(radiance);
    if (radiance == 0) continue;  // still inside
    ++seen;
    not_kept.add(radiance);
  }
  INFO(seen, " of 20000 rays find out of the cube, expected over 10000");
  CHECK(seen > 1000);
  // With roulette paths may end early, and others count more.
  (not_kept.wrong().empty() ? not_kept : all).check("rays at the cube");
}

// A radiance of 1 outside is 1.5^2 inside.
TEST_CASE("seen from inside glass the room has radiance 2.25") {
  const Scene scene = in_white_room("{ kt = 1 }", ball("thing"));
  const PathTracer tracer(scene, bounces(8));
  Random random(1, 0, 0);
  for (const Vec3 direction :
       {Vec3(0, 0, 1), Vec3(1, 0, 0), normalize(Vec3(1, -2, 3))}) {
    check_value("a room of radiance 1 seen from inside glass, eta^2",
                static_cast<double>(
                    tracer.radiance({{0.1f, 0.2f, 0}, direction}, random).y),
                2.25);
  }
}

// Beyond the critical angle, in a glass ball, the ray is reflected forever.
TEST_CASE(
    "a path that is totally reflected forever brings nothing, and ends") {
  const Scene scene = in_white_room("{ kt = 1 }", ball("thing"));
  const PathTracer tracer(scene, bounces(64));
  Random random(1, 0, 0);
  const Ray grazing{{0.99f, 0, 0}, normalize(Vec3(0.01f, 1, 0))};
  check_color("a ray that glass never lets out",
              tracer.radiance(grazing, random), Vec3(0));
}

TEST_CASE("a colored mirror colors what it shows") {
  const Scene scene =
      in_white_room("{ ks = [0.9, 0.5, 0.1] }", ball("thing"));
  check_radiance<PathTracer>("the mirror", scene, {{0, 0, -5}, {0, 0, 1}},
                             bounces(8), DoubleVec3(0.9, 0.5, 0.1));
}

// Through the middle of the ball: two refractions, each kt.
TEST_CASE("colored glass colors what is seen through it") {
  const Scene scene =
      in_white_room("{ kt = [0.9, 0.5, 0.1] }", ball("thing"));
  check_radiance<PathTracer>("the glass", scene, {{0, 0, -5}, {0, 0, 1}},
                             bounces(8), DoubleVec3(0.81, 0.25, 0.01));
}

TEST_CASE("a lobe of one color is followed") {
  for (const char* material :
       {"{ ks = [0.9, 0, 0] }", "{ ks = [0.5, 0, 0], kd = [0.4, 0, 0] }"}) {
    const Scene scene = in_white_room(material, ball("thing"));
    check_radiance<PathTracer>(material, scene, {{0, 0, -5}, {0, 0, 1}},
                               bounces(1), DoubleVec3(0.9, 0, 0));
  }
}

// Water and diamond: 1.33^2 and 2.42^2 inside, and nothing outside.
TEST_CASE("each material has its own eta") {
  for (const auto& one :
       {std::pair("1.33", 1.7689), std::pair("2.42", 5.8564)}) {
    const std::string eta = one.first;
    const double inside = one.second;
    const Scene scene =
        in_white_room("{ kt = 1, eta = " + eta + " }", ball("thing"));
    const PathTracer tracer(scene, bounces(1));
    Random random(1, 0, 0);
    check_value(
        "a white room seen from inside a material of eta " + eta + ", eta^2",
        red(tracer.radiance({{0.1f, 0, 0}, {0, 0, 1}}, random)), inside);
    check_all_rays(scene, 8, 1);
  }
}

// Between two mirrors a path has no end. Each ray but the first follows a
// bounce, so there are 65 at most, whatever max_bounces is.
TEST_CASE("a path never makes more than 64 bounces") {
  const Scene scene = scene_text(
      "[materials]\nmirror = { ks = 1 }\n[[shapes]]\ntype = \"plane\"\n"
      "normal = [0, 0, 1]\ndistance = 1\nmaterial = \"mirror\"\n"
      "[[shapes]]\ntype = \"plane\"\nnormal = [0, 0, -1]\ndistance = 1\n"
      "material = \"mirror\"\n");
  Random random(1, 0, 0);
  const std::uint64_t before = rays_cast;
  PathTracer(scene, {}).radiance({{0, 0, 0}, {0, 0, 1}}, random);
  check_value("rays between two mirrors without a bound, 1 + 64 bounces",
              static_cast<double>(rays_cast - before), 65);
}

// After 1 bounce the diffuse and the mirrored ray have reached the room, which
// brings kd + ks; the refracted one is still inside the ball.
TEST_CASE("all lobes of a mixed material are followed") {
  const Scene scene =
      in_white_room("{ kd = 0.3, ks = 0.4, kt = 0.2 }", ball("thing"));
  check_all_rays(scene, 1, 0.3 + 0.4);
}

TEST_CASE("a mirror bounce counts as a bounce") {
  const Scene scene = in_white_room("{ ks = 1 }", ball("thing"));
  Random random(1, 0, 0);
  const Ray ray{{0, 0, -5}, {0, 0, 1}};
  check_color("a mirror with max_bounces 0",
              PathTracer(scene, bounces(0)).radiance(ray, random), Vec3(0));
  check_color("a mirror in a white room with max_bounces 1",
              PathTracer(scene, bounces(1)).radiance(ray, random), Vec3(1));
}

TEST_SUITE_END();
