// PNG and JPEG files by stb.

#define STBI_NO_STDIO
#define STBI_WRITE_NO_STDIO
#include <stb_image.h>
#include <stb_image_write.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/files/read_file.hpp"
#include "common/files/file_path.hpp"
#include "common/image/orientation.hpp"
#include "common/image/picture_file.hpp"
#include "common/image/small_images.hpp"

namespace lightwalk::small_images {
namespace {

/// 200 MB of texture.
constexpr std::int64_t most_texels = std::int64_t{1} << 26;

/// A file that is no larger than any picture.
constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 30;

struct Release {
  void operator()(void* memory) const { stbi_image_free(memory); }
};

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes += static_cast<char>(value >> shift & 255);
  }
  return bytes;
}

bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/// What stb does not look at: that each chunk is as it was written, and that
/// the last one is there.
std::string check_chunks(std::string_view bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = number_at(bytes, at, 4, true);
    if (length > bytes.size() - at - 12) break;
    const std::string_view chunk = bytes.substr(at + 4, 4 + length);
    if (png_sum(chunk) != number_at(bytes, at + 8 + length, 4, true)) {
      return "a chunk of it is damaged: its sum is wrong";
    }
    const std::string_view name = chunk.substr(0, 4);
    if (!std::all_of(name.begin(), name.end(), is_letter)) {
      return "it is damaged: a chunk's name has four letters, and at byte " +
             std::to_string(at) + " there is another sign";
    }
    if (name == "IEND") return "";
    at += 12 + length;
  }
  return "it is cut off: a PNG ends with the chunk IEND";
}

/// A JPEG's tables of Huffman codes have at most 256, and stb of 2022 writes
/// beyond its own where they claim more. Looked for wherever one may begin.
std::string check_huffman_tables(std::string_view bytes) {
  for (std::size_t begin = bytes.find("\xff\xc4");
       begin != std::string_view::npos;
       begin = bytes.find("\xff\xc4", begin + 1)) {
    const std::size_t end = begin + 2 + number_at(bytes, begin + 2, 2, true);
    for (std::size_t at = begin + 4; at < end && at + 17 <= bytes.size();) {
      if ((number_at(bytes, at, 1, true) & 0xec) != 0) break;  // no table
      std::size_t codes = 0;
      for (std::size_t i = 1; i <= 16; ++i) {
        codes += number_at(bytes, at + i, 1, true);
      }
      if (codes > 256) {
        return "it is damaged: a table of " + std::to_string(codes) +
               " Huffman codes, and 256 are the most";
      }
      at += 17 + codes;
    }
  }
  return "";
}

/// The colors of 16 or 8 bits, from 0 to 1 or as bytes.
float converted(std::uint16_t value, float) {
  return static_cast<float>(value) / 65535;
}
float converted(std::uint8_t value, float) {
  return static_cast<float>(value) / 255;
}
std::uint8_t converted(std::uint16_t value, std::uint8_t) {
  return static_cast<std::uint8_t>((value * 255u + 32767u) / 65535u);
}
std::uint8_t converted(std::uint8_t value, std::uint8_t) {
  return value;
}

template <class Stored, class Pixel>
std::string convert(Stored* stored, std::vector<Pixel>& pixels) {
  const std::unique_ptr<Stored, Release> memory(stored);
  if (!stored) {
    return std::string("it cannot be read: ") + stbi_failure_reason();
  }
  using Number = std::decay_t<decltype(pixels[0][0])>;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Stored* color = stored + 3 * i;
    pixels[i] = {converted(color[0], Number()), converted(color[1], Number()),
                 converted(color[2], Number())};
  }
  return "";
}

/// Reads the colors as they are stored: three values a pixel, upright. Grey
/// becomes three equal channels, and what is transparent keeps its color.
template <class Pixel>
std::string read_colors(const std::string& path, std::int64_t most,
                        int& width, int& height, std::vector<Pixel>& pixels) {
  if (std::filesystem::file_size(file_path(path)) > most_bytes) {
    return "it is larger than 1 GB";
  }
  const std::string bytes = read_file(path, most_bytes);
  const PictureFile file = inspect_picture(bytes);
  if (!file.error.empty()) return file.error;
  std::string error =
      file.is_jpeg ? check_huffman_tables(bytes) : check_chunks(bytes);
  if (!error.empty()) return error;
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &channels)) {
    return std::string("it cannot be read: ") + stbi_failure_reason();
  }
  error = check_size(width, height, most);
  if (!error.empty()) return error;
  pixels.resize(static_cast<std::size_t>(width) *
                static_cast<std::size_t>(height));
  error = stbi_is_16_bit_from_memory(data, size)
              ? convert(stbi_load_16_from_memory(data, size, &width, &height,
                                                 &channels, 3),
                        pixels)
              : convert(stbi_load_from_memory(data, size, &width, &height,
                                              &channels, 3),
                        pixels);
  if (!error.empty()) return error;
  turn_upright(file.orientation, width, height, pixels);
  return "";
}

}  // namespace

std::string encode_png(const Image& image, float gamma, std::string& bytes) {
  std::vector<std::uint8_t> colors;
  colors.reserve(image.pixels.size() * 3);
  for (const Vec3& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) {
      const float value = std::clamp(pixel[c], 0.0f, 1.0f);
      colors.push_back(static_cast<std::uint8_t>(value * 255 + 0.5f));
    }
  }
  bytes.clear();
  const auto append = [](void* to, void* data, int size) {
    static_cast<std::string*>(to)->append(static_cast<const char*>(data),
                                          static_cast<std::size_t>(size));
  };
  if (!stbi_write_png_to_func(append, &bytes, image.width, image.height, 3,
                              colors.data(), image.width * 3)) {
    return "there is not enough memory for it";
  }
  // The chunk gAMA, behind the header. An sRGB chunk would claim a curve that
  // was not used.
  const std::string chunk =
      "gAMA" +
      big_endian(static_cast<std::uint32_t>(std::lround(100000 / gamma)));
  bytes.insert(33, big_endian(4) + chunk + big_endian(png_sum(chunk)));
  return "";
}

std::string read_png(const std::string& path, Image& image) {
  return read_colors(path, most_pixels, image.width, image.height,
                     image.pixels);
}

std::string read_texture(const std::string& path, Texture& texture) {
  return read_colors(path, most_texels, texture.width, texture.height,
                     texture.texels);
}

}  // namespace lightwalk::small_images
