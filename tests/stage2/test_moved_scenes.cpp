// The lab's box, moved, scaled, and with walls that are huge spheres.

#include "stages/2_next_event/path_tracer.hpp"
#include "support/moved_scenes.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

TEST_SUITE_BEGIN("relations");

TEST_CASE("the box gives the same picture wherever and however large it is") {
  check_moved<stage2::PathTracer>("cornell_box_point_diffuse", 64, 8);
  check_moved<stage2::PathTracer>("cornell_box_ceiling_diffuse", 64, 8);
  check_moved<stage2::PathTracer>("cornell_box_lamp_diffuse", 64, 8);
}

TEST_SUITE_END();
