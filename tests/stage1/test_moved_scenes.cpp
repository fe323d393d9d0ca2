// The lab's box, moved, scaled, and with walls that are huge spheres.

#include "stages/1_diffuse/path_tracer.hpp"
#include "support/moved_scenes.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

TEST_SUITE_BEGIN("relations");

TEST_CASE("the box gives the same picture wherever and however large it is") {
  check_moved<stage1::PathTracer>("cornell_box_ceiling_diffuse", 128, 8);
}

TEST_SUITE_END();
