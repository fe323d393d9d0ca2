// What a path tells of itself.

#include "stages/1_diffuse/path_tracer.hpp"
#include "support/told_paths.hpp"

using namespace lightwalk::tests;

TEST_SUITE_BEGIN("relations");

TEST_CASE("a told path is the sum that is computed, vertex by vertex") {
  check_told_paths<lightwalk::stage1::PathTracer>("");
}

TEST_SUITE_END();
