#pragma once

// What the `main` of every stage calls. The rest of the program is compiled
// once, in run.cpp, and knows no path tracer: it gets two functions to call.

#include <atomic>

#include "common/program/options.hpp"
#include "common/render/paint.hpp"

namespace lightwalk {

/// What the program calls of a path tracer.
struct PathTracerCalls {
  RenderResult (*paint)(Scene&, const RenderSettings&,
                        const std::atomic<bool>& stop, RenderProgress&);
  Vec3 (*sample)(const Scene&, const RenderSettings&, const PixelSample&);
};

/// Runs a stage: reads the command line and the scene, paints, and writes the
/// images. Returns the exit code: 0 done, 1 could not, 2 wrong usage, 130
/// interrupted.
int run(int argc, char** argv, const Program& program,
        const PathTracerCalls& tracing);

/// The same, with a path tracer of the caller's, and one that logs a single
/// path.
template <class PathTracer, class SinglePathTracer = PathTracer>
int run(int argc, char** argv, const Program& program) {
  return run(argc, argv, program,
             {.paint = paint<PathTracer>,
              .sample = [](const Scene& scene, const RenderSettings& settings,
                           const PixelSample& which) {
                return sample_radiance(SinglePathTracer(scene, settings),
                                       scene, settings.seed, which);
              }});
}

}  // namespace lightwalk
