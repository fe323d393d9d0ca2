#pragma once

#include <functional>
#include <string>

#include "common/render/render.hpp"
#include "common/scene_file/syllabus.hpp"

namespace lightwalk {

/// What a stage tells the shared program about itself.
struct Program {
  std::string name;         ///< "stage1"
  std::string description;  ///< one line for --help
  Syllabus syllabus;
  int default_bounces = bounce_cap;
  int most_bounces = bounce_cap;
  std::function<TileRenderer(const Scene&, const RenderSettings&)> renderer;
};

/// The renderer of a stage's path tracer.
template <class PathTracer>
TileRenderer tile_renderer(const Scene& scene,
                           const RenderSettings& settings) {
  return [&scene, seed = settings.seed, tracer = PathTracer(scene, settings)](
             const Tile& tile, Film& film, const std::atomic<bool>& stop) {
    render_tile(tracer, scene, seed, tile, film, stop);
  };
}

/// The stage that this program is. Each stage's main.cpp defines it.
Program this_program();

}  // namespace lightwalk
