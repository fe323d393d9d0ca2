// The steps of stage 2 by themselves, without the loop that joins them.

#include <doctest/doctest.h>

#include <string>

#include "stages/2_next_event/path_tracer.hpp"
#include "support/expectations.hpp"
#include "support/renders.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

TEST_SUITE_BEGIN("analytic scenes");

namespace {

constexpr const char* floor_and_light = R"(
[materials]
floor = { kd = [0.5, 0.25, 1] }
[[shapes]]
type = "plane"
normal = [0, 1, 0]
distance = 0
material = "floor"
[[lights]]
type = "point"
intensity = [1, 2, 3]
)";

constexpr const char* plate = R"(
[[shapes]]
type = "sphere"
center = [0, 1, 0]
radius = 0.25
material = "floor"
)";

/// What `direct_light` adds at the origin, with the light at `center`, in
/// `samples` samples.
Pixel asked_often(const std::string& center, const std::string& more,
                  int samples) {
  const Scene scene =
      scene_text(floor_and_light + ("center = " + center + "\n") + more);
  const Vec3 down(0, -1, 0);
  const std::optional<Hit> hit = scene.nearest_hit({{0, 0.1f, 0}, down});
  REQUIRE(hit.has_value());
  Random random(3, 1, 4);
  Pixel pixel;
  for (int i = 0; i < samples; ++i) {
    pixel.add(
        stage2::direct_light(scene, {*hit, *hit->material, -down}, random));
  }
  return pixel;
}

/// The same of one sample: with one point light nothing is random.
Vec3 asked(const std::string& center, const std::string& more = "") {
  const Pixel pixel = asked_often(center, more, 1);
  return Vec3(pixel.mean[0], pixel.mean[1], pixel.mean[2]);
}

/// Whether an emission that a path hits straight ahead was counted already.
bool counted(const std::string& shape, bool direct_light_added) {
  const Scene scene =
      scene_text("[materials]\nlamp = { ke = 1 }\n[[shapes]]\n" + shape +
                 "\nmaterial = \"lamp\"\n");
  const Vec3 ahead(0, 0, 1);
  const std::optional<Hit> hit = scene.nearest_hit({Vec3(0), ahead});
  REQUIRE(hit.has_value());
  return stage2::already_counted({*hit, *hit->material, -ahead},
                                 direct_light_added);
}

constexpr const char* ball =
    "type = \"sphere\"\ncenter = [0, 0, 5]\nradius = 1";
constexpr const char* window =
    "type = \"rectangle\"\ncorner = [-1, -1, 5]\nedge_u = [0, 2, 0]\n"
    "edge_v = [2, 0, 0]";
constexpr const char* wall =
    "type = \"plane\"\nnormal = [0, 0, -1]\ndistance = 5";

}  // namespace

// On average: a program may draw one of the lights for each sample.
TEST_CASE("direct light is the sum over all lights, and 0 without any") {
  const std::string other =
      "[[lights]]\ntype = \"point\"\nintensity = [4, 0, 1]\n"
      "center = [0, 1, 0]\n";
  const Vec3 product(0.5f * 4, 0, 1.0f * 1);
  const Vec3 expected = asked("[0, 2, 0]") + product / pi;
  const Pixel both = asked_often("[0, 2, 0]", other, 20'000);
  for (int channel = 0; channel < 3; ++channel) {
    check_mean("two lights: the sum of what each brings", both, channel,
               expected[channel], 1e-4);
  }
  const Scene dark = scene_text(
      "[materials]\nfloor = { kd = 0.5 }\n[[shapes]]\ntype = \"plane\"\n"
      "normal = [0, 1, 0]\ndistance = 0\nmaterial = \"floor\"\n");
  const Vec3 down(0, -1, 0);
  const std::optional<Hit> hit = dark.nearest_hit({{0, 0.1f, 0}, down});
  REQUIRE(hit.has_value());
  Random random(3, 1, 4);
  check_color(
      "a scene without lights",
      stage2::direct_light(dark, {*hit, *hit->material, -down}, random),
      Vec3(0));
}

// At (0, 2, 0) the cosine is 1 and d^2 is 4; at (3, 4, 0) it is 4/5 and 25.
TEST_CASE("direct light is kd/pi I cos/d^2 where the light is seen") {
  const Vec3 product(0.5f * 1, 0.25f * 2, 1.0f * 3);
  check_color("kd/pi I cos/d^2 of a light above", asked("[0, 2, 0]"),
              product / (4 * pi));
  check_color("kd/pi I cos/d^2 of a light aside", asked("[3, 4, 0]"),
              product * (0.8f / (25 * pi)));
}

TEST_CASE("direct light is 0 where the light is hidden or below") {
  check_color("direct light with a ball in the way",
              asked("[0, 2, 0]", plate), Vec3(0));
  check_color("direct light of a light below the floor", asked("[0, -2, 0]"),
              Vec3(0));
  const Vec3 product(0.5f * 1, 0.25f * 2, 1.0f * 3);
  check_color("direct light with a ball behind the light",
              asked("[0, 0.5, 0]", plate), product / (0.25f * pi));
}

TEST_CASE(
    "an emission is already counted if and only if its light was sampled") {
  struct Case {
    const char* shape;
    const char* name;
    bool added, expected;
  };
  for (const Case& one :
       {Case{ball, "sphere", true, true},
        Case{window, "rectangle", true, true},
        Case{wall, "plane", true, false}, Case{ball, "sphere", false, false},
        Case{window, "rectangle", false, false},
        Case{wall, "plane", false, false}}) {
    if (counted(one.shape, one.added) == one.expected) continue;
    FAIL_CHECK("a " << one.name << " is hit, and direct light was "
                    << (one.added ? "added" : "not added")
                    << " at the previous surface: already_counted is "
                    << (one.expected ? "false, expected true"
                                     : "true, expected false"));
  }
}

TEST_SUITE_END();
