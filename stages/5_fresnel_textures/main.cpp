#include "common/program/program.hpp"
#include "stages/5_fresnel_textures/path_tracer.hpp"
#include "stages/introductions.hpp"

lightwalk::Program lightwalk::this_program() {
  Program program;
  program.name = "stage5";
  program.description = "Path tracing, stage 5: Fresnel and textures";
  program.syllabus = syllabus(5);
  program.renderer = tile_renderer<stage5::PathTracer>;
  return program;
}
