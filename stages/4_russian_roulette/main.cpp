#include "common/program/program.hpp"
#include "stages/4_russian_roulette/path_tracer.hpp"
#include "stages/introductions.hpp"

lightwalk::Program lightwalk::this_program() {
  Program program;
  program.name = "stage4";
  program.description = "Path tracing, stage 4: Russian roulette";
  program.syllabus = syllabus(4);
  program.renderer = tile_renderer<stage4::PathTracer>;
  return program;
}
