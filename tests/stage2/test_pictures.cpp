// Compares stage 2 with stage 1: next-event estimation changes the noise of a
// picture, and nothing else.

#include <doctest/doctest.h>

#include "stages/2_next_event/path_tracer.hpp"
#include "support/comparisons.hpp"
#include "support/renders.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

TEST_SUITE_BEGIN("relations");

TEST_CASE("sampling the lamps gives the picture that hitting them gives") {
  struct Case {
    std::string scene;
    int max_bounces;
    bool calmer;  // whether there is a lamp to sample
  };
  const Case cases[] = {{"cornell_box_lamp_diffuse", 1, true},
                        {"cornell_box_lamp_diffuse", 2, true},
                        {"cornell_box_lamp_diffuse", 8, true},
                        {"cornell_box_sphere_lamp_diffuse", 2, true},
                        {"cornell_box_ceiling_diffuse", 2, false}};
  for (const Case& one : cases) {
    INFO("scene ", one.scene, ", at most ", bounces_in_words(one.max_bounces),
         ", against stage 1");
    Scene scene = scene_file(one.scene, 24, 24);
    RenderSettings settings;
    settings.max_bounces = one.max_bounces;
    settings.samples_per_pixel = 1024;
    const RenderResult found = paint<stage1::PathTracer>(scene, settings);
    check_same(renderer<stage2::PathTracer>(scene, settings), 128, found);
    if (!one.calmer) continue;
    settings.samples_per_pixel = 128;
    const RenderResult asked = paint<stage2::PathTracer>(scene, settings);
    const double ratio = variance_ratio(asked, found);
    INFO("the variance is ", ratio,
         " times that of stage 1, expected less than half: are the lamps "
         "sampled at all?");
    CHECK(ratio < 0.5);
  }
}

TEST_CASE("uniform and cosine sampling paint the same picture") {
  Scene scene = scene_file("cornell_box_point_diffuse", 24, 24);
  RenderSettings settings;
  settings.samples_per_pixel = 512;
  settings.max_bounces = 4;
  const auto cosine = paint<stage2::PathTracer>(scene, settings);
  settings.sampling = Sampling::uniform;
  check_same(renderer<stage2::PathTracer>(scene, settings), 256, cosine);
}

TEST_SUITE_END();
