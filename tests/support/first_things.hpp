#pragma once

// # What to test in a path tracer before anything else
//
// Each of these tests fails for one reason alone. While it fails nearly all
// other tests fail, too, so these come first.

#include <doctest/doctest.h>

#include <string>

#include "common/scene/path_log.hpp"
#include "support/expectations.hpp"
#include "support/renders.hpp"

namespace lightwalk::tests {

/// A floor with this material under a lid at y = 1, or under nothing.
inline Scene floor_and_light(const std::string& floor, bool lid) {
  std::string text =
      "[materials]\nfloor = " + floor +
      "\nblack = { kd = 0 }\n[[shapes]]\ntype = \"plane\"\n"
      "normal = [0, 1, 0]\ndistance = 0\nmaterial = \"floor\"\n"
      "[[lights]]\ntype = \"point\"\ncenter = [0, 0.8, 0]\nintensity = 9\n";
  if (lid) {
    text +=
        "[[shapes]]\ntype = \"plane\"\nnormal = [0, -1, 0]\n"
        "distance = 1\nmaterial = \"black\"\n";
  }
  return scene_text(text);
}

/// A ray that hits nothing brings no light.
template <class PathTracer>
void check_nothing_is_black() {
  const Scene scene = floor_and_light("{ kd = 0.5 }", false);
  const PathTracer tracer(scene, {});
  Random random(1, 0, 0);
  check_color("a ray that meets nothing brings the background",
              tracer.radiance({{0, 1, 0}, {0.6f, 0.8f, 0}}, random), Vec3(0));
}

/// The floor is as bright without the lid as with it, whatever that is.
template <class PathTracer>
void check_light_is_kept_on_leaving() {
  RenderSettings settings;
  settings.max_bounces = 2;
  const Ray ray{{0, 0.5f, 0.1f}, {0, -1, 0}};
  const auto under = [&](bool lid) {
    const Scene scene = floor_and_light("{ kd = 0.5 }", lid);
    return estimate(PathTracer(scene, settings), ray, 2000);
  };
  const Pixel closed = under(true), open = under(false);
  const double noise =
      std::sqrt((closed.variance(0) + open.variance(0)) / 2000);
  if (std::abs(closed.mean[0] - open.mean[0]) <=
      max_deviations * noise + 1e-4 * closed.mean[0]) {
    return;
  }
  FAIL_CHECK("a floor under a light has radiance "
             << closed.mean[0] << " where its paths end at a black lid, and "
             << open.mean[0]
             << " where they leave the scene: a path returns the radiance "
                "found so far, even if its last ray hits nothing");
}

/// The log of one path, or of its branches.
template <class PathTracer>
PathLog listen_to(const PathTracer& tracer, const Ray& ray,
                  std::uint64_t sample) {
  PathLog log;
  const PathListener listener(log);
  Random random(1, 0, sample);
  tracer.radiance(ray, random);
  return log;
}

/// All rays of some paths have unit length: the camera's do.
template <class PathTracer>
void check_unit_directions(const std::string& material) {
  const Scene scene = scene_text(
      "[materials]\nfloor = " + material +
      "\nlamp = { ke = 1 }\n[[shapes]]\ntype = \"sphere\"\n"
      "center = [0, 0, 0]\nradius = 1\nmaterial = \"floor\"\n"
      "[[shapes]]\ntype = \"plane\"\nnormal = [0, 1, 0]\ndistance = 2\n"
      "material = \"floor\"\n[[shapes]]\ntype = \"rectangle\"\n"
      "corner = [2, 3, 2]\nedge_u = [1, 0, 0]\nedge_v = [0, 0, 1]\n"
      "material = \"lamp\"\n[[lights]]\ntype = \"point\"\n"
      "center = [2, 3, -2]\nintensity = 9\n");
  RenderSettings settings;
  settings.max_bounces = 4;
  const PathTracer tracer(scene, settings);
  for (std::uint64_t i = 0; i < 100; ++i) {
    const PathLog log = listen_to(tracer, {{0.3f, 0.2f, -5}, {0, 0, 1}}, i);
    for (const Ray& ray : log.rays) {
      require_value(
          "the length of the direction of a ray on material = " + material,
          static_cast<double>(length(ray.direction)), 1, 1e-4);
    }
    for (const PathVertex& vertex : log.vertices) {
      for (const ShadowRay& shadow : vertex.shadow_rays) {
        require_value("the length of the direction of a shadow ray",
                      static_cast<double>(length(shadow.ray.direction)), 1,
                      1e-4);
      }
    }
  }
}

}  // namespace lightwalk::tests
