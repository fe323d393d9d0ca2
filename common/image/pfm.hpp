#pragma once

// # PFM
//
// The simplest file that holds floats: a line `PF`, the size, a line -1 for
// "little-endian", and the pixels from the bottom row upwards. No library
// needed, and most viewers of high dynamic range pictures open it.

#include <bit>
#include <cstring>
#include <sstream>
#include <string>

#include "common/image/image.hpp"
#include "common/files/file_error.hpp"
#include "common/image/image_limits.hpp"

namespace lightwalk {

static_assert(sizeof(Vec3) == 12);

inline std::string encode_pfm(const Image& image) {
  static_assert(std::endian::native == std::endian::little);
  std::string bytes = "PF\n" + std::to_string(image.width) + ' ' +
                      std::to_string(image.height) + "\n-1.0\n";
  const auto row_bytes = static_cast<std::size_t>(image.width) * sizeof(Vec3);
  for (int row = image.height - 1; row >= 0; --row) {
    bytes.append(reinterpret_cast<const char*>(&image.at(0, row)), row_bytes);
  }
  return bytes;
}

/// Where the pixels begin: behind the white space after the scale, which ends
/// at `after`. It is one character, but programs for Windows end the line
/// with two, CR and LF, and some leave blanks before them.
inline std::size_t pfm_start(const std::string& bytes, std::size_t after,
                             std::size_t count) {
  std::size_t end = after;
  while (end < bytes.size() && (bytes[end] == ' ' || bytes[end] == '\t')) {
    ++end;
  }
  if (end < bytes.size() && bytes[end] == '\r') ++end;
  const bool is_line = end < bytes.size() && bytes[end] == '\n';
  // Where the file is just so long that one character was meant, the others
  // are pixels.
  const bool one = bytes.size() == after + 1 + count;
  return is_line && !one && bytes.size() - end - 1 >= count ? end + 1
                                                            : after + 1;
}

/// What the lines before the pixels say.
struct PfmHeader {
  int width, height;
  std::size_t channels;
  bool big_endian;
  std::size_t end;         ///< of the scale; beyond the file if it ends there
  std::size_t data_bytes;  ///< of all pixels
};

inline constexpr std::size_t longest_pfm_header = 200;

inline PfmHeader read_pfm_header(const std::string& bytes) {
  std::istringstream header(bytes.substr(0, longest_pfm_header));
  std::string magic;
  long long width = 0, height = 0;
  double scale = 0;
  header >> magic >> width >> height >> scale;
  if (!header || (magic != "PF" && magic != "Pf") || scale == 0) {
    throw FileError(
        "it is not a PFM file, which begins with PF or Pf, width, height, "
        "and "
        "a scale that is not 0");
  }
  if (const std::string error = check_written_size(width, height);
      !error.empty()) {
    throw FileError(error);
  }
  const std::size_t channels = magic == "PF" ? 3 : 1;
  return {
      static_cast<int>(width),
      static_cast<int>(height),
      channels,
      scale > 0,
      header.eof() ? bytes.size() : static_cast<std::size_t>(header.tellg()),
      static_cast<std::size_t>(width * height) * channels * sizeof(float)};
}

/// More bytes of the file than this nobody has to read.
inline std::size_t most_pfm_bytes(const std::string& first_bytes) {
  return 2 * longest_pfm_header + read_pfm_header(first_bytes).data_bytes;
}

/// Reads both byte orders, color (`PF`) and grey (`Pf`).
inline Image decode_pfm(const std::string& bytes) {
  const PfmHeader header = read_pfm_header(bytes);
  const std::size_t count = header.data_bytes;
  const std::size_t start = pfm_start(bytes, header.end, count);
  if (start > bytes.size() || bytes.size() - start < count) {
    throw FileError("it is cut off: " + std::to_string(bytes.size()) +
                     " bytes, and its header promises " +
                     std::to_string(start + count));
  }
  Image image(header.width, header.height);
  const char* next = bytes.data() + start;
  const auto read_float = [&] {
    char raw[4];
    std::memcpy(raw, next, 4);
    next += 4;
    if (header.big_endian)
      std::swap(raw[0], raw[3]), std::swap(raw[1], raw[2]);
    float value;
    std::memcpy(&value, raw, 4);
    return value;
  };
  for (int row = image.height - 1; row >= 0; --row) {
    for (int column = 0; column < image.width; ++column) {
      Vec3& pixel = image.at(column, row);
      if (header.channels == 1) {
        pixel = Vec3(read_float());
      } else {
        for (int c = 0; c < 3; ++c) pixel[c] = read_float();
      }
    }
  }
  return image;
}

}  // namespace lightwalk
