#pragma once

#include <cstdint>
#include <string>

#include "common/image/image.hpp"

namespace lightwalk {

/// Where a picture comes from. Image files carry it along.
struct RenderInfo {
  std::string stage;             ///< the program, such as "stage1"
  double samples_per_pixel = 0;  ///< of the pixel that has fewest
  std::uint64_t seed = 0;
  int max_bounces = 0;
  std::string scene_sha256;  ///< of the scene file
  std::uint64_t rays = 0;
  std::uint64_t dropped = 0;  ///< samples that were not finite
  std::string version;
};

/// Mean radiance, the variance of one sample, and where both come from. The
/// variance is empty for a picture that was stored without.
struct RenderResult {
  Image radiance;
  Image variance;
  RenderInfo info;
  /// What its reader should say about a file that left a choice.
  std::string note = {};
};

}  // namespace lightwalk
