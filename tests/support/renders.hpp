#pragma once

// Scenes and renders for tests, without files and command lines.

#include <atomic>
#include <string>
#include <string_view>

#include "common/image/render_result.hpp"
#include "common/program/program.hpp"
#include "common/render/film.hpp"
#include "common/scene_file/loaded_scene.hpp"

namespace lightwalk::tests {

/// The scene of a file of the folder scenes/, at another size.
Scene scene_file(const std::string& name, int width = 32, int height = 32);

/// The same with all that its file says, at its own size.
LoadedScene load_scene_for_tests(const std::string& name);

/// The scene of a TOML text. A camera is put before it if it has none.
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

/// A whole picture by all threads of the machine.
template <class PathTracer>
RenderResult render_scene(const Scene& scene, const RenderSettings& settings,
                          int threads = 0) {
  Film film(scene.camera.width, scene.camera.height);
  const std::atomic<bool> stop{false};
  RenderProgress progress;
  render(tile_renderer<PathTracer>(scene, settings),
         settings.samples_per_pixel, threads, film, stop, progress);
  RenderResult result{film.radiance(), film.variance(), {}};
  result.info.samples_per_pixel = settings.samples_per_pixel;
  result.info.seed = settings.seed;
  result.info.max_bounces = settings.max_bounces;
  result.info.rays = progress.rays;
  for (const Pixel& pixel : film.pixels()) {
    result.info.dropped += pixel.dropped;
  }
  return result;
}

/// How far an estimate is from the truth, in its own standard deviations.
inline double deviations(const Pixel& pixel, int channel, double truth) {
  const double sigma = std::sqrt(pixel.variance(channel) / pixel.samples);
  return std::abs(pixel.mean[channel] - truth) / sigma;
}

}  // namespace lightwalk::tests
