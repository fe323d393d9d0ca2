#include "common/program/run.hpp"
#include "stages/1_diffuse/path_tracer.hpp"
#include "stages/introductions.hpp"

int main(int argc, char** argv) {
  return lightwalk::run<lightwalk::stage1::PathTracer>(
      argc, argv,
      {.name = "stage1",
       .description = "Path tracing, stage 1: diffuse surfaces",
       .syllabus = lightwalk::syllabus(1),
       .default_bounces = 8});
}
