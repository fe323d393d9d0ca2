#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

#include "common/files/file_error.hpp"
#include "common/files/file_path.hpp"

namespace lightwalk {

/// Throws a FileError unless it is a file, not a folder or a device.
inline void check_is_file(const std::string& name) {
  std::error_code error;
  const auto status = std::filesystem::status(file_path(name), error);
  if (error == std::errc::permission_denied) {
    throw FileError(error.message());
  }
  if (!exists(status)) throw FileError("there is no such file");
  if (!is_regular_file(status)) throw FileError("it is not a file");
}

/// The bytes of a file, or the first `most` of them. Allocates memory for all
/// of them at once: a text that grows by doubling takes twice as much.
/// Throws a FileError.
inline std::string read_file(const std::string& name, std::uintmax_t most) {
  std::error_code error;
  const std::uintmax_t size =
      std::filesystem::file_size(file_path(name), error);
  std::ifstream file(file_path(name), std::ios::binary);
  if (error || !file) throw FileError("it cannot be read");
  std::string bytes(static_cast<std::size_t>(std::min(size, most)), '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  // A file that grows while it is read, or is not real, exceeds its size.
  const bool whole = !file.fail();
  const bool more = whole && size < most && file.peek() >= 0;
  if (!whole || more || file.bad()) throw FileError("it cannot be read");
  return bytes;
}

}  // namespace lightwalk
