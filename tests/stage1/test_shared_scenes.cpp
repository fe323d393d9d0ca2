// Scenes that every stage shows alike, as far as it can render them.

#include <doctest/doctest.h>

#include "stages/1_diffuse/path_tracer.hpp"
#include "support/bounce_bounds.hpp"
#include "support/bright_and_dim.hpp"
#include "support/covered_sky.hpp"
#include "support/lamps_and_glass.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage1::PathTracer;

TEST_SUITE_BEGIN("analytic scenes");

TEST_CASE("at most N bounces: N terms of the light of a lamp") {
  check_bound_under_a_lamp<PathTracer>();
}

TEST_CASE("each direction has its own weight, however directions are drawn") {
  check_covered_sky<PathTracer>("{ kd = 0.5 }", DoubleVec3(0.5), 1);
}

TEST_CASE("bright samples are not clamped, and dim ones not cut off") {
  check_bright_and_dim_sky<PathTracer>();
}

TEST_CASE("paths that seem to be worth little are followed to their end") {
  check_dark_floor_under_a_bright_sky<PathTracer>();
}

TEST_CASE("the back of an emitter lights nothing") {
  check_back_of_a_lamp_is_black<PathTracer>();
}

TEST_SUITE_END();
