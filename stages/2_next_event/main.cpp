#include "common/program/program.hpp"
#include "stages/2_next_event/path_tracer.hpp"
#include "stages/introductions.hpp"

lightwalk::Program lightwalk::this_program() {
  Program program;
  program.name = "stage2";
  program.description = "Path tracing, stage 2: next-event estimation";
  program.syllabus = syllabus(2);
  program.default_bounces = 8;
  program.renderer = tile_renderer<stage2::PathTracer>;
  return program;
}
