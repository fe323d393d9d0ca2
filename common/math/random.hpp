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
// same mixing makes the key, so neighboring pixels start far apart: the hash
// of one number is added to the next number, and the sum is hashed again. For
// such nested hashes see Jarzynski and Olano, "Hash Functions for GPU
// Rendering" (JCGT 9(3), 2020). No theorem says that sequences with different
// keys are independent: tests/core/test_random.cpp tests it for neighbors.
//
// The standard library's distributions are not used: each library implements
// them in its own way, so the same seed would paint different pictures.

#include <cstdint>

#include "common/math/vector.hpp"

namespace lightwalk {

/// Uniform random numbers of one sample of one pixel.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample)
      : state_(key(seed, pixel, sample)) {}
  /// Continues a sequence from its `state()`.
  explicit Random(std::uint64_t state) : state_(state) {}
  std::uint64_t state() const { return state_; }

  /// Uniform in [0, 1): a multiple of 2^-24, never 1.
  float uniform() { return to_float(next() >> 40); }

  /// Two independent numbers, each uniform in [0, 1).
  Vec2 uniform_2d() {
    const std::uint64_t bits = next();
    const float x = to_float(bits >> 40);
    const float y = to_float((bits >> 16) & 0xffffff);
    return {x, y};
  }

  // `Bits` is a std::uint64_t, or a row of them: see stage 6.

  static constexpr std::uint64_t step = 0x9e3779b97f4a7c15;

  template <class Bits>
  static constexpr Bits mix(Bits z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }

  /// The state in which a sample's sequence begins.
  template <class Bits>
  static constexpr Bits key(std::uint64_t seed, const Bits& pixel,
                            const Bits& sample) {
    return mix<Bits>(mix<Bits>(mix(seed + step) + pixel) + sample);
  }

 private:
  std::uint64_t next() { return mix(state_ += step); }

  static float to_float(std::uint64_t bits24) {
    return static_cast<float>(static_cast<std::int32_t>(bits24)) * 0x1p-24f;
  }

  std::uint64_t state_;
};

}  // namespace lightwalk
