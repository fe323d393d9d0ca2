#pragma once

#include <stdexcept>

namespace lightwalk {

/// Why an image file cannot be read or written, without the file's name.
struct ImageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lightwalk
