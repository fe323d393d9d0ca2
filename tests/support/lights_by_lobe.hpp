#pragma once

// # Lights are sampled per lobe, not per material
//
// Plastic is diffuse and a mirror. Its diffuse lobe has sampled the lamps, so a
// diffuse ray that hits one adds nothing. Its mirror has not: a mirrored ray
// adds the emission of what it hits.

#include "support/exact_radiance.hpp"
#include "support/specular_scenes.hpp"

namespace lightwalk::tests {

inline std::string lobes_floor(const std::string& material) {
  return "[materials]\nthing = " + material + "\nlamp = { ke = 4 }\n" +
         text::plane("0, 1, 0", "0", "thing");
}

inline const Ray at_lobes_floor{{0, 0.5f, 0}, {0, -1, 0}};

/// A ball straight overhead fills 1/4 of the diffuse lobe, and a rectangle 4 F
/// of it. The mirrored ray hits each for certain: ke (kd share + ks).
template <class PathTracer>
void check_plastic_shows_its_lamp() {
  const std::string floor = lobes_floor("{ kd = 0.4, ks = 0.3 }");
  check_radiance<PathTracer>(
      "plastic under a ball that shines",
      scene_text(floor + text::sphere("0, 2, 0", "1", "lamp")),
      at_lobes_floor, with_bounces(1), DoubleVec3(4 * (0.4 / 4 + 0.3)));
  check_radiance<PathTracer>(
      "plastic under a rectangle that shines",
      scene_text(floor +
                 text::rectangle("-1, 1, -1", "2, 0, 0", "0, 0, 2", "lamp")),
      at_lobes_floor, with_bounces(1),
      DoubleVec3(4 * (0.4 * 4 * rectangle_form_factor(1, 1, 1) + 0.3)));
}

/// The refracted ray goes straight down, where no diffuse light comes from. It
/// enters glass, where radiance is 1.5^2 times what it is outside.
template <class PathTracer>
void check_milk_glass_shows_its_lamp() {
  for (const std::string& lamp :
       {text::sphere("0, -2, 0", "1", "lamp"),
        text::rectangle("-1, -1, -1", "0, 0, 2", "2, 0, 0", "lamp")}) {
    check_radiance<PathTracer>(
        "a lamp behind glass that is diffuse as well",
        scene_text(lobes_floor("{ kd = 0.4, kt = 0.5, eta = 1.5 }") + lamp),
        at_lobes_floor, with_bounces(1), DoubleVec3(4 * 0.5 / 2.25));
  }
}

/// A point has no image in a mirror, and plastic is diffuse all the same.
template <class PathTracer>
void check_point_light_lights_one_lobe() {
  for (const char* material : {"{ kd = 0.5 }", "{ kd = 0.5, ks = 0.4 }",
                               "{ kd = 0.5, ks = 0.2, kt = 0.3 }"}) {
    check_radiance<PathTracer>(
        std::string("under a point light: ") + material,
        scene_text(lobes_floor(material) + text::point_light("0, 2, 0", "9")),
        at_lobes_floor, with_bounces(1),
        DoubleVec3(0.5 / std::acos(-1.0) * 9 / 4));
    // Within a ball of radius 2, d is the same.
    check_radiance<PathTracer>(
        std::string("within a ball, with a point light in the middle: ") +
            material,
        scene_text(std::string("[materials]\nthing = ") + material + "\n" +
                   text::sphere("0, 0, 0", "2", "thing") +
                   text::point_light("0, 0, 0", "9")),
        {{0.2f, 0.1f, -0.3f}, {0, 0.6f, 0.8f}}, with_bounces(1),
        DoubleVec3(0.5 / std::acos(-1.0) * 9 / 4));
  }
}

/// The mirror hangs at y = 2, and shows the floor's point (0, 0, 2), which has
/// a point light 1 above it. Only the mirror's ks colors the floor's light,
/// whatever the floor's ks and kt: ks kd / pi I / 1^2.
template <class PathTracer>
void check_lit_floor_in_a_mirror() {
  for (const char* floor :
       {"{ kd = 0.5 }", "{ kd = 0.2, ks = 0.7 }", "{ kd = 0.2, kt = 0.7 }"}) {
    const Scene scene = scene_text(
        std::string("[materials]\nmirror = { ks = [0.9, 0.6, 0.3] }\n"
                    "floor = ") +
        floor + "\n" + text::plane("0, 1, 0", "0", "floor") +
        text::plane("0, -1, 0", "2", "mirror") +
        text::point_light("0, 1, 2", "9"));
    const auto kd =
        static_cast<double>(scene.geometry.planes()[0].material->kd.x);
    check_radiance<PathTracer>(
        std::string("a mirror with ks = (0.9, 0.6, 0.3) that shows a lit "
                    "floor, ") +
            floor,
        scene, {{0, 1, -1}, normalize(Vec3(0, 1, 1))}, with_bounces(2),
        DoubleVec3(0.9, 0.6, 0.3) * (kd / std::acos(-1.0) * 9));
  }
}

}  // namespace lightwalk::tests
