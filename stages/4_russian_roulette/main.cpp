#include "common/program/run.hpp"
#include "stages/4_russian_roulette/path_tracer.hpp"
#include "stages/introductions.hpp"

int main(int argc, char** argv) {
  return lightwalk::run<lightwalk::stage4::PathTracer>(
      argc, argv,
      {.name = "stage4",
       .description = "Path tracing, stage 4: Russian roulette",
       .syllabus = lightwalk::syllabus(4)});
}
