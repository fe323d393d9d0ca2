// What a path tells of itself.

#include "stages/5_fresnel_textures/path_tracer.hpp"
#include "support/told_paths.hpp"

using namespace lightwalk::tests;

TEST_SUITE_BEGIN("relations");

TEST_CASE("a told path is the sum that is computed, vertex by vertex") {
  check_told_paths<lightwalk::stage5::PathTracer>(
      "[[lights]]\ntype = \"point\"\n"
      "center = [0, 0, 0]\n"
      "intensity = 3.14159265\n");
}

TEST_SUITE_END();
