#pragma once

// Comparisons of pictures as checks of a test.

#include <doctest/doctest.h>

#include <string>

#include "support/renders.hpp"
#include "tools/comparison.hpp"

namespace lightwalk::tests {

/// Renders the scene with other samples and seeds, all else as in `settings`.
template <class PathTracer>
Rerender renderer(const Scene& scene, const RenderSettings& settings) {
  return [&scene, settings](int samples, std::uint64_t seed) {
    RenderSettings changed = settings;
    changed.samples_per_pixel = samples;
    changed.seed = seed;
    return paint<PathTracer>(scene, changed);
  };
}

/// What is worst about a comparison, in one line.
inline std::string summary_of(const Comparison& comparison) {
  std::string text = "no region differs";
  double worst = 0;
  for (const RegionDifference& one : comparison.confirmed) {
    if (one.z <= worst) continue;
    worst = one.z;
    const Region& r = one.region;
    text = "columns " + std::to_string(r.left) + " to " +
           std::to_string(r.left + r.width - 1) + ", rows " +
           std::to_string(r.top) + " to " +
           std::to_string(r.top + r.height - 1) + ", channel " +
           std::to_string(one.channel) + ": mean " +
           std::to_string(one.test) + " instead of " +
           std::to_string(one.reference) + ", z = " + std::to_string(one.z);
  }
  return text;
}

/// Fails unless a render with `samples` samples is the same picture.
inline void check_same(const Rerender& rerender, int samples,
                       const RenderResult& reference) {
  const Comparison comparison =
      compare_with_reference(rerender, samples, 11, reference);
  INFO(summary_of(comparison));
  CHECK(comparison.test.info.dropped == 0);
  CHECK(comparison.same());
}

}  // namespace lightwalk::tests
