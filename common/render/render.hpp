#pragma once

// # Rendering a picture
//
// The picture is cut into tiles, and each thread takes the next tile from a
// counter until none is left. A sample's random numbers depend on the pixel
// and the sample alone, and a pixel's samples are added in order by whichever
// thread has its tile: so any number of threads gives the same bits.
//
// The samples are taken in passes over the whole picture, so that a render
// that is interrupted leaves a whole picture with fewer samples behind. A
// pixel has all samples of a pass or none, so that it does not matter which
// samples take long.
//
// An exception of a path tracer ends the render. `render` throws it again,
// whichever thread met it.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

#include "common/geometry/inlining.hpp"
#include "common/math/random.hpp"
#include "common/render/film.hpp"
#include "common/render/render_progress.hpp"
#include "common/render/render_settings.hpp"
#include "common/scene/scene.hpp"

namespace lightwalk {

/// Pixels [left, right) x [top, bottom), samples [first, last) of each.
struct Tile {
  int left, right, top, bottom;
  std::uint32_t first, last;
};

/// Adds a tile's samples to the film, and stops early where `stop` is set.
using TileRenderer =
    std::function<void(const Tile&, Film&, const std::atomic<bool>& stop)>;

/// The radiance of one sample of a pixel, W/(m^2 sr).
template <class PathTracer>
Vec3 sample_radiance(const PathTracer& tracer, const Scene& scene,
                     std::uint64_t seed, const PixelSample& which) {
  const auto [column, row, sample] = which;
  Random random(seed, pixel_index(scene.camera.width, column, row), sample);
  const Ray ray = scene.camera.ray(column, row, random.uniform_2d());
  return tracer.radiance(ray, random);
}

// #region render-tile
/// Renders one tile with a stage's path tracer, whose function
/// `radiance(ray, random)` returns the light that comes back along a ray.
template <class PathTracer>
LIGHTWALK_FLATTEN void render_tile(const PathTracer& tracer,
                                   const Scene& scene, std::uint64_t seed,
                                   const Tile& tile, Film& film,
                                   const std::atomic<bool>& stop) {
  for (int row = tile.top; row < tile.bottom; ++row) {
    for (int column = tile.left; column < tile.right; ++column) {
      Pixel pixel = film.pixel(column, row);
      for (std::uint32_t sample = tile.first; sample < tile.last; ++sample) {
        pixel.add(
            sample_radiance(tracer, scene, seed, {column, row, sample}));
        ++samples_taken;
      }
      // If the render is stopped, the last sample may be incomplete.
      if (stop.load(std::memory_order_relaxed)) return;
      film.pixel(column, row) = pixel;
    }
  }
}
// #endregion render-tile

inline constexpr int tile_size = 16;
inline constexpr std::uint32_t max_samples_in_a_pass = 64;

/// Calls `work(0)` to `work(count - 1)`, each once, from several threads.
/// Ends early where `stop` is set. Throws the first exception of a thread.
template <class Work>
void share_out(std::int64_t count, int threads, const std::atomic<bool>& stop,
               RenderProgress& progress, const Work& work) {
  std::atomic<std::int64_t> next{0};
  FirstException errors;
  const auto take_part = [&] {
    RenderThread thread(stop, errors, progress);
    try {
      for (std::int64_t i = next++; i < count && !thread.is_over();
           i = next++) {
        work(i);
        thread.publish();
      }
    } catch (const Stopped&) {
      // Only the sample is lost.
    } catch (...) {
      errors.keep();
    }
  };
  std::vector<std::thread> helpers;
  const std::int64_t useful = std::min<std::int64_t>(threads, count);
  try {
    helpers.reserve(static_cast<std::size_t>(useful));
    for (std::int64_t i = 1; i < useful; ++i) helpers.emplace_back(take_part);
  } catch (const std::exception&) {
    // The system gives no more threads: the ones that run do the work.
  }
  take_part();
  for (std::thread& helper : helpers) helper.join();
  errors.rethrow();
}

/// Renders every tile of one pass. Throws the first exception of a thread.
inline void render_pass(const TileRenderer& render_tile, Film& film,
                        std::uint32_t first, std::uint32_t last, int threads,
                        const std::atomic<bool>& stop,
                        RenderProgress& progress) {
  const int columns = (film.width() + tile_size - 1) / tile_size;
  const int rows = (film.height() + tile_size - 1) / tile_size;
  share_out(std::int64_t{columns} * rows, threads, stop, progress,
            [&](std::int64_t i) {
              Tile tile{static_cast<int>(i % columns) * tile_size,
                        0,
                        static_cast<int>(i / columns) * tile_size,
                        0,
                        first,
                        last};
              tile.right = std::min(tile.left + tile_size, film.width());
              tile.bottom = std::min(tile.top + tile_size, film.height());
              render_tile(tile, film, stop);
            });
}

/// How many threads `threads` stands for: 0 is as many as the machine has.
inline int thread_count(int threads) {
  if (threads > 0) return threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Renders all samples of the picture, or as many as come before `stop`.
/// Throws what the path tracer throws.
inline void render(const TileRenderer& render_tile,
                   const RenderSettings& settings, Film& film,
                   const std::atomic<bool>& stop, RenderProgress& progress) {
  const int threads = thread_count(settings.threads);
  const auto samples = static_cast<std::uint32_t>(settings.samples_per_pixel);
  std::uint32_t done = 0;
  while (done < samples && !stop) {
    // As many as are done already, so the first picture is there at once.
    const std::uint32_t more = std::clamp(done, 1u, max_samples_in_a_pass);
    const std::uint32_t last = done + std::min(more, samples - done);
    const std::uint32_t first = settings.first_sample;
    render_pass(render_tile, film, first + done, first + last, threads, stop,
                progress);
    done = last;
  }
}

}  // namespace lightwalk
