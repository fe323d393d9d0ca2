// What stage 2 renders, against what it rendered when it was known to be right.

#include "stages/2_next_event/path_tracer.hpp"
#include "support/goldens.hpp"

TEST_CASE("golden images: the pictures of stage 2") {
  lightwalk::tests::check_goldens<lightwalk::stage2::PathTracer>(2);
}
