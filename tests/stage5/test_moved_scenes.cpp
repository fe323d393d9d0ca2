// The lab's box, moved, scaled, and with walls that are huge spheres.

#include "stages/5_fresnel_textures/path_tracer.hpp"
#include "support/moved_scenes.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

TEST_SUITE_BEGIN("relations");

TEST_CASE("the box gives the same picture wherever and however large it is") {
  check_moved<stage5::PathTracer>("cornell_box_point", 64, 64);
  check_moved<stage5::PathTracer>("cornell_box_ceiling", 64, 64);
}

TEST_SUITE_END();
