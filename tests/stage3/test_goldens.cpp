// What stage 3 renders, against what it rendered when it was known to be right.

#include "stages/3_specular_refraction/path_tracer.hpp"
#include "support/goldens.hpp"

TEST_CASE("golden images: the pictures of stage 3") {
  lightwalk::tests::check_goldens<lightwalk::stage3::PathTracer>(3);
}
