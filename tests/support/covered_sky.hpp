#pragma once

// # Where the light comes from, and the weight of that direction
//
// A black square hangs over a floor, in front of a sky, and hides F of the
// cosine-weighted hemisphere: what is left is kd ke (1 - F). Squares of
// all sizes show how directions are distributed between normal and horizon,
// and whether each direction has its own weight: the weight of another sample
// has the right mean, but does not belong to the direction.

#include "support/exact_radiance.hpp"
#include "support/specular_scenes.hpp"

namespace lightwalk::tests {

/// The mirrored ray goes straight up, and is always hidden. `survival` is the
/// probability with which the course's own program follows the diffuse lobe
/// of { kd = 0.5 }; it gives the noise of a right picture.
template <class PathTracer>
void check_covered_sky(const std::string& material, const DoubleVec3& kd,
                       double survival = 0) {
  struct Case {
    std::string corner, edge;
    double half;
  };
  const Case cases[] = {{"-0.4", "0.8", 0.4}, {"-1", "2", 1}, {"-3", "6", 3}};
  for (const Case& one : cases) {
    const double hidden = 4 * rectangle_form_factor(one.half, one.half, 1);
    const Scene scene = scene_text(
        "[materials]\nfloor = " + material +
        "\nsky = { ke = 4 }\nblack = { kd = 0 }\n" +
        text::plane("0, 1, 0", "0", "floor") +
        text::plane("0, -1, 0", "2", "sky") +
        text::rectangle(one.corner + ", 1, " + one.corner,
                        one.edge + ", 0, 0", "0, 0, " + one.edge, "black"));
    const double light = 4 * (1 - hidden);
    for (const Sampling sampling : {Sampling::cosine, Sampling::uniform}) {
      // Cosine sampling: kd ke / survival, with probability survival (1 - F).
      const double mean = kd.x * light;
      const double variance =
          survival > 0 && sampling == Sampling::cosine
              ? kd.x * kd.x * 4 * light / survival - mean * mean
              : 0;
      check_radiance<PathTracer>(
          "a sky behind a square of " + one.edge + " x " + one.edge +
              ", over a floor with " + material,
          scene, {{0, 0.5f, 0}, {0, -1, 0}}, with_bounces(1, sampling),
          kd * light, 20'000, variance);
    }
  }
}

}  // namespace lightwalk::tests
