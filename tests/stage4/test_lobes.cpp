// What follows from the events: directions and lights.

#include <doctest/doctest.h>

#include "stages/4_russian_roulette/path_tracer.hpp"
#include "support/expectations.hpp"
#include "support/specular_scenes.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage4::PathTracer;

TEST_SUITE_BEGIN("analytic scenes");

namespace {

RenderSettings bounces(int max_bounces) {
  RenderSettings settings;
  settings.max_bounces = max_bounces;
  return settings;
}

std::string floor_of(const std::string& material) {
  return "[materials]\nthing = " + material +
         "\nlamp = { ke = 4 }\nblack = { kd = 0 }\n[[shapes]]\n"
         "type = \"plane\"\nnormal = [0, 1, 0]\ndistance = 0\n"
         "material = \"thing\"\n";
}

const Ray down{{0, 0.5f, 0}, {0, -1, 0}};

}  // namespace

// Given that the diffuse event was drawn, its direction follows the cosine. A
// black square hangs over the point, in front of a sky, and hides F of the
// cosine-weighted hemisphere: what is left is kd ke (1 - F). Squares of all
// sizes show how directions are distributed between the normal and the
// horizon. The mirrored ray goes straight up, and is always hidden.
TEST_CASE("the direction does not depend on the number that drew the event") {
  struct Case {
    std::string half, whole;
    double form_factor;
  };
  const Case cases[] = {
      {"-0.25", "0.5", 4 * rectangle_form_factor(0.25, 0.25, 1)},
      {"-0.5", "1", 4 * rectangle_form_factor(0.5, 0.5, 1)},
      {"-1", "2", 4 * rectangle_form_factor(1, 1, 1)},
      {"-2", "4", 4 * rectangle_form_factor(2, 2, 1)},
      {"-4", "8", 4 * rectangle_form_factor(4, 4, 1)}};
  for (const char* material :
       {"{ kd = 0.5 }", "{ kd = 0.4, ks = 0.4 }",
        "{ kd = [0.3, 0.6, 0.1], ks = [0.2, 0.1, 0.6] }"}) {
    for (const Case& one : cases) {
      const Scene scene = scene_text(
          floor_of(material) +
          "[[shapes]]\ntype = \"plane\"\nnormal = [0, -1, 0]\ndistance = 2\n"
          "material = \"lamp\"\n[[shapes]]\ntype = \"rectangle\"\ncorner = "
          "[" +
          one.half + ", 1, " + one.half + "]\nedge_u = [" + one.whole +
          ", 0, 0]\nedge_v = [0, 0, " + one.whole +
          "]\nmaterial = \"black\"\n");
      const Pixel pixel =
          estimate(PathTracer(scene, bounces(1)), down, 20'000);
      const double kd =
          static_cast<double>(scene.geometry.planes()[0].material->kd.y);
      check_mean("kd ke (1 - F) under a black square of " + one.whole +
                     ", material = " + std::string(material),
                 pixel, 1, kd * 4 * (1 - one.form_factor));
    }
  }
}

// The mirrored ray goes straight up and misses the lamp. Only the diffuse
// part brings its light, sampled or hit, but not both: kd ke cos (r/d)^2.
TEST_CASE("a diffuse wall under a lamp: kd ke F, counted once") {
  for (const char* material :
       {"{ kd = 0.5 }", "{ kd = 0.5, ks = 0.2, kt = 0.1 }"}) {
    const Scene scene = scene_text(floor_of(material) +
                                   "[[shapes]]\ntype = \"sphere\"\n"
                                   "center = [3, 4, 0]\nradius = 2\n"
                                   "material = \"lamp\"\n");
    const Pixel pixel = estimate(PathTracer(scene, bounces(1)), down, 50'000);
    check_mean("kd ke cos (r/d)^2 on material = " + std::string(material),
               pixel, 0, 0.5 * 4 * 0.8 * 4 / 25);
  }
}

TEST_CASE("a lamp is seen in a mirror as bright as it is") {
  for (const char* lamp :
       {"type = \"rectangle\"\ncorner = [-1, 0, 2]\nedge_u = [0, 5, 0]\n"
        "edge_v = [2, 0, 0]\n",
        "type = \"sphere\"\ncenter = [0, 2, 2]\nradius = 1\n"}) {
    const Scene scene = scene_text(floor_of("{ ks = 1 }") + "[[shapes]]\n" +
                                   lamp + "material = \"lamp\"\n");
    const Ray ray{{0, 1, -1}, {0, -0.70710678f, 0.70710678f}};
    const Pixel pixel = estimate(PathTracer(scene, bounces(2)), ray, 1000);
    check_mean("ke of a lamp in a mirror with ks = 1, the lamp being\n" +
                   std::string(lamp),
               pixel, 0, 4, 1e-5);
  }
}

// A sphere straight overhead fills (r/d)^2 = 1/4 of the diffuse lobe, and the
// mirrored ray hits it for certain: ke (kd / 4 + ks).
TEST_CASE("plastic shows the lamp that it mirrors") {
  const Scene scene = scene_text(floor_of("{ kd = 0.4, ks = 0.3 }") +
                                 "[[shapes]]\ntype = \"sphere\"\n"
                                 "center = [0, 2, 0]\nradius = 1\n"
                                 "material = \"lamp\"\n");
  const Pixel pixel = estimate(PathTracer(scene, bounces(1)), down, 50'000);
  check_mean("ke (kd (r/d)^2 + ks) of plastic under a ball", pixel, 0,
             4 * (0.4 / 4 + 0.3));
}

TEST_SUITE_END();
