#pragma once

// Names of files are texts in UTF-8 everywhere. Windows' library takes a text
// for something else unless it is told.

#include <filesystem>
#include <string>

namespace lightwalk {

inline std::filesystem::path file_path(const std::string& name) {
#ifdef _WIN32
  return std::filesystem::path(std::u8string(name.begin(), name.end()));
#else
  return std::filesystem::path(name);
#endif
}

inline std::string name_of(const std::filesystem::path& path) {
#ifdef _WIN32
  const std::u8string name = path.u8string();
  return std::string(name.begin(), name.end());
#else
  return path.string();
#endif
}

}  // namespace lightwalk
