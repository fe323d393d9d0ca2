#include "tests/fuzz/limited_memory.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
constexpr std::size_t largest_block = std::size_t{1} << 24;
constinit std::atomic<bool> limited{false};
}  // namespace

lightwalk::fuzz::LimitedMemory::LimitedMemory() {
  limited = true;
}
lightwalk::fuzz::LimitedMemory::~LimitedMemory() {
  limited = false;
}

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  if (limited && size > largest_block) return nullptr;
  return std::malloc(size > 0 ? size : 1);
}
void* operator new(std::size_t size) {
  void* const block = operator new(size, std::nothrow);
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
