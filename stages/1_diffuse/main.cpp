#include "common/program/program.hpp"
#include "stages/1_diffuse/path_tracer.hpp"
#include "stages/introductions.hpp"

lightwalk::Program lightwalk::this_program() {
  Program program;
  program.name = "stage1";
  program.description = "Path tracing, stage 1: diffuse surfaces";
  program.syllabus = syllabus(1);
  program.default_bounces = 8;
  program.renderer = tile_renderer<stage1::PathTracer>;
  return program;
}
