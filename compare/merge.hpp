#pragma once

// # Parts of one picture
//
// Machines that share a picture render other samples of the same pixels, each
// with its own --first-sample. The mean and the variance of all samples follow
// from those of the parts (Chan, Golub, LeVeque: "Updating Formulae and a
// Pairwise Algorithm for Computing Sample Variances", 1979). The sums are in
// double precision; but a file holds floats, so each part is already rounded,
// and the last bit may be another than in a picture that was rendered at once.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/image/render_result.hpp"

namespace lightwalk {

/// A picture's part, and what to call it in an error.
struct Part {
  std::string name;
  RenderResult result;

  std::uint64_t first() const { return result.info.first_sample; }
  std::uint64_t count() const {
    return static_cast<std::uint64_t>(result.info.samples_per_pixel);
  }
};

/// Throws if a part is not one of the same picture as the first one.
inline void check_same_picture(const Part& first, const Part& part) {
  const auto& [a, b] = std::pair(first.result.info, part.result.info);
  const auto differ = [&](bool different, const char* what) {
    if (!different) return;
    throw std::runtime_error(part.name + " and " + first.name + " have " +
                             what + ", and are no parts of one picture");
  };
  differ(part.result.radiance.width != first.result.radiance.width ||
             part.result.radiance.height != first.result.radiance.height,
         "different sizes");
  differ(a.scene_hash != b.scene_hash, "different scenes");
  differ(a.seed != b.seed, "different seeds");
  differ(a.max_bounces != b.max_bounces, "different bounds of bounces");
}

inline void check_part(const Part& part) {
  const RenderResult& result = part.result;
  if (part.count() == 0 || result.variance.pixels.empty()) {
    throw std::runtime_error(part.name +
                             " does not say which samples it has");
  }
  if (result.info.dropped > 0) {
    throw std::runtime_error(
        part.name +
        " lacks samples that were not finite, and does not say "
        "in which pixels: it cannot be weighed");
  }
}

/// The picture that has the samples of all parts. Throws if they are not parts
/// of one, or if a sample is in none or in two of them.
inline RenderResult merged(std::vector<Part> parts) {
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return a.first() < b.first();
  });
  for (const Part& part : parts) {
    check_part(part);
    check_same_picture(parts.front(), part);
  }
  RenderResult whole = parts.front().result;
  std::vector<double> means, squares;  // as in Pixel
  const auto for_each_value = [&](auto use) {
    for (std::size_t i = 0; i < whole.radiance.pixels.size(); ++i) {
      for (int c = 0; c < 3; ++c)
        use(i, c, 3 * i + static_cast<std::size_t>(c));
    }
  };
  means.assign(3 * whole.radiance.pixels.size(), 0);
  squares = means;
  std::uint64_t samples = 0;
  whole.info.rays = 0;
  for (const Part& part : parts) {
    const std::uint64_t next = parts.front().first() + samples;
    if (part.first() != next) {
      throw std::runtime_error(
          "sample " + std::to_string(std::min(next, part.first())) +
          (part.first() < next ? " is in two parts: " : " is in no part: ") +
          part.name + " begins with sample " + std::to_string(part.first()));
    }
    const auto n = static_cast<double>(samples);
    const auto m = static_cast<double>(part.count());
    for_each_value([&](std::size_t i, int c, std::size_t at) {
      const double mean = part.result.radiance.pixels[i][c];
      const double difference = mean - means[at];
      squares[at] += part.result.variance.pixels[i][c] * (m - 1) +
                     difference * difference * n * m / (n + m);
      means[at] += difference * m / (n + m);
    });
    samples += part.count();
    whole.info.rays += part.result.info.rays;
  }
  for_each_value([&](std::size_t i, int c, std::size_t at) {
    whole.radiance.pixels[i][c] = static_cast<float>(means[at]);
    whole.variance.pixels[i][c] = static_cast<float>(
        samples < 2 ? 0 : squares[at] / static_cast<double>(samples - 1));
  });
  whole.info.samples_per_pixel = static_cast<double>(samples);
  return whole;
}

}  // namespace lightwalk
