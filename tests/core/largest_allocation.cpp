#include "tests/core/largest_allocation.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>

constinit thread_local std::size_t lightwalk::tests::largest_allocation = 0;

void* operator new(std::size_t size) {
  lightwalk::tests::largest_allocation =
      std::max(lightwalk::tests::largest_allocation, size);
  void* block = std::malloc(size > 0 ? size : 1);
  if (!block) throw std::bad_alloc();
  return block;
}

void operator delete(void* block) noexcept {
  std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
  std::free(block);
}
