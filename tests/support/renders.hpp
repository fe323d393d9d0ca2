#pragma once

// Scenes and renders for tests, without files and command lines.

#include <cmath>
#include <string>
#include <string_view>

#include "common/image/render_result.hpp"
#include "common/render/film.hpp"
#include "common/render/paint.hpp"
#include "common/scene_file/loaded_scene.hpp"
#include "support/printing.hpp"

namespace lightwalk::tests {

/// A scene from the folder scenes/, at another size.
Scene scene_file(const std::string& name, int width = 32, int height = 32);

/// The same with all information of its file, at its own size.
LoadedScene load_scene_for_tests(const std::string& name);

/// The scene of a TOML text. Adds a camera if the text has none.
Scene scene_text(std::string_view text);

/// The statistics of `samples` samples of one ray.
template <class PathTracer>
Pixel estimate(const PathTracer& tracer, const Ray& ray, int samples,
               std::uint64_t seed = 1) {
  Pixel pixel;
  for (int i = 0; i < samples; ++i) {
    Random random(seed, 0, static_cast<std::uint64_t>(i));
    pixel.add(tracer.radiance(ray, random));
  }
  return pixel;
}

/// The first channel.
inline double red(const Vec3& color) {
  return static_cast<double>(color.x);
}

/// How far an estimate is from the truth, in its own standard deviations.
inline double deviations(const Pixel& pixel, int channel, double truth) {
  const double sigma = std::sqrt(pixel.variance(channel) / pixel.samples);
  return std::abs(pixel.mean[channel] - truth) / sigma;
}

}  // namespace lightwalk::tests
