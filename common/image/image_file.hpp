#pragma once

// Images in files, told apart by the ending of their name. A file is written
// beside its place under another name and then renamed, so that under the
// wanted name there is always a whole image: the old one or the new one.

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "common/image/file_bytes.hpp"
#include "common/image/image_codecs.hpp"
#include "common/image/image_error.hpp"
#include "common/image/pfm.hpp"
#include "common/image/ppm.hpp"
#include "common/image/render_result.hpp"
#include "common/image/tone_mapping.hpp"

namespace lightwalk {

/// The ending of a file's name in lower case, such as ".exr".
inline std::string ending(const std::string& path) {
  std::string text = std::filesystem::path(path).extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
  });
  return text;
}

inline bool is_image_ending(const std::string& text) {
  constexpr std::array<std::string_view, 4> known = {".exr", ".pfm", ".ppm",
                                                     ".png"};
  return std::find(known.begin(), known.end(), text) != known.end();
}

/// The image library; an ImageError where it cannot be loaded.
inline const ImageCodecs& need_image_codecs() {
  std::string error;
  const ImageCodecs* library = image_codecs(error);
  if (!library) throw ImageError(error);
  return *library;
}

/// The name under which a file is written before it is renamed.
inline std::string unfinished_name(const std::string& path) {
  const std::filesystem::path target(path);
  std::filesystem::path name = target.parent_path();
  name /= "." + target.stem().string() + ".unfinished" +
          target.extension().string();
  return name.string();
}

inline void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file << bytes;
  file.close();
  if (!file) throw ImageError(std::strerror(errno));
}

/// OpenImageIO says that a PNG is written even where the disk was full. The
/// file is whole if it ends as every PNG does.
inline void check_png_is_whole(const std::string& path) {
  std::string last(8, ' ');
  std::ifstream file(path, std::ios::binary);
  file.seekg(-8, std::ios::end).read(last.data(), 8);
  if (!file || last != "IEND\xae\x42\x60\x82") {
    throw ImageError("the file is cut off: is the disk full?");
  }
}

/// Throws an ImageError if no image can be written under this name.
inline void check_writable(const std::string& path) {
  namespace fs = std::filesystem;
  const std::string format = ending(path);
  if (format == ".exr" || format == ".png") need_image_codecs();
  std::error_code error;
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, error)) {
    throw ImageError("there is no folder '" + folder.string() + "'");
  }
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) throw ImageError("it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw ImageError("it is not a regular file");
  }
  errno = 0;
  const std::string trial = unfinished_name(path);
  std::ofstream file(trial, std::ios::binary);
  if (!file) throw ImageError(std::strerror(errno));
  file.close();
  fs::remove(trial, error);
}

/// Writes the image in the format that the name's ending asks for.
inline void write_image(const std::string& path, const RenderResult& result,
                        const ToneMapping& mapping) {
  const std::string unfinished = unfinished_name(path);
  const auto check = [](const std::string& error) {
    if (!error.empty()) throw ImageError(error);
  };
  try {
    const std::string format = ending(path);
    if (format == ".exr") {
      check(need_image_codecs().write_exr(unfinished, result));
    } else if (format == ".png") {
      check(need_image_codecs().write_png(unfinished,
                                          tone_map(result.radiance, mapping),
                                          encoding_gamma(mapping)));
      check_png_is_whole(unfinished);
    } else if (format == ".pfm") {
      write_bytes(unfinished, encode_pfm(result.radiance));
    } else {
      write_bytes(unfinished, encode_ppm(result.radiance));
    }
    std::filesystem::rename(unfinished, path);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    throw;
  }
}

/// Reads an image; what a format does not hold is left empty.
inline RenderResult read_image(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw ImageError("there is no such file");
  if (!fs::is_regular_file(status)) throw ImageError("it is not a file");
  RenderResult result;
  const std::string format = ending(path);
  if (format == ".exr" || format == ".png") {
    const ImageCodecs& library = need_image_codecs();
    const std::string why = format == ".exr"
                                ? library.read_exr(path, result)
                                : library.read_png(path, result.radiance);
    if (!why.empty()) throw ImageError(why);
    return result;
  }
  if (format != ".pfm" && format != ".ppm") {
    throw ImageError("its name ends in none of .exr, .png, .pfm, .ppm");
  }
  if (format == ".pfm") {
    const std::size_t most =
        most_pfm_bytes(first_bytes(path, longest_pfm_header));
    result.radiance = decode_pfm(first_bytes(path, most));
    return result;
  }
  const std::size_t most =
      most_ppm_bytes(first_bytes(path, longest_ppm_header));
  if (const std::uintmax_t size = fs::file_size(path); size > most) {
    throw ImageError("it has " + std::to_string(size) +
                     " bytes, and its pixels take " + std::to_string(most) +
                     " at most");
  }
  result.radiance =
      decode_ppm_with_note(first_bytes(path, most), result.note);
  return result;
}

}  // namespace lightwalk
