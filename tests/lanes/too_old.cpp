#include <cstdio>

struct Early {
  Early() { std::puts("an object was constructed first"); }
} early;

int main() {
  std::puts("the program runs");
}
