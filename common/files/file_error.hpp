#pragma once

#include <stdexcept>

namespace lightwalk {

/// Why a file cannot be read or written, without the file's name.
struct FileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace lightwalk
