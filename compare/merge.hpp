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
#include <utility>
#include <vector>

#include "common/image/render_result.hpp"
#include "common/render/film.hpp"

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
  const RenderResult &a = first.result, &b = part.result;
  const auto differ = [&](bool different, const char* what) {
    if (!different) return;
    throw std::runtime_error(part.name + " and " + first.name + " have " +
                             what + ", and are no parts of one picture");
  };
  differ(a.radiance.width != b.radiance.width ||
             a.radiance.height != b.radiance.height,
         "different sizes");
  differ(a.info.scene_hash != b.info.scene_hash, "different scenes");
  differ(a.info.seed != b.info.seed, "different seeds");
  differ(a.info.max_bounces != b.info.max_bounces,
         "different bounds of bounces");
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
        " lacks samples that were not finite, and does not say in which "
        "pixels: it cannot be weighed");
  }
}

/// Throws if a part does not begin with the sample `next`.
inline void check_follows(const Part& part, std::uint64_t next) {
  if (part.first() == next) return;
  throw std::runtime_error(
      "sample " + std::to_string(std::min(next, part.first())) +
      (part.first() < next ? " is in two parts: " : " is in no part: ") +
      part.name + " begins with sample " + std::to_string(part.first()));
}

/// Adds `count` samples to a pixel, of which the mean and the variance are
/// known.
inline void add_samples(Pixel& pixel, const Vec3& mean, const Vec3& variance,
                        std::uint64_t count) {
  const double n = pixel.samples;
  const auto m = static_cast<double>(count);
  for (int c = 0; c < 3; ++c) {
    const double difference = mean[c] - pixel.mean[c];
    pixel.squares[c] +=
        variance[c] * (m - 1) + difference * difference * n * m / (n + m);
    pixel.mean[c] += difference * m / (n + m);
  }
  pixel.samples += static_cast<std::uint32_t>(count);
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
  RenderInfo info = parts.front().result.info;
  std::uint64_t next = parts.front().first();
  Film film(parts.front().result.radiance.width,
            parts.front().result.radiance.height);
  info.rays = 0;
  for (const Part& part : parts) {
    check_follows(part, next);
    const RenderResult& result = part.result;
    for (int row = 0; row < film.height(); ++row) {
      for (int column = 0; column < film.width(); ++column) {
        const std::size_t i = film.index(column, row);
        add_samples(film.pixel(column, row), result.radiance.pixels[i],
                    result.variance.pixels[i], part.count());
      }
    }
    next += part.count();
    info.rays += part.result.info.rays;
  }
  return develop(film, std::move(info));
}

}  // namespace lightwalk
