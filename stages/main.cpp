// The one `main` of all stages: see common/application.hpp.

#include "common/application.hpp"

int main(int argc, char** argv) {
  return lightwalk::run(argc, argv, lightwalk::this_program());
}
