// What stage 3 renders, against what it rendered when it was known to be right.

#include "stages/3_specular_refraction/path_tracer.hpp"
#include "support/goldens.hpp"

// Last of all: what a test by itself can tell is more to the point.
TEST_SUITE_BEGIN("golden images");

TEST_CASE("golden images: the pictures of stage 3") {
  lightwalk::tests::check_goldens<lightwalk::stage3::PathTracer>(3);
}

TEST_SUITE_END();
