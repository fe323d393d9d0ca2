// What every path tracer must do, and each of these tests asks one thing.

#include "stages/4_russian_roulette/path_tracer.hpp"
#include "support/first_things.hpp"

using namespace lightwalk::tests;
using lightwalk::stage4::PathTracer;

TEST_SUITE_BEGIN("units");

TEST_CASE("a ray that meets nothing brings the background") {
  check_nothing_is_black<PathTracer>();
}

TEST_CASE("every ray has a direction of unit length") {
  check_unit_directions<PathTracer>("{ kd = 0.5 }");
  check_unit_directions<PathTracer>("{ ks = 0.9 }");
  check_unit_directions<PathTracer>("{ kt = 0.9 }");
  check_unit_directions<PathTracer>("{ kd = 0.3, ks = 0.3, kt = 0.3 }");
}

TEST_CASE("a ray that leaves the scene does not lose what was gathered") {
  check_light_is_kept_on_leaving<PathTracer>();
}

TEST_SUITE_END();
