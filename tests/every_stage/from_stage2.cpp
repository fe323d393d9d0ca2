// What every path tracer that samples the lights must do.

#include "stage.hpp"
#include "support/bounce_bounds.hpp"
#include "support/first_things.hpp"
#include "support/gathered_light.hpp"
#include "support/half_hidden_lamp.hpp"
#include "support/lamps_and_glass.hpp"
#include "support/unlike_lights.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

TEST_SUITE_BEGIN("units");

TEST_CASE("a ray that leaves the scene does not lose radiance found so far") {
  check_light_is_kept_on_leaving<PathTracer>();
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("analytic scenes");

TEST_CASE(
    "radiance found so far survives an emitter that cannot be sampled") {
  check_kept_at_an_emitter<PathTracer>();
}

TEST_CASE("radiance found so far survives a lamp that has been sampled") {
  check_kept_at_a_counted_lamp<PathTracer>();
}

TEST_CASE("radiance found so far survives a black throughput") {
  check_kept_at_black_throughput<PathTracer>();
}

TEST_CASE("radiance found so far survives a path that leaves the scene") {
  check_kept_when_a_path_leaves<PathTracer>();
  if constexpr (this_stage >= 3) check_kept_when_a_lobe_leaves<PathTracer>();
}

TEST_CASE("a lamp that was sampled but hidden does not count when hit") {
  check_half_hidden_lamp<PathTracer>();
}

TEST_CASE("a lamp blocks the light of the lights behind it") {
  check_lamps_block_light<PathTracer>();
}

TEST_CASE("each of a hundred lights adds its light") {
  check_many_lights<PathTracer>();
}

TEST_CASE("two unlike lights of each type give the sum of both") {
  check_unlike_lights<PathTracer>();
}

TEST_CASE("a light that brings nothing does not affect the lights after it") {
  check_useless_lights<PathTracer>();
}

TEST_CASE("at most N bounces: N terms of the light of a point") {
  check_bound_under_a_point_light<PathTracer>(0);
  if constexpr (this_stage >= 3) {
    check_bound_under_a_point_light<PathTracer>(0.4);
  }
}

TEST_CASE("the camera sees a lamp from the front, and black from behind") {
  check_lamp_as_the_camera_sees_it<PathTracer>();
}

TEST_SUITE_END();
