#include "common/program/run.hpp"
#include "stages/2_next_event/path_tracer.hpp"
#include "stages/introductions.hpp"

int main(int argc, char** argv) {
  return lightwalk::run<lightwalk::stage2::PathTracer>(
      argc, argv,
      {.name = "stage2",
       .description = "Path tracing, stage 2: next-event estimation",
       .syllabus = lightwalk::syllabus(2),
       .default_bounces = 8});
}
