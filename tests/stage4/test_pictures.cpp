// Compares stage 4 with stage 3: drawing one lobe at random gives the same
// picture as following all lobes.

#include <doctest/doctest.h>

#include "stages/4_russian_roulette/path_tracer.hpp"
#include "support/comparisons.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage4::PathTracer;

TEST_SUITE_BEGIN("relations");

TEST_CASE("with a bound of N bounces the picture is stage 3's") {
  struct Case {
    std::string scene;
    int max_bounces;
  };
  const Case cases[] = {
      {"cornell_box_point", 1},        {"cornell_box_point", 4},
      {"cornell_box_ceiling", 5},      {"plastic", 2},
      {"cornell_box_lamp_diffuse", 3}, {"coloured_lobes", 3}};
  for (const Case& one : cases) {
    INFO("scene ", one.scene, ", at most ", bounces_in_words(one.max_bounces),
         ", against stage 3");
    Scene scene = scene_file(one.scene, 24, 24);
    RenderSettings settings;
    settings.max_bounces = one.max_bounces;
    settings.samples_per_pixel = 256;
    const auto third = paint<stage3::PathTracer>(scene, settings);
    check_same(renderer<PathTracer>(scene, settings), 128, third);
  }
}

TEST_CASE("rays per sample do not grow with the bound, as stage 3's do") {
  Scene scene = scene_file("plastic", 16, 16);
  RenderSettings settings;
  settings.samples_per_pixel = 4;
  settings.max_bounces = 10;
  const auto branching = paint<stage3::PathTracer>(scene, settings);
  const auto roulette = paint<PathTracer>(scene, settings);
  INFO("rays: ", roulette.info.rays, ", and stage 3's ", branching.info.rays,
       ", expected more than 30 times as many");
  CHECK(branching.info.rays > 30 * roulette.info.rays);
}

TEST_SUITE_END();
