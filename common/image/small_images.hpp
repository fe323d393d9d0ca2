#pragma once

// # Images without OpenImageIO
//
// What the compiled files above stb and tinyexr have in common: two small
// libraries, each a header, for machines where OpenImageIO is not installed.
// They read and write the same files, of fewer kinds: EXR in scan lines,
// packed by ZIP or not at all; PNG; and JPEG.

#include <cstdint>
#include <string>
#include <string_view>

#include "common/image/image_codecs.hpp"

namespace lightwalk::small_images {

/// The sum at the end of a PNG's chunk, over its name and its data.
inline std::uint32_t png_sum(std::string_view bytes) {
  std::uint32_t sum = 0xffffffff;
  for (const char c : bytes) {
    sum ^= static_cast<std::uint8_t>(c);
    for (int i = 0; i < 8; ++i) {
      sum = sum >> 1 ^ (sum & 1 ? 0xedb88320u : 0);
    }
  }
  return ~sum;
}

// Each returns what went wrong, or an empty text: see ImageCodecs.
std::string encode_exr(const RenderResult& result, std::string& bytes);
std::string read_exr(const std::string& path, RenderResult& result);
std::string encode_png(const Image& image, float gamma, std::string& bytes);
std::string read_png(const std::string& path, Image& image);
std::string read_texture(const std::string& path, Texture& texture);

}  // namespace lightwalk::small_images
