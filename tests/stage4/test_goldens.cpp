// What stage 4 renders, against what it rendered when it was known to be right.

#include "stages/4_russian_roulette/path_tracer.hpp"
#include "support/goldens.hpp"

TEST_CASE("golden images: the pictures of stage 4") {
  lightwalk::tests::check_goldens<lightwalk::stage4::PathTracer>(4);
}
