#pragma once

// # PFM
//
// The simplest file that holds floats: a line `PF`, the size, a line -1 for
// "little-endian", and the pixels from the bottom row upwards. No library
// needed, and most viewers of high dynamic range pictures open it.
//
// A render's file has a second picture behind the first, the variance of one
// sample, which other programs ignore. Comments below its `PF` say what was
// rendered, a line each: `# seed 7`. They do not name the program: two
// programs that render the same bits write the same file.

#include <algorithm>
#include <bit>
#include <cstring>
#include <sstream>
#include <string>
#include <string_view>

#include "common/files/file_error.hpp"
#include "common/files/read_file.hpp"
#include "common/image/image.hpp"
#include "common/image/image_limits.hpp"
#include "common/image/render_result.hpp"

namespace lightwalk {

static_assert(sizeof(Vec3) == 12);
static_assert(std::endian::native == std::endian::little);

inline std::string encode_pfm(const Image& image,
                              const std::string& comments = "") {
  std::string bytes = "PF\n" + comments + std::to_string(image.width) + ' ' +
                      std::to_string(image.height) + "\n-1.0\n";
  const auto row_bytes = static_cast<std::size_t>(image.width) * sizeof(Vec3);
  for (int row = image.height - 1; row >= 0; --row) {
    bytes.append(reinterpret_cast<const char*>(&image.at(0, row)), row_bytes);
  }
  return bytes;
}

/// The mean and, if there is one, the variance.
inline std::string encode_pfm(const RenderResult& result) {
  std::string comments;
  for (const auto& [name, text] : texts_of(result.info)) {
    comments += "# " + name + ' ' + text + '\n';
  }
  const std::string mean = encode_pfm(result.radiance);
  return result.variance.pixels.empty()
             ? mean
             : mean + encode_pfm(result.variance, comments);
}

/// What the lines before the pixels say.
struct PfmHeader {
  int width, height;
  std::size_t channels;
  bool big_endian;
  std::size_t size;        ///< of the header; past the end of a cut-off file
  std::size_t data_bytes;  ///< of all pixels
  InfoTexts comments;
};

inline constexpr std::size_t longest_pfm_header = 1000;

inline PfmHeader read_pfm_header(std::string_view bytes) {
  std::istringstream header(std::string(bytes.substr(0, longest_pfm_header)));
  std::string magic;
  header >> magic;
  InfoTexts comments;
  while ((header >> std::ws).peek() == '#') {
    std::string line, name;
    std::getline(header, line);
    std::istringstream words(line.substr(1));
    words >> name >> comments[name];
  }
  long long width = 0, height = 0;
  double scale = 0;
  header >> width >> height >> scale;
  if (!header || (magic != "PF" && magic != "Pf") || scale == 0) {
    throw FileError(
        "it is not a PFM file, which begins with PF or Pf, width, height, "
        "and a scale that is not 0");
  }
  check_size(width, height);
  const std::size_t channels = magic == "PF" ? 3 : 1;
  const std::size_t end =
      header.eof() ? bytes.size() : static_cast<std::size_t>(header.tellg());
  return {static_cast<int>(width),
          static_cast<int>(height),
          channels,
          scale > 0,
          end + (bytes.substr(end).starts_with("\r\n") ? 2 : 1),
          static_cast<std::size_t>(width * height) * channels * sizeof(float),
          comments};
}

/// Takes a picture from the beginning of `bytes`, in both byte orders, color
/// (`PF`) and gray (`Pf`).
inline Image take_pfm(std::string_view& bytes, InfoTexts& comments) {
  const PfmHeader header = read_pfm_header(bytes);
  const std::size_t needed = header.size + header.data_bytes;
  if (bytes.size() < needed) {
    throw FileError("it is cut off: " + std::to_string(bytes.size()) +
                    " bytes, and its header promises " +
                    std::to_string(needed));
  }
  Image image(header.width, header.height);
  const char* next = bytes.data() + header.size;
  const auto read_float = [&] {
    char raw[4];
    std::memcpy(raw, next, 4);
    next += 4;
    if (header.big_endian) std::reverse(raw, raw + 4);
    float value;
    std::memcpy(&value, raw, 4);
    return value;
  };
  for (int row = image.height - 1; row >= 0; --row) {
    for (int column = 0; column < image.width; ++column) {
      Vec3& pixel = image.at(column, row);
      pixel = Vec3(read_float());
      if (header.channels == 1) continue;
      pixel.y = read_float();
      pixel.z = read_float();
    }
  }
  bytes.remove_prefix(needed);
  comments = header.comments;
  return image;
}

/// Reads the picture, and the variance if there is one.
inline RenderResult decode_pfm(std::string_view bytes) {
  RenderResult result;
  InfoTexts comments;
  result.radiance = take_pfm(bytes, comments);
  if (!bytes.starts_with("PF\n#")) return result;
  result.variance = take_pfm(bytes, comments);
  result.info = info_of(comments);
  const Image &mean = result.radiance, &variance = result.variance;
  if (variance.width != mean.width || variance.height != mean.height) {
    throw FileError("its variance has another size than its picture");
  }
  return result;
}

/// Reads a PFM file, and of a file that is too long no more than it needs.
/// Throws a FileError.
inline RenderResult read_pfm(const std::string& name) {
  const PfmHeader header =
      read_pfm_header(read_file(name, longest_pfm_header));
  return decode_pfm(
      read_file(name, 2 * (longest_pfm_header + header.data_bytes)));
}

}  // namespace lightwalk
