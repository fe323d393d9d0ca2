#pragma once

#include <filesystem>
#include <string>

#include "common/files/file_path.hpp"
#include "common/image/image_file.hpp"
#include "common/image/texture.hpp"

namespace lightwalk {

/// Reads a picture of 8 bits a channel, sRGB: PNG or JPEG. `path` is relative
/// to `folder`, and must not lead out of it: a scene is handed on together
/// with its folder, and should work there. Throws a FileError.
inline Texture load_texture(const std::string& folder,
                            const std::string& path) {
  namespace fs = std::filesystem;
  // The file system would take the name to end there.
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
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status)) throw FileError("there is no such file");
  if (!fs::is_regular_file(status)) throw FileError("it is not a file");
  const std::string format = ending(path);
  if (format != ".png" && format != ".jpg" && format != ".jpeg") {
    throw FileError("its name ends in none of .png, .jpg, .jpeg");
  }
  Texture texture;
  const std::string why =
      need_image_codecs(format).read_texture(name_of(file), texture);
  if (!why.empty()) throw FileError(why);
  return texture;
}

}  // namespace lightwalk
