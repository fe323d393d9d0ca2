// Thin glass and thin gaps, seen with this stage's paths.

#include "stages/3_specular_refraction/path_tracer.hpp"
#include "support/thin_gaps.hpp"

TEST_SUITE_BEGIN("analytic scenes");

TEST_CASE("glass and gaps in a white room are invisible however thin") {
  lightwalk::tests::check_thin_gaps<lightwalk::stage3::PathTracer>();
}

TEST_SUITE_END();
