// The lab's box, moved, scaled, and with walls that are huge spheres.

#include "stages/3_specular_refraction/path_tracer.hpp"
#include "support/moved_scenes.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

TEST_SUITE_BEGIN("relations");

TEST_CASE("the box gives the same picture wherever and however large it is") {
  check_moved<stage3::PathTracer>("cornell_box_point", 32, 4);
  check_moved<stage3::PathTracer>("cornell_box_ceiling", 32, 4);
}

TEST_SUITE_END();
