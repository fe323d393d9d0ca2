#pragma once

// # Random numbers
//
// A picture must not depend on how many threads made it, nor on which of them
// took which tile. So there is no generator that the threads share or that
// runs on from pixel to pixel: each sample of each pixel has a sequence of
// its own, and its key (seed, pixel, sample) says where that sequence starts.
//
// Behind it is SplitMix64 (Steele, Lea, Flood: "Fast Splittable Pseudorandom
// Number Generators", OOPSLA 2014): a counter that grows by an odd constant,
// and a function that mixes the counter's bits until they look random. The
// same mixing makes the key, so neighbouring pixels start far apart.
//
// The standard library's distributions are not used: each library implements
// them as it likes, and the same seed would paint different pictures.

#include <cstdint>

#include "common/math/vector.hpp"

namespace lightwalk {

/// Uniform random numbers of one sample of one pixel.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample)
      : state_(mix(mix(mix(seed + step) + pixel) + sample)) {}

  /// Uniform in [0, 1): a multiple of 2^-24, never 1.
  float uniform() { return to_float(next() >> 40); }

  /// Two independent numbers, each uniform in [0, 1).
  Vec2 uniform_2d() {
    const std::uint64_t bits = next();
    const float x = to_float(bits >> 40);
    const float y = to_float((bits >> 16) & 0xffffff);
    return {x, y};
  }

 private:
  static constexpr std::uint64_t step = 0x9e3779b97f4a7c15;

  static constexpr std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  std::uint64_t next() { return mix(state_ += step); }

  static float to_float(std::uint64_t bits24) {
    return static_cast<float>(static_cast<std::int32_t>(bits24)) * 0x1p-24f;
  }

  std::uint64_t state_;
};

}  // namespace lightwalk
