// Compares whole pictures: no number is known in advance, but two ways to
// compute the same picture must agree.

#include <doctest/doctest.h>

#include "stages/1_diffuse/path_tracer.hpp"
#include "support/comparisons.hpp"
#include "support/renders.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage1::PathTracer;

TEST_SUITE_BEGIN("relations");

TEST_CASE("uniform and cosine sampling paint the same picture") {
  Scene scene = scene_file("cornell_box_ceiling_diffuse");
  RenderSettings settings;
  settings.samples_per_pixel = 512;
  settings.max_bounces = 4;
  settings.seed = 7;
  const RenderResult cosine = paint<PathTracer>(scene, settings);
  settings.sampling = Sampling::uniform;
  const auto uniform = renderer<PathTracer>(scene, settings);
  check_same(uniform, 256, cosine);
}

TEST_SUITE_END();
