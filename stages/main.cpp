// The one `main` of all stages: see common/application.hpp.

#include "common/application.hpp"
#include "common/instruction_sets.hpp"

int main(int argc, char** argv) {
  lightwalk::run_variant_for_this_processor(argv);
  return lightwalk::run(argc, argv, lightwalk::this_program());
}
