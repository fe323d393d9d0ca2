#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "common/image/file_path.hpp"
#include "common/image/image_error.hpp"

namespace lightwalk {

/// The bytes of a file, or the first `most` of them. They are asked for at
/// once: a text that grows by doubling takes twice the memory. Throws an
/// ImageError.
inline std::string first_bytes(const std::string& path, std::uintmax_t most) {
  std::error_code error;
  const std::uintmax_t size =
      std::filesystem::file_size(file_path(path), error);
  std::ifstream file(path, std::ios::binary);
  if (error || !file) throw ImageError("it cannot be read");
  std::string bytes(static_cast<std::size_t>(std::min(size, most)), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  // What grows while it is read, or is no real file, has more than its size.
  const bool whole = !file.fail();
  const bool more = whole && size < most && file.peek() >= 0;
  if (!whole || more || file.bad()) {
    throw ImageError("it cannot be read");
  }
  return bytes;
}

}  // namespace lightwalk
