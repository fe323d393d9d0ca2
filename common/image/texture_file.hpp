#pragma once

#include <filesystem>
#include <string>

#include "common/files/file_path.hpp"
#include "common/image/image_file.hpp"
#include "common/image/texture.hpp"

namespace lightwalk {

/// Reads a picture of 8 bits per channel, sRGB. `path` is relative to
/// `folder`, and must not lead out of it: people pass a scene on with its
/// folder, and it should work there. Throws a FileError.
inline Texture load_texture(const std::string& folder,
                            const std::string& path) {
  namespace fs = std::filesystem;
  // To the file system the name would end there.
  if (path.find('\0') != std::string::npos) {
    throw FileError("its name has a NUL character");
  }
  std::error_code error;
  const fs::path root =
      fs::weakly_canonical(file_path(folder.empty() ? "." : folder));
  const fs::path file = fs::weakly_canonical(root / file_path(path), error);
  const fs::path inside = file.lexically_relative(root);
  if (file_path(path).is_absolute() || inside.empty() ||
      *inside.begin() == "..") {
    throw FileError("it must lie in the scene's folder, or below it");
  }
  check_is_file(name_of(file));
  return format_of(path, &ImageFormat::read_texture)
      .read_texture(name_of(file));
}

}  // namespace lightwalk
