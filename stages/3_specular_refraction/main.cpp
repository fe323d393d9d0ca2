#include "common/program/run.hpp"
#include "stages/3_specular_refraction/path_tracer.hpp"
#include "stages/introductions.hpp"

int main(int argc, char** argv) {
  return lightwalk::run<lightwalk::stage3::PathTracer>(
      argc, argv,
      {.name = "stage3",
       .description = "Path tracing, stage 3: perfect mirrors and glass",
       .syllabus = lightwalk::syllabus(3),
       .default_bounces = 8,
       .bounce_limit = lightwalk::stage3::bounce_limit});
}
