#pragma once

namespace lightwalk::fuzz {

/// While it lives, the program has little memory: `new` throws bad_alloc for
/// a block of more than 16 MB, as it would anywhere for a larger one. How much
/// a file may make a program ask for is tested in
/// tests/core/test_broken_image_files.cpp.
class LimitedMemory {
 public:
  LimitedMemory();
  ~LimitedMemory();
  LimitedMemory(const LimitedMemory&) = delete;
  LimitedMemory& operator=(const LimitedMemory&) = delete;
};

}  // namespace lightwalk::fuzz
