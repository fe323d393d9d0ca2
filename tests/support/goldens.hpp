#pragma once

// Golden images: compares what a stage renders with what it rendered when it
// was known to be right.

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "common/scene_file/loaded_scene.hpp"
#include "support/comparisons.hpp"

namespace lightwalk::tests {

/// One entry of tests/golden/goldens.toml, with its image and its scene.
struct Golden {
  std::string name;  ///< of its scene
  RenderSettings settings;
  RenderResult image;
  LoadedScene loaded;
};

/// The goldens of a stage that are listed and have been made.
std::vector<std::string> golden_names(int stage);

/// Throws if the image is missing or cannot be read.
Golden load_golden(int stage, const std::string& name);

/// What fills most of a region: "the sphere of 'glass'".
std::string seen_in(const LoadedScene& loaded, const Region& region);

/// A failed comparison in words: what differs, where, and by how much. Writes
/// the pictures beside each other.
std::string explain(int stage, const Golden& golden,
                    const Comparison& comparison);

/// With more noise than this, nobody can judge whether a picture is right: its
/// variance divided by the golden's.
inline constexpr double max_noise = 100;

/// Hard checks of a picture, before any statistics. Empty if it passes.
std::string broken_outright(const RenderResult& result);

/// Renders a golden's scene and compares. Prints at most a screenful.
template <class PathTracer>
void check_golden(int stage, const std::string& name) {
  Golden golden = load_golden(stage, name);
  const Rerender rerender =
      renderer<PathTracer>(golden.loaded.scene, golden.settings);
  const int samples = golden.settings.samples_per_pixel;
  const Comparison comparison = compare_with_reference(
      rerender, samples, golden.settings.seed, golden.image);
  const std::string broken = broken_outright(comparison.test);
  const double noise = variance_ratio(comparison.test, golden.image);
  const bool same = broken.empty() && comparison.same() && noise < max_noise;
  if (!same) {
    const std::string why =
        !broken.empty() ? broken
        : comparison.same()
            ? "golden image " + name +
                  ": it cannot be judged, its variance "
                  "is " +
                  (noise < 1e6 ? std::to_string(std::llround(noise))
                               : std::string("more than a million")) +
                  " times the golden's"
            : explain(stage, golden, comparison);
    FAIL_CHECK(why);
  }
  if (same && (noise > 1.5 || noise < 0.6)) {
    MESSAGE(name, ": correct on average; ", noise,
            " times the noise of the course's own program",
            std::string(noise > 1 ? "" : ": is roulette off?"));
  }
}

/// All goldens of a stage.
template <class PathTracer>
void check_goldens(int stage) {
  const std::vector<std::string> names = golden_names(stage);
  REQUIRE(names.size() >= 3);
  for (const std::string& name : names) {
    SUBCASE(name.c_str()) {
      check_golden<PathTracer>(stage, name);
    }
  }
}

}  // namespace lightwalk::tests
