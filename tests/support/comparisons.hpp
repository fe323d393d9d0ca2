#pragma once

// Comparisons of pictures as checks of a test.

#include <doctest/doctest.h>

#include <string>

#include "compare/comparison.hpp"
#include "support/expectations.hpp"
#include "support/renders.hpp"

namespace lightwalk::tests {

/// Renders the scene with other samples and seeds, all else as in `settings`.
template <class PathTracer>
Rerender renderer(Scene& scene, const RenderSettings& settings) {
  return [&scene, settings](int samples, std::uint64_t seed) {
    RenderSettings changed = settings;
    changed.samples_per_pixel = samples;
    changed.seed = seed;
    return paint<PathTracer>(scene, changed);
  };
}

/// The worst difference of a comparison, in one line.
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
           std::to_string(one.channel) + ": mean " + text_of(one.test) +
           ", expected " + text_of(one.reference) + ", " +
           text_of(std::round(one.test / one.reference * 1e4) / 1e4) +
           " times it, " + text_of(std::round(one.z)) +
           " standard deviations off";
  }
  return text;
}

/// Fails unless two pictures have the same bits.
inline void check_same_bits(const RenderResult& test,
                            const RenderResult& reference) {
  const Image &a = test.radiance, &b = reference.radiance;
  std::string first;
  int different = 0;
  for (int y = 0; y < b.height; ++y) {
    for (int x = 0; x < b.width; ++x) {
      if (a.at(x, y) == b.at(x, y)) continue;
      if (different++ > 0) continue;
      first = "pixel (" + std::to_string(x) + ", " + std::to_string(y) +
              ") is " + text_of(a.at(x, y)) + " instead of " +
              text_of(b.at(x, y));
    }
  }
  if (different > 0) {
    FAIL_CHECK(different << " of " << b.width * b.height
                         << " pixels differ: the first, " << first
                         << ". Does a path use anything but its own random "
                            "numbers, such as a static variable?");
  } else if (test.variance.pixels != reference.variance.pixels) {
    FAIL_CHECK("the pixels are the same, but their variances differ");
  }
}

/// Fails if a picture with another seed has the same noise.
inline void check_other_noise(const RenderResult& test,
                              const RenderResult& reference) {
  if (test.radiance.pixels == reference.radiance.pixels) {
    FAIL_CHECK(
        "with another seed every pixel is the same: no random number "
        "comes from `random`");
  }
}

/// Fails unless a render with `samples` samples is the same picture.
inline void check_same(const Rerender& rerender, int samples,
                       const RenderResult& reference) {
  const Comparison comparison =
      compare_with_reference(rerender, samples, 11, reference);
  if (comparison.test.info.dropped > 0) {
    FAIL_CHECK(comparison.test.info.dropped
               << " samples are infinite or not a number");
  }
  if (!comparison.same()) FAIL_CHECK(summary_of(comparison));
}

}  // namespace lightwalk::tests
