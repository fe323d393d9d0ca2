#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
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

/// Where a picture comes from. Image files store what `texts_of` lists.
struct RenderInfo {
  std::string stage = {};          ///< the program, such as "stage1"
  double samples_per_pixel = 0;    ///< of the pixel that has fewest
  std::uint32_t first_sample = 0;  ///< of each pixel
  std::uint64_t seed = 0;
  int max_bounces = 0;
  std::string scene_hash = {};  ///< of the scene file
  std::uint64_t rays = 0;
  std::uint64_t dropped = 0;  ///< samples that were not finite
  std::string version = {};
  std::uint64_t samples = 0;  ///< of all pixels together
  std::optional<PixelSample> first_dropped = {};
};

/// Mean radiance, the variance of one sample, and where both come from. The
/// variance is empty for a picture that was stored without. That of a pixel's
/// mean is `variance` over the pixel's samples.
struct RenderResult {
  Image radiance;  ///< W/(m^2 sr)
  Image variance;  ///< (W/(m^2 sr))^2
  RenderInfo info;
  /// What a program should say about a file that leaves something open.
  std::string note = {};
};

/// What image files say of a render: names, and numbers as text, since many
/// formats have only 32 bits for a whole number.
using InfoTexts = std::map<std::string, std::string>;

inline InfoTexts texts_of(const RenderInfo& info) {
  const auto samples = static_cast<std::uint64_t>(info.samples_per_pixel);
  return {{"samples_per_pixel", std::to_string(samples)},
          {"first_sample", std::to_string(info.first_sample)},
          {"seed", std::to_string(info.seed)},
          {"max_bounces", std::to_string(info.max_bounces)},
          {"scene_hash", info.scene_hash},
          {"rays", std::to_string(info.rays)},
          {"dropped", std::to_string(info.dropped)}};
}

inline RenderInfo info_of(const InfoTexts& texts) {
  const auto text = [&](const char* name) {
    const auto found = texts.find(name);
    return found == texts.end() ? std::string() : found->second;
  };
  const auto number = [&](const char* name,
                          std::uint64_t most = ~std::uint64_t{0}) {
    return std::min<std::uint64_t>(
        std::strtoull(text(name).c_str(), nullptr, 10), most);
  };
  RenderInfo info;
  info.samples_per_pixel =  // a PixelSample's are counted with 32 bits
      static_cast<double>(number("samples_per_pixel", 0xffffffff));
  info.first_sample =
      static_cast<std::uint32_t>(number("first_sample", 0xffffffff));
  info.seed = number("seed");
  info.max_bounces = static_cast<int>(number("max_bounces", 0x7fffffff));
  info.scene_hash = text("scene_hash");
  info.rays = number("rays");
  info.dropped = number("dropped");
  return info;
}

}  // namespace lightwalk
