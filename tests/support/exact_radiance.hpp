#pragma once

// # Scenes whose radiance can be written down
//
// Every stage that can render these few scenes is tested with them. A right
// program may sample in its own way, so only the mean counts, and single
// samples may differ. Where all samples are right, a few are enough.

#include <doctest/doctest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "support/expectations.hpp"
#include "support/renders.hpp"

namespace lightwalk::tests {

// Pieces of scene files. Vectors are written as "0, 1, 0".
namespace text {

inline std::string plane(const std::string& normal,
                         const std::string& distance,
                         const std::string& material) {
  return "[[shapes]]\ntype = \"plane\"\nnormal = [" + normal +
         "]\ndistance = " + distance + "\nmaterial = \"" + material + "\"\n";
}

inline std::string sphere(const std::string& center,
                          const std::string& radius,
                          const std::string& material) {
  return "[[shapes]]\ntype = \"sphere\"\ncenter = [" + center +
         "]\nradius = " + radius + "\nmaterial = \"" + material + "\"\n";
}

/// If it emits light, then on the side of edge_u x edge_v.
inline std::string rectangle(const std::string& corner,
                             const std::string& edge_u,
                             const std::string& edge_v,
                             const std::string& material) {
  return "[[shapes]]\ntype = \"rectangle\"\ncorner = [" + corner +
         "]\nedge_u = [" + edge_u + "]\nedge_v = [" + edge_v +
         "]\nmaterial = \"" + material + "\"\n";
}

inline std::string point_light(const std::string& center,
                               const std::string& intensity) {
  return "[[lights]]\ntype = \"point\"\ncenter = [" + center +
         "]\nintensity = " + intensity + "\n";
}

}  // namespace text

inline RenderSettings with_bounces(int max_bounces,
                                   Sampling sampling = Sampling::cosine) {
  RenderSettings settings;
  settings.max_bounces = max_bounces;
  settings.sampling = sampling;
  return settings;
}

/// More than rounding may change a radiance, as a relative error.
inline constexpr double radiance_rounding = 1e-4;

/// This few samples are enough if each of them is right.
inline constexpr int few_samples = 64;

/// What is wrong with a mean in one channel, or nothing.
inline std::string wrong_mean(const Pixel& pixel,
                              const DoubleVec3& expected) {
  for (int c = 0; c < 3; ++c) {
    const double sigma = std::sqrt(pixel.variance(c) / pixel.samples);
    const double off = std::abs(pixel.mean[c] - expected[c]);
    if (off <= 4.4 * sigma + radiance_rounding * std::abs(expected[c])) {
      continue;
    }
    std::ostringstream says;
    says << "channel " << c << ": mean " << pixel.mean[c] << " +- " << sigma
         << ", expected " << expected[c];
    if (expected[c] != 0) {
      says << ": "
           << factor_in_words(pixel.mean[c] / expected[c],
                              sigma / std::abs(expected[c]));
    }
    return says.str();
  }
  return "";
}

/// The mean radiance along a ray must be `expected`. Takes `samples` samples,
/// or only a few if all of these are right. `variance`, if it is given, is that
/// of one sample of the course's own program; more is reported, but no error.
template <class PathTracer>
void check_radiance(const std::string& what, const Scene& scene,
                    const Ray& ray, const RenderSettings& settings,
                    const DoubleVec3& expected, int samples = 20'000,
                    double variance = 0) {
  const PathTracer tracer(scene, settings);
  Pixel pixel = estimate(tracer, ray, few_samples);
  bool all_right = pixel.dropped == 0;
  for (int c = 0; c < 3; ++c) {
    const double rounding = radiance_rounding * std::abs(expected[c]);
    all_right = all_right &&
                std::abs(pixel.mean[c] - expected[c]) <= rounding &&
                std::sqrt(pixel.variance(c)) <= rounding;
  }
  if (!all_right) pixel = estimate(tracer, ray, samples);
  INFO(what, ", at most ", bounces_in_words(settings.max_bounces), ", ",
       std::string(settings.sampling == Sampling::uniform ? "uniform"
                                                          : "cosine"),
       " sampling");
  CHECK_MESSAGE(pixel.dropped == 0, pixel.dropped,
                " samples are infinite or not a number");
  const std::string wrong = wrong_mean(pixel, expected);
  if (!wrong.empty()) FAIL_CHECK(wrong);
  if (!wrong.empty() || variance == 0) return;
  const double noise = pixel.variance(0) / variance;
  if (noise > 1.5) {
    MESSAGE(what, ": correct on average; ", noise,
            " times the noise of the course's own program");
  }
}

}  // namespace lightwalk::tests
