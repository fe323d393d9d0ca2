#include "stage6/many_paths.hpp"

#include "stages/6_many_paths/path_tracer.hpp"

namespace lightwalk::tests {

ManyPaths::ManyPaths(const Scene& scene, const RenderSettings& settings)
    : tile_(tile_renderer<stage6::PathTracer>(scene, settings)) {
  const auto tracer =
      std::make_shared<const stage6::PathTracer>(scene, settings);
  one_ = [tracer](const Ray& ray, Random& random) {
    return tracer->radiance(ray, random);
  };
}

int paths_at_once() {
  return stage6::paths_at_once;
}

}  // namespace lightwalk::tests
