#pragma once

// What the compiled files above OpenImageIO have in common.

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <memory>
#include <string>

#include "common/image/image_codecs.hpp"
#include "common/image/image_limits.hpp"

namespace lightwalk::openimageio {

using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

/// Fixed, so that equal renders are equal files.
inline constexpr const char* date = "2000:01:01 00:00:00";

inline std::string reason(const std::string& error, const char* otherwise) {
  return error.empty() ? otherwise : error;
}

/// Encodes pixels of floats in a format that is named like "exr".
std::string encode(const std::string& format, const ImageSpec& spec,
                   const float* pixels, std::string& bytes);

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
std::string encode_exr(const RenderResult& result, std::string& bytes);
std::string read_exr(const std::string& path, RenderResult& result);
std::string encode_png(const Image& image, float gamma, std::string& bytes);
std::string read_png(const std::string& path, Image& image);
std::string read_texture(const std::string& path, Texture& texture);

}  // namespace lightwalk::openimageio
