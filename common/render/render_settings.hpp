#pragma once

#include <cstdint>
#include <limits>

namespace lightwalk {

/// How directions over a diffuse surface are drawn.
enum class Sampling { cosine, uniform };

/// How much of a photon counts, by its distance: less and less, or alike.
enum class Filter { cone, box };

/// No path has more bounces than this, whatever the settings allow.
inline constexpr int bounce_cap = 4096;

/// What a render is made with, besides its scene. The camera has the size of
/// the picture.
struct RenderSettings {
  int samples_per_pixel = 64;
  std::uint32_t first_sample = 0;  ///< others are rendered elsewhere
  int max_bounces = bounce_cap;
  std::uint64_t seed = 1;
  Sampling sampling = Sampling::cosine;
  int threads = 0;  ///< 0: as many as the machine has; changes no bit

  // Of a stage that follows light from the lamps.
  int photons =
      100'000;         ///< that leave the lamps, for each sample of a pixel
  int neighbors = 50;  ///< photons that a surface looks for
  Filter filter = Filter::cone;
  float radius = std::numeric_limits<float>::infinity();  ///< not beyond it
};

}  // namespace lightwalk
