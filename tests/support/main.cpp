#include <doctest/doctest.h>

int main(int argc, char** argv) {
  doctest::Context context;
  context.setOption("order-by", "suite");  // tests in no suite first
  context.applyCommandLine(argc, argv);
  return context.run();
}
