#include "common/program/run.hpp"
#include "stages/5_fresnel_textures/path_tracer.hpp"
#include "stages/introductions.hpp"

int main(int argc, char** argv) {
  return lightwalk::run<lightwalk::stage5::PathTracer>(
      argc, argv,
      {.name = "stage5",
       .description = "Path tracing, stage 5: Fresnel and textures",
       .syllabus = lightwalk::syllabus(5)});
}
