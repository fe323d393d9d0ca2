// What every path tracer must do, and each of these tests asks one thing.

#include "stages/1_diffuse/path_tracer.hpp"
#include "support/first_things.hpp"

using namespace lightwalk::tests;
using lightwalk::stage1::PathTracer;

TEST_SUITE_BEGIN("units");

TEST_CASE("a ray that meets nothing brings the background") {
  check_nothing_is_black<PathTracer>();
}

TEST_CASE("every ray has a direction of unit length") {
  check_unit_directions<PathTracer>("{ kd = 0.5 }");
}

TEST_SUITE_END();
