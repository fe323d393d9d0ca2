// Next-event estimation with mirrors and glass.

#include <doctest/doctest.h>

#include "stages/3_specular_refraction/path_tracer.hpp"
#include "support/comparisons.hpp"
#include "support/exact_radiance.hpp"
#include "support/expectations.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage3::PathTracer;

TEST_SUITE_BEGIN("analytic scenes");

namespace {

Vec3 one_sample(const Scene& scene, const Ray& ray, int max_bounces) {
  RenderSettings settings;
  settings.max_bounces = max_bounces;
  Random random(3, 1, 4);
  return PathTracer(scene, settings).radiance(ray, random);
}

const Ray down{{0, 1, -1}, {0, -0.70710678f, 0.70710678f}};

std::string floor_of(const std::string& material) {
  return "[materials]\nthing = " + material +
         "\nlamp = { ke = 4 }\n[[shapes]]\ntype = \"plane\"\n"
         "normal = [0, 1, 0]\ndistance = 0\nmaterial = \"thing\"\n";
}

constexpr const char* point_light =
    "[[lights]]\ntype = \"point\"\ncenter = [0, 1, 0]\nintensity = 5\n";

}  // namespace

TEST_CASE("a point light does not light a mirror, nor glass") {
  check_color(
      "the light of a point in a mirror, which no ray hits",
      one_sample(scene_text(floor_of("{ ks = 1 }") + point_light), down, 8),
      Vec3(0));
  check_color(
      "the light of a point on glass, where no lobe is diffuse",
      one_sample(scene_text(floor_of("{ kt = 1 }") + point_light), down, 8),
      Vec3(0));
}

// kd/pi * I / 1^2 for the point right below, whatever ks and kt are.
TEST_CASE("a point light lights the diffuse part of plastic") {
  const Scene scene =
      scene_text(floor_of("{ kd = 0.5, ks = 0.3, kt = 0.2 }") + point_light);
  check_value("kd/pi I/d^2 on plastic", red(one_sample(scene, down, 1)),
              0.5 * 5 / std::acos(-1.0));
}

TEST_CASE("a lamp is seen in a mirror as bright as it is") {
  for (const std::string lamp :
       {"type = \"rectangle\"\ncorner = [-1, 0, 2]\nedge_u = [0, 5, 0]\n"
        "edge_v = [2, 0, 0]\n",
        "type = \"sphere\"\ncenter = [0, 2, 2]\nradius = 1\n",
        "type = \"plane\"\nnormal = [0, 0, -1]\ndistance = 2\n"}) {
    INFO("the lamp is\n", lamp);
    const Scene scene = scene_text(floor_of("{ ks = 0.5 }") + "[[shapes]]\n" +
                                   lamp + "material = \"lamp\"\n");
    check_radiance<PathTracer>("the mirror", scene, down, with_bounces(1),
                               DoubleVec3(2));
  }
}

// The mirrored ray goes straight up and misses the lamp; the refracted ray
// hits nothing. So only the diffuse part brings light, sampled or hit, but
// not both: kd ke cos (r/d)^2.
TEST_CASE("a diffuse wall under a lamp: kd ke F, counted once") {
  for (const char* material :
       {"{ kd = 0.5 }", "{ kd = 0.5, ks = 0.2, kt = 0.1 }"}) {
    const Scene scene = scene_text(floor_of(material) +
                                   "[[shapes]]\ntype = \"sphere\"\n"
                                   "center = [3, 4, 0]\nradius = 2\n"
                                   "material = \"lamp\"\n");
    RenderSettings settings;
    settings.max_bounces = 1;
    const Pixel pixel = estimate(PathTracer(scene, settings),
                                 {{0, 0.01f, 0}, {0, -1, 0}}, 50'000);
    check_mean("kd ke cos (r/d)^2 on material = " + std::string(material),
               pixel, 0, 0.5 * 4 * 0.8 * 4 / 25);
  }
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("relations");

// Without mirrors and glass stage 3 is stage 2. Both draw the same numbers,
// so even the noise is the same, up to rounding.
TEST_CASE("without specular lobes the picture is stage 2's") {
  for (const std::string name :
       {"cornell_box_point_diffuse", "cornell_box_lamp_diffuse",
        "cornell_box_ceiling_diffuse"}) {
    INFO("scene ", name);
    Scene scene = scene_file(name, 24, 24);
    RenderSettings settings;
    settings.max_bounces = 4;
    settings.samples_per_pixel = 256;
    const auto second = paint<stage2::PathTracer>(scene, settings);
    check_same(renderer<PathTracer>(scene, settings), 64, second);
  }
}

TEST_SUITE_END();
