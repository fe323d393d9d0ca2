#pragma once

// # Radiance found so far survives, however the path ends
//
// A floor gets direct light. Then its path ends at a lamp that has been
// sampled, at an emitter that cannot be sampled, at something black, or outside
// the scene. The direct light of the floor must stay in the sum.

#include "support/exact_radiance.hpp"
#include "support/specular_scenes.hpp"

namespace lightwalk::tests {

inline const DoubleVec3 gathering_kd(0.5, 0.25, 0.75);

/// Floor y = 0, seen at the origin, and a point light at (1, 2, 0).
inline std::string gathering_floor(const std::string& rest_of_material) {
  return "[materials]\nfloor = { kd = [0.5, 0.25, 0.75]" + rest_of_material +
         " }\nlamp = { ke = 4 }\nsky = { ke = [1, 2, 3] }\n"
         "black = { kd = 0 }\n" +
         text::plane("0, 1, 0", "0", "floor");
}

inline std::string gathering_light() {
  return text::point_light("1, 2, 0", "9");
}

/// kd / pi I cos / d^2, where cos = 2 / sqrt 5 and d^2 = 5.
inline DoubleVec3 gathered_from_the_light() {
  return gathering_kd / std::acos(-1.0) * 9.0 * 2.0 / std::pow(5.0, 1.5);
}

/// Comes down along -z, so that its mirror image goes up along -z.
inline const Ray at_gathering_floor{{0, 0.4f, 0.3f}, {0, -0.8f, -0.6f}};

/// The path ends at an emitter that next-event estimation cannot sample: a
/// plane. It adds kd ke. A lamp that fills F of the hemisphere hides that share
/// of the plane.
template <class PathTracer>
void check_kept_at_an_emitter() {
  const DoubleVec3 sky(1, 2, 3);
  const std::string ceiling = text::plane("0, -1, 0", "3", "sky");
  check_radiance<PathTracer>(
      "a point light and a ceiling that shines",
      scene_text(gathering_floor("") + gathering_light() + ceiling),
      at_gathering_floor, with_bounces(1),
      gathered_from_the_light() + gathering_kd * sky);
  const double f = rectangle_form_factor(1.5, 0.7, 0.8);
  check_radiance<PathTracer>(
      "a lamp before a ceiling that shines, too",
      scene_text(
          gathering_floor("") + ceiling +
          text::rectangle("0, 0.8, 0", "1.5, 0, 0", "0, 0, 0.7", "lamp")),
      at_gathering_floor, with_bounces(1),
      gathering_kd * (4.0 * f + sky * (1 - f)));
}

/// The path ends at a lamp whose light is in the sum already: a ball straight
/// overhead that fills 1/4 of the cosine-weighted hemisphere.
template <class PathTracer>
void check_kept_at_a_counted_lamp() {
  check_radiance<PathTracer>(
      "a point light and a ball that shines",
      scene_text(gathering_floor("") + gathering_light() +
                 text::sphere("0, 4, 0", "2", "lamp")),
      at_gathering_floor, with_bounces(1),
      gathered_from_the_light() + gathering_kd * 4.0 / 4.0);
}

/// All that the floor sees is black, or has no color in common with it, so
/// the throughput becomes black there.
template <class PathTracer>
void check_kept_at_black_throughput() {
  const Scene under_black =
      scene_text(gathering_floor("") + gathering_light() +
                 text::plane("0, -1, 0", "3", "black"));
  const Scene red_under_green = scene_text(
      "[materials]\nred = { kd = [0.5, 0, 0] }\n"
      "green = { kd = [0, 0.9, 0] }\n" +
      text::plane("0, 1, 0", "0", "red") +
      text::plane("0, -1, 0", "3", "green") + gathering_light());
  const DoubleVec3 gathered = gathered_from_the_light();
  for (const int max_bounces : {1, 2, 5}) {
    check_radiance<PathTracer>("a point light under a black ceiling",
                               under_black, at_gathering_floor,
                               with_bounces(max_bounces), gathered);
    check_radiance<PathTracer>("a red floor under a green ceiling",
                               red_under_green, at_gathering_floor,
                               with_bounces(max_bounces),
                               gathered * DoubleVec3(1, 0, 0));
  }
}

/// Only the light is above the floor.
template <class PathTracer>
void check_kept_when_a_path_leaves() {
  for (const int max_bounces : {1, 2, 5}) {
    check_radiance<PathTracer>(
        "a point light and nothing else",
        scene_text(gathering_floor("") + gathering_light()),
        at_gathering_floor, with_bounces(max_bounces),
        gathered_from_the_light());
  }
}

/// A wall that shines stands at one side; the other side is open. Half of the
/// diffuse directions hit the wall, whatever their angle. Whether the mirrored
/// and the refracted ray hit it depends on the ray of the camera.
template <class PathTracer>
void check_kept_when_a_lobe_leaves() {
  const Scene scene = scene_text(
      "[materials]\nfloor = { kd = 0.4, ks = 0.3, kt = 0.2, eta = 1.5 }\n"
      "sky = { ke = 2 }\n" +
      text::plane("0, 1, 0", "0", "floor") +
      text::plane("-1, 0, 0", "5", "sky") + gathering_light());
  const double direct = 0.4 / std::acos(-1.0) * 9 * 2 / std::pow(5.0, 1.5);
  const double diffuse = direct + 0.4 * 2 / 2;
  const double specular = 0.3 * 2, refracted = 0.2 * 2 / 2.25;
  struct Case {
    const char* what;
    Ray ray;
    double expected;
  };
  const Case cases[] = {{"mirror and glass show the wall",
                         {{-0.6f, 0.8f, 0}, {0.6f, -0.8f, 0}},
                         diffuse + specular + refracted},
                        {"mirror and glass show nothing",
                         {{0.6f, 0.8f, 0}, {-0.6f, -0.8f, 0}},
                         diffuse}};
  for (const int max_bounces : {1, 3}) {
    for (const Case& one : cases) {
      check_radiance<PathTracer>(one.what, scene, one.ray,
                                 with_bounces(max_bounces),
                                 DoubleVec3(one.expected), 40'000);
    }
  }
}

}  // namespace lightwalk::tests
