#pragma once

// Stage 6's path tracer as the shared tests want one. Its code is compiled
// once, in many_paths.cpp: that takes as long as all else here.

#include <memory>

#include "common/render/paint.hpp"

namespace lightwalk::tests {

class ManyPaths {
 public:
  ManyPaths(const Scene& scene, const RenderSettings& settings);

  Vec3 radiance(const Ray& ray, Random& random) const {
    return one_(ray, random);
  }
  void render_tile(const Tile& tile, Film& film,
                   const std::atomic<bool>& stop) const {
    tile_(tile, film, stop);
  }

 private:
  std::function<Vec3(const Ray&, Random&)> one_;
  TileRenderer tile_;
};

/// How many paths go at once where these tests run.
int paths_at_once();

}  // namespace lightwalk::tests
