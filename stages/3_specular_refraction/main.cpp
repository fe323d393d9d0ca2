#include "common/program/program.hpp"
#include "stages/3_specular_refraction/path_tracer.hpp"
#include "stages/introductions.hpp"

lightwalk::Program lightwalk::this_program() {
  Program program;
  program.name = "stage3";
  program.description = "Path tracing, stage 3: perfect mirrors and glass";
  program.syllabus = syllabus(3);
  program.default_bounces = 8;
  program.most_bounces = stage3::most_bounces;
  program.renderer = tile_renderer<stage3::PathTracer>;
  return program;
}
