#pragma once

// # At most N bounces are N terms of a series
//
// The bound is exact: 0 shows the lamps alone, 1 what they light directly,
// and each further bounce adds a term. Direct light is a bounce, and so is a
// mirror, and glass is one where light enters and one where it leaves.

#include "support/exact_radiance.hpp"
#include "support/specular_scenes.hpp"

namespace lightwalk::tests {

/// 1 + q + ... + q^(n - 1)
inline double power_series(double q, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum = 1 + q * sum;
  return sum;
}

/// A ball of radius 1/2 that shines within a sphere of radius 1: from any
/// point of the wall it fills F = 1/4, and L = kd ke F (1 + q + q^2 + ...)
/// with q = kd (1 - F).
template <class PathTracer>
void check_bound_under_a_lamp() {
  const Scene scene =
      scene_text("[materials]\nwall = { kd = 0.8 }\nlamp = { ke = 3 }\n" +
                 text::sphere("0, 0, 0", "1", "wall") +
                 text::sphere("0, 0, 0", "0.5", "lamp"));
  const Ray at_wall{{0.6f, 0, 0}, {1, 0, 0}};
  const Ray at_lamp{{0.6f, 0, 0}, {-1, 0, 0}};
  for (const int n : {0, 1, 2, 3}) {
    for (const Sampling sampling : {Sampling::cosine, Sampling::uniform}) {
      check_radiance<PathTracer>(
          "a wall around a lamp", scene, at_wall, with_bounces(n, sampling),
          DoubleVec3(0.8 * 3 / 4 * power_series(0.8 * 0.75, n)));
      check_radiance<PathTracer>("the lamp itself", scene, at_lamp,
                                 with_bounces(n, sampling), DoubleVec3(3));
    }
  }
}

/// A ball of radius 1/4 within a sphere of radius 1: F = 1/16, so that most
/// paths are long. In red the wall loses nothing, and in green all of it. Red
/// comes to 3 (1 - (15/16)^40) = 2.77 after 40 bounces, and to 1.2 after 8.
template <class PathTracer>
void check_long_paths_of_some_channels(int most) {
  const DoubleVec3 kd(1, 0, 0.5);
  const Scene scene = scene_text(
      "[materials]\nwall = { kd = [1, 0, 0.5] }\nlamp = { ke = 3 }\n" +
      text::sphere("0, 0, 0", "1", "wall") +
      text::sphere("0, 0, 0", "0.25", "lamp"));
  for (const int n : {2, most}) {
    DoubleVec3 expected(0);
    for (int c = 0; c < 3; ++c) {
      expected[c] = kd[c] * 3 / 16 * power_series(kd[c] * 15 / 16, n);
    }
    check_radiance<PathTracer>("a wall with kd = (1, 0, 0.5) around a lamp",
                               scene, {{0.6f, 0, 0}, {1, 0, 0}},
                               with_bounces(n), expected);
  }
}

/// A sphere from inside, with a point light of intensity pi at its center:
/// each hit has radiance kd from it, and reflects kd + ks of the radiance of
/// the wall, which is equally bright everywhere.
template <class PathTracer>
void check_bound_under_a_point_light(double ks) {
  const Scene scene = scene_text(
      "[materials]\nwall = { kd = 0.5, ks = " + std::to_string(ks) + " }\n" +
      text::sphere("0, 0, 0", "1", "wall") +
      text::point_light("0, 0, 0", "3.14159265"));
  const Ray ray{{0.2f, 0.1f, -0.3f}, {0, 0.6f, 0.8f}};
  for (const int n : {0, 1, 2, 3, 4}) {
    check_radiance<PathTracer>("a wall around a point light", scene, ray,
                               with_bounces(n),
                               DoubleVec3(0.5 * power_series(0.5 + ks, n)));
  }
}

/// A ray zigzags between two mirrors, and hits the lamp after k bounces.
template <class PathTracer>
void check_bound_between_mirrors() {
  const char* distances[] = {"0.25", "1", "2", "3"};
  for (int k = 0; k <= 3; ++k) {
    const Scene scene =
        scene_text("[materials]\nmirror = { ks = 1 }\nlamp = { ke = 2 }\n" +
                   text::plane("0, 1, 0", "0", "mirror") +
                   text::plane("0, -1, 0", "1", "mirror") +
                   text::plane("0, 0, -1", distances[k], "lamp"));
    for (int n = 0; n <= 3; ++n) {
      check_radiance<PathTracer>(
          "a lamp behind " + std::to_string(k) + " mirrors", scene,
          {{0, 0.5f, 0}, normalize(Vec3(0, -1, 1))}, with_bounces(n),
          DoubleVec3(n >= k ? 2 : 0));
    }
  }
}

/// Light is bent where it enters a ball and where it leaves.
template <class PathTracer>
void check_bound_through_glass() {
  const Scene scene = in_white_room("{ kt = 1 }", ball("thing"));
  for (int n = 0; n <= 3; ++n) {
    check_radiance<PathTracer>("a white room behind a glass ball", scene,
                               {{0.3f, 0.2f, -5}, {0, 0, 1}}, with_bounces(n),
                               DoubleVec3(n >= 2 ? 1 : 0));
  }
}

}  // namespace lightwalk::tests
