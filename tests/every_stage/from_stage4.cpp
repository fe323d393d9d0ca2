// What every path tracer with Russian roulette must do.

#include "stage.hpp"
#include "support/lamps_and_glass.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

TEST_SUITE_BEGIN("analytic scenes");

TEST_CASE("a path that never leaves glass ends") {
  check_endless_path_ends<PathTracer>();
}

TEST_CASE("a path on a dark wall ends soon") {
  check_path_on_a_dark_wall_is_short<PathTracer>();
}

TEST_SUITE_END();
