#pragma once

// What the compiled files above OpenImageIO have in common.

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <memory>
#include <string>

#include "common/image/image_codecs.hpp"

namespace lightwalk::openimageio {

using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

/// Fixed, so that equal renders are equal files.
inline constexpr const char* date = "2000:01:01 00:00:00";

/// More pixels than any picture has that a render could have made.
inline constexpr std::int64_t most_pixels = std::int64_t{1} << 28;

inline std::string reason(const std::string& error, const char* otherwise) {
  return error.empty() ? otherwise : error;
}

/// What is wrong with a size, before a byte is allocated for it.
inline std::string check_size(std::int64_t width, std::int64_t height,
                              std::int64_t most) {
  if (width <= 0 || height <= 0) return "it has no pixels";
  if (width > most || height > most || width * height > most) {
    return "its header claims " + std::to_string(width) + " x " +
           std::to_string(height) + " pixels, more than " +
           std::to_string(most);
  }
  return "";
}

/// Opens a file as this format and no other; null and the reason in `error`
/// where it is not. ImageInput::open would hand a file that is broken to each
/// of OpenImageIO's readers in turn, those of films and of medicine too.
inline std::unique_ptr<ImageInput> open_as(const char* format,
                                           const std::string& path,
                                           const ImageSpec& config,
                                           std::string& error) {
  auto in = ImageInput::create(format);
  ImageSpec spec;
  if (!in) {
    error = reason(OIIO::geterror(), "its format is not supported");
  } else if (!in->open(path, spec, config)) {
    error = reason(in->geterror(), "it is not an image");
    in = nullptr;
  }
  return in;
}

// Each returns what went wrong, or an empty text: see ImageCodecs.
std::string write_exr(const std::string& path, const RenderResult& result);
std::string read_exr(const std::string& path, RenderResult& result);
std::string write_png(const std::string& path, const Image& image,
                      float gamma);
std::string read_png(const std::string& path, Image& image);
std::string read_texture(const std::string& path, Texture& texture);

}  // namespace lightwalk::openimageio
