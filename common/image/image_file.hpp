#pragma once

// Images in files, told apart by the ending of their name. An image is
// encoded in memory first, so what can go wrong with a file is in one place.

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "common/files/read_file.hpp"
#include "common/files/file_path.hpp"
#include "common/image/image_codecs.hpp"
#include "common/files/file_error.hpp"
#include "common/image/pfm.hpp"
#include "common/image/ppm.hpp"
#include "common/image/render_result.hpp"
#include "common/image/tone_mapping.hpp"
#include "common/files/write_file.hpp"

namespace lightwalk {

/// The ending of a file's name in lower case, such as ".exr".
inline std::string ending(const std::string& path) {
  std::string text = name_of(file_path(path).extension());
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
  });
  return text;
}

/// The endings of the images that can be written.
inline constexpr std::array<std::string_view, 4> image_endings = {
    ".exr", ".pfm", ".ppm", ".png"};

/// The image library; a FileError where it cannot be loaded. `format` is an
/// ending such as ".exr".
inline const ImageCodecs& need_image_codecs(const std::string& format) {
  std::string error;
  const ImageCodecs* library = image_codecs(error);
  if (!library) throw FileError(format + " " + error);
  return *library;
}

/// Throws a FileError if no image can be written under this name.
inline void check_writable(const std::string& path) {
  check_file_place(path);
  const std::string format = ending(path);
  if (format == ".exr" || format == ".png") need_image_codecs(format);
}

/// The file's bytes, in the format that an ending like ".exr" asks for.
inline std::string encode_image(const std::string& format,
                                const RenderResult& result,
                                const ToneMapping& mapping) {
  if (format == ".pfm") return encode_pfm(result);
  if (format == ".ppm") return encode_ppm(result.radiance);
  const ImageCodecs& library = need_image_codecs(format);
  std::string bytes;
  const std::string error =
      format == ".exr"
          ? library.encode_exr(result, bytes)
          : library.encode_png(tone_map(result.radiance, mapping),
                               encoding_gamma(mapping), bytes);
  if (!error.empty()) throw FileError(error);
  return bytes;
}

/// Writes the image in the format that the name's ending asks for. Where that
/// fails, what was there before still is.
inline void write_image(const std::string& path, const RenderResult& result,
                        const ToneMapping& mapping) {
  write_file(path, encode_image(ending(path), result, mapping));
}

/// Reads an image; what a format does not hold is left empty.
inline RenderResult read_image(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(file_path(path), error);
  if (!fs::exists(status)) throw FileError("there is no such file");
  if (!fs::is_regular_file(status)) throw FileError("it is not a file");
  RenderResult result;
  const std::string format = ending(path);
  if (format == ".exr" || format == ".png") {
    const ImageCodecs& library = need_image_codecs(format);
    const std::string why = format == ".exr"
                                ? library.read_exr(path, result)
                                : library.read_png(path, result.radiance);
    if (!why.empty()) throw FileError(why);
    return result;
  }
  if (format != ".pfm" && format != ".ppm") {
    throw FileError("its name ends in none of .exr, .png, .pfm, .ppm");
  }
  if (format == ".pfm") {
    const std::size_t most =
        most_pfm_bytes(read_file(path, longest_pfm_header));
    return decode_pfm(read_file(path, most));
  }
  const std::size_t most =
      most_ppm_bytes(read_file(path, longest_ppm_header));
  if (const std::uintmax_t size = fs::file_size(file_path(path));
      size > most) {
    throw FileError("it has " + std::to_string(size) +
                     " bytes, and its pixels take " + std::to_string(most) +
                     " at most");
  }
  result.radiance =
      decode_ppm_with_note(read_file(path, most), result.note);
  return result;
}

}  // namespace lightwalk
