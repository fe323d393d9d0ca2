#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/image/image.hpp"

namespace lightwalk {

/// One sample of one pixel: everything random about it follows from this and
/// the seed.
struct PixelSample {
  int column = 0, row = 0;
  std::uint32_t sample = 0;  ///< the first is 0
};

/// Where a picture comes from. Image files carry it along, but for what is
/// said not to be in files.
struct RenderInfo {
  std::string stage = {};        ///< the program, such as "stage1"
  double samples_per_pixel = 0;  ///< of the pixel that has fewest
  std::uint64_t seed = 0;
  int max_bounces = 0;
  std::string scene_sha256 = {};  ///< of the scene file
  std::uint64_t rays = 0;
  std::uint64_t dropped = 0;  ///< samples that were not finite
  std::string version = {};
  std::uint64_t samples = 0;  ///< of all pixels together; not in files
  std::optional<PixelSample> first_dropped = {};  ///< not in files
};

/// Mean radiance, the variance of one sample, and where both come from. The
/// variance is empty for a picture that was stored without.
struct RenderResult {
  Image radiance;
  Image variance;
  RenderInfo info;
};

}  // namespace lightwalk
