// What every path tracer with mirrors and glass must do.

#include "stage.hpp"
#include "support/bounce_bounds.hpp"
#include "support/lamps_and_glass.hpp"
#include "support/lights_by_lobe.hpp"
#include "support/thin_gaps.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

TEST_SUITE_BEGIN("analytic scenes");

TEST_CASE(
    "lights are sampled per lobe: plastic shows the lamp that it mirrors") {
  check_plastic_shows_its_lamp<PathTracer>();
}

TEST_CASE(
    "lights are sampled per lobe: milk glass shows the lamp behind it") {
  check_milk_glass_shows_its_lamp<PathTracer>();
}

TEST_CASE("a point light lights the diffuse lobe alone") {
  check_point_light_lights_one_lobe<PathTracer>();
}

TEST_CASE("a lit floor in a mirror: ks kd/pi I/d^2") {
  check_lit_floor_in_a_mirror<PathTracer>();
}

TEST_CASE("at most N bounces: a mirror is one, and a glass ball is two") {
  check_bound_between_mirrors<PathTracer>();
  check_bound_through_glass<PathTracer>();
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

TEST_CASE("a lamp behind glass lights the floor") {
  check_lamp_behind_glass_lights_the_floor<PathTracer>();
}

TEST_CASE("glass and gaps in a white room are invisible however thin") {
  check_thin_gaps<PathTracer>();
}

TEST_SUITE_END();
