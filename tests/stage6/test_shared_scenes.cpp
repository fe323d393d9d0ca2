// Scenes that every stage shows alike, as far as it can render them.

#include <doctest/doctest.h>

#include "stages/6_many_paths/path_tracer.hpp"
#include "support/bounce_bounds.hpp"
#include "support/bright_and_dim.hpp"
#include "support/covered_sky.hpp"
#include "support/gathered_light.hpp"
#include "support/half_hidden_lamp.hpp"
#include "support/lamps_and_glass.hpp"
#include "support/lights_by_lobe.hpp"
#include "support/unlike_lights.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage6::PathTracer;

TEST_SUITE_BEGIN("analytic scenes");

TEST_CASE("what was gathered is kept at an emitter that cannot be asked") {
  check_kept_at_an_emitter<PathTracer>();
}

TEST_CASE("what was gathered is kept at a lamp that has been asked") {
  check_kept_at_a_counted_lamp<PathTracer>();
}

TEST_CASE("what was gathered is kept when the throughput is black") {
  check_kept_when_all_goes_black<PathTracer>();
}

TEST_CASE("what was gathered is kept when a path leaves the scene") {
  check_kept_when_a_path_leaves<PathTracer>();
  check_kept_when_a_lobe_leaves<PathTracer>();
}

TEST_CASE(
    "lights are asked by the lobe: plastic shows the lamp that it mirrors") {
  check_plastic_shows_its_lamp<PathTracer>();
}

TEST_CASE(
    "lights are asked by the lobe: milk glass shows the lamp behind it") {
  check_milk_glass_shows_its_lamp<PathTracer>();
}

TEST_CASE("a point light lights the diffuse lobe alone") {
  check_point_light_lights_one_lobe<PathTracer>();
}

TEST_CASE("a lamp that was asked and hidden does not count when found") {
  check_half_hidden_lamp<PathTracer>();
}

TEST_CASE("two unlike lights of each type give what each of them gives") {
  check_unlike_lights<PathTracer>();
}

TEST_CASE("a light that brings nothing takes nothing from those after it") {
  check_useless_lights<PathTracer>();
}

TEST_CASE("at most N bounces: N terms of the light of a lamp") {
  check_bound_under_a_lamp<PathTracer>();
}

TEST_CASE("at most N bounces: N terms of the light of a point") {
  check_bound_under_a_point_light<PathTracer>(0);
  check_bound_under_a_point_light<PathTracer>(0.4);
}

TEST_CASE("at most N bounces: a mirror is one, and a glass ball is two") {
  check_bound_between_mirrors<PathTracer>();
  check_bound_through_glass<PathTracer>();
}

TEST_CASE("each direction has its own weight, however directions are drawn") {
  check_covered_sky<PathTracer>("{ kd = 0.5 }", DoubleVec3(0.5), 0.5);
  check_covered_sky<PathTracer>(
      "{ kd = [0.3, 0.6, 0.1], ks = [0.2, 0.1, 0.6] }",
      DoubleVec3(0.3, 0.6, 0.1));
}

TEST_CASE("bright samples are not clamped, and dim ones not cut off") {
  check_bright_and_dim_sky<PathTracer>();
  check_bright_and_dim_lamps<PathTracer>();
  check_bright_and_dim_in_mirrors_and_glass<PathTracer>();
}

TEST_CASE("paths that seem to be worth little are followed to their end") {
  check_lamp_in_diamond<PathTracer>();
  check_many_bounces_on_plastic<PathTracer>(10);
  check_many_bounces_on_plastic<PathTracer>(bounce_cap);
}

TEST_CASE("the camera sees a lamp from the front, and black behind it") {
  check_lamp_as_the_camera_sees_it<PathTracer>();
}

TEST_CASE("the back of an emitter lights nothing") {
  check_back_of_a_lamp_is_black<PathTracer>();
}

TEST_CASE("each lobe has its own color and its own weight") {
  check_colored_lobes<PathTracer>();
}

TEST_CASE("a room seen from inside glass is eta^2 times as bright") {
  check_room_seen_from_inside_glass<PathTracer>();
}

TEST_CASE("glass casts a shadow in the light of a point") {
  check_glass_casts_a_shadow<PathTracer>();
}

TEST_CASE("a lamp in a mirror lights the floor") {
  check_lamp_in_a_mirror_lights_the_floor<PathTracer>();
}

TEST_CASE("a path that glass never lets out ends") {
  check_endless_path_ends<PathTracer>();
}

TEST_CASE("a path on a dark wall is over soon") {
  check_path_on_a_dark_wall_is_short<PathTracer>();
}

TEST_SUITE_END();
