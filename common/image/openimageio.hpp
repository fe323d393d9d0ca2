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

// Each returns what went wrong, or an empty text: see ImageCodecs.
std::string encode_exr(const RenderResult& result, std::string& bytes);
std::string read_exr(const std::string& path, RenderResult& result);
std::string encode_png(const Image& image, float gamma, std::string& bytes);
std::string read_png(const std::string& path, Image& image);
std::string read_texture(const std::string& path, Texture& texture);

}  // namespace lightwalk::openimageio
