// The one `main` of all stages: see common/program/run.hpp.

#include "common/program/instruction_sets.hpp"
#include "common/program/run.hpp"

int main(int argc, char** argv) {
  lightwalk::run_variant_for_this_processor(argv);
  return lightwalk::run(argc, argv, lightwalk::this_program());
}
