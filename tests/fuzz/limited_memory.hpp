#pragma once

namespace lightwalk::fuzz {

/// While this object exists, the program has little memory: `new` throws
/// bad_alloc for a block of more than 16 MB, as it always does for a larger
/// one. tests/core/test_broken_image_files.cpp tests how much memory a file may
/// make a program request.
class LimitedMemory {
 public:
  LimitedMemory();
  ~LimitedMemory();
  LimitedMemory(const LimitedMemory&) = delete;
  LimitedMemory& operator=(const LimitedMemory&) = delete;
};

}  // namespace lightwalk::fuzz
