// What stage 1 renders, against what it rendered when it was known to be right.

#include "stages/1_diffuse/path_tracer.hpp"
#include "support/goldens.hpp"

// Last of all: what a test by itself can tell is more to the point.
TEST_SUITE_BEGIN("golden images");

TEST_CASE("golden images: the pictures of stage 1") {
  lightwalk::tests::check_goldens<lightwalk::stage1::PathTracer>(1);
}

TEST_SUITE_END();
