#pragma once

// Names of files are UTF-8 everywhere. The library of Windows assumes another
// encoding unless the text is marked as UTF-8.

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
