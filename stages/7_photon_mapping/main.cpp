#include <future>

#include "common/program/run.hpp"
#include "stages/7_photon_mapping/path_tracer.hpp"
#include "stages/introductions.hpp"

int main(int argc, char** argv) {
  using namespace lightwalk;
  using stage7::PathTracer;
  // The photons of a single sample are traced by another thread: --pixel
  // logs the rays of this one.
  const auto sample = [](const Scene& scene, const RenderSettings& settings,
                         const PixelSample& which) {
    const auto prepare = [&] {
      return PathTracer(scene, settings, which.sample);
    };
    const PathTracer tracer = std::async(std::launch::async, prepare).get();
    return sample_radiance(tracer, scene, settings.seed, which);
  };
  return run(argc, argv,
             {.name = "stage7",
              .description = "Path tracing, stage 7: photon mapping",
              .syllabus = syllabus(7),
              .has_photons = true},
             {.paint = paint<PathTracer>, .sample = sample});
}
