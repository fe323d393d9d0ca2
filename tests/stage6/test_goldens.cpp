// What stage 6 renders, against what stage 5 rendered when it was known to be
// right, and the box in other places and sizes.

#include "stages/6_many_paths/path_tracer.hpp"
#include "support/goldens.hpp"
#include "support/moved_scenes.hpp"
#include "support/thin_gaps.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

TEST_SUITE_BEGIN("analytic scenes");

TEST_CASE("glass and gaps in a white room are invisible however thin") {
  check_thin_gaps<stage6::PathTracer>();
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("relations");

TEST_CASE("the box gives the same picture wherever and however large it is") {
  check_moved<stage6::PathTracer>("cornell_box_point", 64, 64);
  check_moved<stage6::PathTracer>("cornell_box_ceiling", 64, 64);
}

TEST_SUITE_END();

// Last of all: what a test by itself can tell is more to the point.
TEST_SUITE_BEGIN("golden images");

TEST_CASE("golden images: the pictures of stage 5, by many paths at once") {
  check_goldens<stage6::PathTracer>(5);
}

TEST_SUITE_END();
