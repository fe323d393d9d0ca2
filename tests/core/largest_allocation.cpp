#include "tests/core/largest_allocation.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>

constinit thread_local std::size_t lightwalk::tests::largest_allocation = 0;

// All of them but the aligned ones: those of a sanitizer do not call each
// other.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  lightwalk::tests::largest_allocation =
      std::max(lightwalk::tests::largest_allocation, size);
  return std::malloc(size > 0 ? size : 1);
}
void* operator new(std::size_t size) {
  void* block = operator new(size, std::nothrow);
  if (!block) throw std::bad_alloc();
  return block;
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return operator new(size, std::nothrow);
}
void* operator new[](std::size_t size) {
  return operator new(size);
}

void operator delete(void* block) noexcept {
  std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
  std::free(block);
}
void operator delete(void* block, const std::nothrow_t&) noexcept {
  std::free(block);
}
void operator delete[](void* block) noexcept {
  std::free(block);
}
void operator delete[](void* block, std::size_t) noexcept {
  std::free(block);
}
void operator delete[](void* block, const std::nothrow_t&) noexcept {
  std::free(block);
}
