#pragma once

// # A picture in one call
//
// A path tracer is a class that is made from a scene and settings and has a
// function `radiance(ray, random)`. That is all that a picture needs:
//
//     const RenderResult picture = paint<stage4::PathTracer>(scene, {});
//
// examples/paint.cpp is a whole program around this line.

#include <atomic>

#include "common/image/render_result.hpp"
#include "common/render/film.hpp"
#include "common/render/render.hpp"
#include "common/render/render_settings.hpp"
#include "common/scene/scene.hpp"

namespace lightwalk {

/// A path tracer that renders whole tiles, not sample after sample.
template <class PathTracer>
concept RendersTiles = requires(const PathTracer& tracer, const Tile& tile,
                                Film& film, const std::atomic<bool>& stop) {
  tracer.render_tile(tile, film, stop);
};

/// A path tracer that renders whole pictures: what it does for one pixel
/// helps the others.
template <class PathTracer>
concept RendersPictures = requires(const Scene& scene,
                                   const RenderSettings& settings, Film& film,
                                   const std::atomic<bool>& stop,
                                   RenderProgress& progress) {
  PathTracer::render(scene, settings, film, stop, progress);
};

/// A function that renders tiles with its own path tracer. The scene must
/// outlive it.
template <class PathTracer>
TileRenderer tile_renderer(const Scene& scene,
                           const RenderSettings& settings) {
  if constexpr (RendersTiles<PathTracer>) {
    return [tracer = PathTracer(scene, settings)](
               const Tile& tile, Film& film, const std::atomic<bool>& stop) {
      tracer.render_tile(tile, film, stop);
    };
  } else {
    return
        [&scene, seed = settings.seed, tracer = PathTracer(scene, settings)](
            const Tile& tile, Film& film, const std::atomic<bool>& stop) {
          render_tile(tracer, scene, seed, tile, film, stop);
        };
  }
}

/// The picture of a scene, which it prepares first. Ends early, with fewer
/// samples, if `stop` is set; other threads may read `progress` meanwhile.
/// Throws what the path tracer throws.
template <class PathTracer>
RenderResult paint(Scene& scene, const RenderSettings& settings,
                   const std::atomic<bool>& stop, RenderProgress& progress) {
  scene.prepare();
  Film film(scene.camera.width, scene.camera.height);
  if constexpr (RendersPictures<PathTracer>) {
    PathTracer::render(scene, settings, film, stop, progress);
  } else {
    render(tile_renderer<PathTracer>(scene, settings), settings, film, stop,
           progress);
  }
  return develop(film, {.first_sample = settings.first_sample,
                        .seed = settings.seed,
                        .max_bounces = settings.max_bounces,
                        .rays = progress.rays});
}

/// The same, always to the end.
template <class PathTracer>
RenderResult paint(Scene& scene, const RenderSettings& settings) {
  const std::atomic<bool> stop{false};
  RenderProgress progress;
  return paint<PathTracer>(scene, settings, stop, progress);
}

}  // namespace lightwalk
