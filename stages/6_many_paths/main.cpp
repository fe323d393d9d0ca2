#include "common/program/instruction_set.hpp"
#include "common/program/run.hpp"
#include "stages/5_fresnel_textures/path_tracer.hpp"
#include "stages/6_many_paths/path_tracer.hpp"
#include "stages/introductions.hpp"

int main(int argc, char** argv) {
  using namespace lightwalk;
  const std::string set = instruction_set;
  const std::string paths = std::to_string(stage6::paths_at_once);
  // Stage 5 follows and prints a single path: it takes the same way.
  return run<stage6::PathTracer, stage5::PathTracer>(
      argc, argv,
      {.name = "stage6",
       .description = "Path tracing, stage 6: many paths at once",
       .mode = stage6::paths_at_once > 1
                   ? set + ": " + paths + " paths at once"
                   : set + ": one path at a time, by stage 5",
       .syllabus = syllabus(6)});
}
