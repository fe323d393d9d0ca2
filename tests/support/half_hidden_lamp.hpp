#pragma once

// # A lamp that was sampled, but hidden
//
// A sample counts even if its shadow ray was blocked: a path that hits another
// part of the same lamp must not add it. Whatever stands before a lamp blocks
// its light, and another lamp does, too.

#include "support/exact_radiance.hpp"
#include "support/specular_scenes.hpp"

namespace lightwalk::tests {

/// A plate hides one half of a rectangle from the point below its middle; the
/// other half is two quarters, kd ke 2 F.
template <class PathTracer>
void check_half_hidden_lamp() {
  const Scene scene = scene_text(
      "[materials]\nfloor = { kd = 0.5 }\nplate = { kd = 0 }\n"
      "lamp = { ke = 4 }\n" +
      text::plane("0, 1, 0", "0", "floor") +
      text::rectangle("-1, 1, -1", "2, 0, 0", "0, 0, 2", "lamp") +
      text::rectangle("-5, 0.9, -5", "5, 0, 0", "0, 0, 10", "plate"));
  check_radiance<PathTracer>(
      "a lamp of which a plate hides one half", scene,
      {{0, 0.5f, 0}, {0, -1, 0}}, with_bounces(1),
      DoubleVec3(0.5 * 4 * 2 * rectangle_form_factor(1, 1, 1)), 50'000);
}

/// Each emitter hides each light behind it, so the floor gets what the emitter
/// itself gives: nothing from its back, kd ke 4 F of the square and kd ke / 4
/// of the ball.
template <class PathTracer>
void check_lamps_block_light() {
  const std::pair<std::string, double> emitters[] = {
      {text::rectangle("-1, 1, -1", "0, 0, 2", "2, 0, 0", "lamp"), 0},
      {text::plane("0, 1, 0", "-1", "lamp"), 0},
      {"[[shapes]]\ntype = \"triangle\"\nmaterial = \"lamp\"\n"
       "vertices = [[-3, 1, -3], [0, 1, 3], [3, 1, -3]]\n",
       0},
      {text::rectangle("-1, 1, -1", "2, 0, 0", "0, 0, 2", "lamp"),
       0.5 * 4 * 4 * rectangle_form_factor(1, 1, 1)},
      {text::sphere("0, 2, 0", "1", "lamp"), 0.5 * 4 / 4}};
  const std::string lights[] = {
      text::point_light("0, 4, 0", "90"),
      text::sphere("0, 5, 0", "0.5", "bright"),
      text::rectangle("-0.5, 4, -0.5", "1, 0, 0", "0, 0, 1", "bright")};
  for (const auto& [emitter, gives] : emitters) {
    for (const std::string& light : lights) {
      check_radiance<PathTracer>(
          "a floor under this emitter\n" + emitter +
              "which hides this light\n" + light,
          scene_text("[materials]\nfloor = { kd = 0.5 }\n"
                     "lamp = { ke = 4 }\nbright = { ke = 90 }\n" +
                     text::plane("0, 1, 0", "0", "floor") + emitter + light),
          {{0, 0.5f, 0}, {0, -1, 0}}, with_bounces(1), DoubleVec3(gives));
    }
  }
}

}  // namespace lightwalk::tests
