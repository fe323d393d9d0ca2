// What every path tracer must do.

#include <algorithm>
#include <string>

#include "stage.hpp"
#include "support/bounce_bounds.hpp"
#include "support/bright_and_dim.hpp"
#include "support/comparisons.hpp"
#include "support/covered_sky.hpp"
#include "support/exact_radiance.hpp"
#include "support/first_things.hpp"
#include "support/goldens.hpp"
#include "support/lamps_and_glass.hpp"
#include "support/moved_scenes.hpp"
#include "support/told_paths.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

TEST_SUITE_BEGIN("units");

TEST_CASE("a ray that meets nothing brings the background") {
  check_nothing_is_black<PathTracer>();
}

TEST_SUITE_END();

// Stage 6 follows paths side by side and logs none of them.
TEST_SUITE_BEGIN("units" * doctest::skip(this_stage == 6));

TEST_CASE("every ray has a direction of unit length") {
  check_unit_directions<PathTracer>("{ kd = 0.5 }");
  if constexpr (this_stage >= 3) {
    check_unit_directions<PathTracer>("{ ks = 0.9 }");
    check_unit_directions<PathTracer>("{ kt = 0.9 }");
    check_unit_directions<PathTracer>("{ kd = 0.3, ks = 0.3, kt = 0.3 }");
  }
  if constexpr (this_stage >= 5) {
    check_unit_directions<PathTracer>("{ ks = 1, kt = 1, fresnel = true }");
  }
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("analytic scenes");

TEST_CASE("the back of an emitter lights nothing") {
  check_back_of_a_lamp_is_black<PathTracer>();
}

TEST_CASE("at most N bounces: N terms of the light of a lamp") {
  check_bound_under_a_lamp<PathTracer>();
}

TEST_CASE("the light of many bounces in each color channel") {
  // Roulette by the mean of the channels, say, ends nearly all long paths.
  check_long_paths_of_some_channels<PathTracer>(this_stage < 4 ? 40 : 2);
}

TEST_CASE("each direction has its own weight, however directions are drawn") {
  const double survival = this_stage >= 4 ? 0.5 : 1;  // of roulette
  check_covered_sky<PathTracer>("{ kd = 0.5 }", DoubleVec3(0.5), survival);
  if constexpr (this_stage >= 3) {
    check_covered_sky<PathTracer>(
        "{ kd = [0.3, 0.6, 0.1], ks = [0.2, 0.1, 0.6] }",
        DoubleVec3(0.3, 0.6, 0.1));
  }
}

TEST_CASE(
    "the light of many bounces on dark floors, in diamond, on plastic") {
  // Roulette ends nearly all paths on so dark a floor.
  if constexpr (this_stage < 4) {
    check_dark_floor_under_a_bright_sky<PathTracer>();
  }
  if constexpr (this_stage >= 3) {
    check_lamp_in_diamond<PathTracer>();
    check_many_bounces_on_plastic<PathTracer>(10);
  }
  if constexpr (this_stage >= 4) {
    check_many_bounces_on_plastic<PathTracer>(bounce_cap);
  }
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("relations");

TEST_CASE("bright samples are not clamped, and dim ones not cut off") {
  check_bright_and_dim_sky<PathTracer>();
  if constexpr (this_stage >= 2) check_bright_and_dim_lamps<PathTracer>();
  if constexpr (this_stage >= 3) {
    check_bright_and_dim_in_mirrors_and_glass<PathTracer>();
  }
}

TEST_CASE(
    "the same bits for any number of threads, new noise for a new seed") {
  const std::string scenes[] = {
      "cornell_box_ceiling_diffuse", "cornell_box_lamp_diffuse",
      "cornell_box_ceiling", "cornell_box_point", "checkered_floor"};
  Scene scene = scene_file(scenes[std::min(this_stage, 5) - 1], 30, 21);
  RenderSettings settings;
  settings.samples_per_pixel = 5;
  if constexpr (this_stage < 4) settings.max_bounces = 8;
  settings.threads = 1;
  const RenderResult one = paint<PathTracer>(scene, settings);
  CHECK_MESSAGE(one.info.dropped == 0, one.info.dropped,
                " samples are infinite or not a number, expected 0");
  for (const int threads : {1, 2, 7}) {
    INFO("the picture with ", threads, " threads, against the one with 1");
    settings.threads = threads;
    const RenderResult again = paint<PathTracer>(scene, settings);
    check_same_bits(again, one);
    CHECK_MESSAGE(again.info.rays == one.info.rays, again.info.rays,
                  " rays, expected ", one.info.rays);
  }
  settings.seed = 2;
  settings.threads = 2;
  check_other_noise(paint<PathTracer>(scene, settings), one);
}

TEST_CASE("the box gives the same picture wherever and however large it is") {
  if constexpr (this_stage == 1) {
    check_moved<PathTracer>("cornell_box_ceiling_diffuse", 128, 8);
  } else if constexpr (this_stage == 2) {
    check_moved<PathTracer>("cornell_box_point_diffuse", 64, 8);
    check_moved<PathTracer>("cornell_box_ceiling_diffuse", 64, 8);
    check_moved<PathTracer>("cornell_box_lamp_diffuse", 64, 8);
  } else {  // the paths of stage 3 branch at each bounce
    const int samples = this_stage == 3 ? 32 : 64;
    const int max_bounces = this_stage == 3 ? 4 : 64;
    check_moved<PathTracer>("cornell_box_point", samples, max_bounces);
    check_moved<PathTracer>("cornell_box_ceiling", samples, max_bounces);
  }
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("relations" * doctest::skip(this_stage == 6));

TEST_CASE("the logged vertices of a path add up to its radiance") {
  check_told_paths<PathTracer>(
      this_stage >= 2 ? text::point_light("0, 0, 0", "3.14159265") : "");
}

TEST_SUITE_END();

// Last of all: a failure of any other test says more.
TEST_SUITE_BEGIN("golden images");

TEST_CASE("golden images: the pictures of the stage") {
  // Stage 6 renders the pictures of stage 5.
  check_goldens<PathTracer>(this_stage == 6 ? 5 : this_stage);
}

TEST_SUITE_END();
