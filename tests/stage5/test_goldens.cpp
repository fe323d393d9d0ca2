// What stage 5 renders, against what it rendered when it was known to be right.

#include "stages/5_fresnel_textures/path_tracer.hpp"
#include "support/goldens.hpp"

// Last of all: what a test by itself can tell is more to the point.
TEST_SUITE_BEGIN("golden images");

TEST_CASE("golden images: the pictures of stage 5") {
  lightwalk::tests::check_goldens<lightwalk::stage5::PathTracer>(5);
}

TEST_SUITE_END();
