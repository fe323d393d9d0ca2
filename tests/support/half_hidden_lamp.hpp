#pragma once

// # A lamp that was sampled, but hidden
//
// A sample counts even if its shadow ray was blocked: a path that hits another
// part of the same lamp must not add it.

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

}  // namespace lightwalk::tests
