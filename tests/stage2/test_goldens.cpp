// What stage 2 renders, against what it rendered when it was known to be right.

#include "stages/2_next_event/path_tracer.hpp"
#include "support/goldens.hpp"

// Last of all: what a test by itself can tell is more to the point.
TEST_SUITE_BEGIN("golden images");

TEST_CASE("golden images: the pictures of stage 2") {
  lightwalk::tests::check_goldens<lightwalk::stage2::PathTracer>(2);
}

TEST_SUITE_END();
