#pragma once

// Images in files: a table of formats, one for each ending of a name. An
// image is encoded in memory first, so all errors of writing the file occur
// in one place.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "common/files/file_error.hpp"
#include "common/files/file_path.hpp"
#include "common/files/read_file.hpp"
#include "common/files/write_file.hpp"
#include "common/image/image_module.hpp"
#include "common/image/pfm.hpp"
#include "common/image/ppm.hpp"
#include "common/image/render_result.hpp"
#include "common/image/stb_images.hpp"
#include "common/image/tone_mapping.hpp"

namespace lightwalk {

/// The ending of a file's name in lower case, such as ".exr".
inline std::string ending(const std::string& name) {
  std::string text = name_of(file_path(name).extension());
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
    return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
  });
  return text;
}

// ## One format after the other

inline std::string encode_png_shown(const RenderResult& result,
                                    const ToneMapping& mapping) {
  return encode_png(tone_map(result.radiance, mapping),
                    encoding_gamma(mapping));
}

inline std::string encode_exr(const RenderResult& result,
                              const ToneMapping&) {
  std::string bytes;
  throw_unless_empty(image_module(".exr").encode_exr(result, bytes));
  return bytes;
}

inline RenderResult read_radiance_by_module(const std::string& name) {
  const std::string format = ending(name);
  RenderResult result;
  throw_unless_empty(
      image_module(format).read_radiance(name, format.c_str() + 1, result));
  return result;
}

inline Texture read_texture_by_module(const std::string& name) {
  const std::string format = ending(name);
  Texture texture;
  throw_unless_empty(
      image_module(format).read_texture(name, format.c_str() + 1, texture));
  return texture;
}

// ## All formats

/// What can be done with files of one ending; null for what is impossible.
struct ImageFormat {
  std::string_view ending;
  std::string (*encode)(const RenderResult&, const ToneMapping&);
  RenderResult (*read)(const std::string& name);  ///< radiance
  Texture (*read_texture)(const std::string& name);
  bool in_module = false;
};

inline constexpr ImageFormat image_formats[] = {
    {".exr", encode_exr, read_radiance_by_module, nullptr, true},
    {".pfm",
     [](const RenderResult& result, const ToneMapping&) {
       return encode_pfm(result);
     },
     read_pfm, nullptr},
    {".ppm",
     [](const RenderResult& result, const ToneMapping&) {
       return encode_ppm(result.radiance);
     },
     read_ppm, nullptr},
    {".png", encode_png_shown, nullptr, read_png_or_jpeg},
    {".jpg", nullptr, nullptr, read_png_or_jpeg},
    {".jpeg", nullptr, nullptr, read_png_or_jpeg},
    {".hdr", nullptr, read_radiance_by_module, nullptr, true},
    {".tif", nullptr, read_radiance_by_module, read_texture_by_module, true},
    {".tiff", nullptr, read_radiance_by_module, read_texture_by_module, true},
    {".webp", nullptr, nullptr, read_texture_by_module, true},
};

/// The endings of files with which something can be done:
/// `endings_with(&ImageFormat::encode)` is what can be written.
template <class Function>
std::vector<std::string_view> endings_with(Function ImageFormat::*can) {
  std::vector<std::string_view> endings;
  for (const ImageFormat& format : image_formats) {
    if (format.*can) endings.push_back(format.ending);
  }
  return endings;
}

/// The format of a file with this use. Throws a FileError if there is none.
template <class Function>
const ImageFormat& format_of(const std::string& name,
                             Function ImageFormat::*can) {
  for (const ImageFormat& format : image_formats) {
    if (format.*can && format.ending == ending(name)) return format;
  }
  std::string all;
  for (const std::string_view one : endings_with(can)) {
    all += (all.empty() ? "" : ", ") + std::string(one);
  }
  throw FileError("its name ends in none of " + all);
}

/// Throws a FileError if no image can be written to this name.
inline void check_writable(const std::string& name) {
  check_file_place(name);
  const ImageFormat& format = format_of(name, &ImageFormat::encode);
  if (format.in_module) image_module(format.ending);
}

/// Writes the image in the format of the name's ending. If that fails, it
/// throws a FileError, and the old file is unchanged.
inline void write_image(const std::string& name, const RenderResult& result,
                        const ToneMapping& mapping) {
  write_file(name,
             format_of(name, &ImageFormat::encode).encode(result, mapping));
}

/// Reads radiance; what a format does not hold stays empty. Throws a
/// FileError.
inline RenderResult read_image(const std::string& name) {
  check_is_file(name);
  return format_of(name, &ImageFormat::read).read(name);
}

}  // namespace lightwalk
