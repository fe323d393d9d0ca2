#include "common/image/stb_images.hpp"

// What a damaged JPEG leaves unset is zero, so that the result does not
// depend on the old content of the memory.
#include <cstdlib>
#define STBI_MALLOC(size) std::calloc(1, size)
#define STBI_REALLOC(memory, size) std::realloc(memory, size)
#define STBI_FREE(memory) std::free(memory)
#define STBI_ASSERT(condition)
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>
#define STBI_WRITE_NO_STDIO
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "common/files/read_file.hpp"
#include "common/image/image_limits.hpp"

namespace lightwalk {

namespace {

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes += static_cast<char>(value >> shift & 255);
  }
  return bytes;
}

/// The chunk gAMA: the curve by which the values are stored. An sRGB chunk
/// would claim another curve.
std::string gamma_chunk(float gamma) {
  std::string chunk =
      "gAMA" +
      big_endian(static_cast<std::uint32_t>(std::lround(100000 / gamma)));
  auto* const bytes = reinterpret_cast<unsigned char*>(chunk.data());
  return big_endian(4) + chunk + big_endian(stbiw__crc32(bytes, 8));
}

/// stb fills the missing part of a JPEG with gray. So we look for the end
/// marker behind the segments before the data, for one of these segments may
/// have a thumbnail.
bool is_cut_off(const std::string& bytes) {
  if (!bytes.starts_with("\xff\xd8")) return false;
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && bytes[at] == '\xff' &&
         bytes[at + 1] != '\xda') {
    at += 2 + 256 * static_cast<std::uint8_t>(bytes[at + 2]) +
          static_cast<std::uint8_t>(bytes[at + 3]);
  }
  return bytes.find("\xff\xd9", at) == std::string::npos;
}

/// Throws if a JPEG's table claims more than the 256 Huffman codes that there
/// can be: stb 2.27 would write beyond its own table. We look wherever such a
/// table may begin.
void check_huffman_tables(const std::string& bytes) {
  const auto byte = [&](std::size_t at) -> std::size_t {
    return static_cast<std::uint8_t>(bytes[at]);
  };
  for (std::size_t begin = bytes.find("\xff\xc4");
       begin != std::string::npos && begin + 4 <= bytes.size();
       begin = bytes.find("\xff\xc4", begin + 1)) {
    const std::size_t end =
        begin + 2 + 256 * byte(begin + 2) + byte(begin + 3);
    for (std::size_t at = begin + 4; at < end && at + 17 <= bytes.size();) {
      if ((byte(at) & 0xec) != 0) break;  // not a table
      std::size_t codes = 0;
      for (std::size_t i = 1; i <= 16; ++i) codes += byte(at + i);
      if (codes > 256) {
        throw FileError("it is damaged: a table of " + std::to_string(codes) +
                        " Huffman codes, and 256 are the most");
      }
      at += 17 + codes;
    }
  }
}

}  // namespace

std::string encode_png(const Image& image, float gamma) {
  std::vector<std::uint8_t> colors;
  colors.reserve(image.pixels.size() * 3);
  for (const Vec3& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) {
      const float value = std::clamp(pixel[c], 0.0f, 1.0f);
      colors.push_back(static_cast<std::uint8_t>(value * 255 + 0.5f));
    }
  }
  std::string bytes;
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data),
                                          static_cast<std::size_t>(size));
  };
  if (!stbi_write_png_to_func(append, &bytes, image.width, image.height, 3,
                              colors.data(), image.width * 3)) {
    throw std::bad_alloc();
  }
  constexpr std::size_t header_end = 33;
  return bytes.insert(header_end, gamma_chunk(gamma));
}

Texture read_png_or_jpeg(const std::string& name) {
  constexpr std::uintmax_t max_bytes = std::uintmax_t{1} << 30;
  const std::string bytes = read_file(name, max_bytes);
  const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const auto size = static_cast<int>(bytes.size());
  if (bytes.starts_with("\xff\xd8")) check_huffman_tables(bytes);
  Texture texture;
  int channels = 0;
  if (!stbi_info_from_memory(data, size, &texture.width, &texture.height,
                             &channels)) {
    throw FileError("it is no PNG or JPEG that stb can read");
  }
  check_size(texture.width, texture.height, max_texels);
  // A PNG's pixel takes at least a bit, and deflate packs 1032 bits into one.
  // A JPEG has at most 64 pixels in a bit.
  const double bits = static_cast<double>(texture.width) * texture.height;
  check_packed(texture.width, texture.height, bits / 8, bytes.size(), 1032);
  if (is_cut_off(bytes)) {
    throw FileError("it is cut off: a JPEG ends with FF D9");
  }
  const std::unique_ptr<stbi_uc, void (*)(void*)> colors(
      stbi_load_from_memory(data, size, &texture.width, &texture.height,
                            &channels, 3),
      stbi_image_free);
  if (!colors) {
    throw FileError(std::string("it cannot be read: ") +
                    stbi_failure_reason());
  }
  texture.texels.resize(static_cast<std::size_t>(texture.width) *
                        static_cast<std::size_t>(texture.height));
  std::copy_n(colors.get(), 3 * texture.texels.size(),
              texture.texels.front().data());
  return texture;
}

}  // namespace lightwalk
