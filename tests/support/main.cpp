#include <doctest/doctest.h>

int main(int argc, char** argv) {
  doctest::Context context;
  context.setOption("order-by", "suite");  // those that are in none first
  context.applyCommandLine(argc, argv);
  return context.run();
}
