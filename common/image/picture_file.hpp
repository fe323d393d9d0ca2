#pragma once

// # What PNG and JPEG files say beside their pixels
//
// The image library does not say three things that matter: that a JPEG ends
// early, for its decoder fills the rest with grey and is content; how a PNG
// is to be turned; and that a file is too small for the pixels that it claims
// to have, before it takes the memory for them. All are found by walking over
// the file's pieces.

#include <cstdint>
#include <string>
#include <string_view>

#include "common/image/image_limits.hpp"

namespace lightwalk {

/// What is wrong with the file, or an empty text; EXIF's orientation; and
/// which of the two kinds it is.
struct PictureFile {
  std::string error;
  int orientation = 1;
  bool is_jpeg = false;
};

/// The whole number in some bytes; 0 where they are not all there.
inline std::uint32_t number_at(std::string_view bytes, std::size_t at,
                               std::size_t size, bool big_endian) {
  if (at > bytes.size() || bytes.size() - at < size) return 0;
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t next = big_endian ? at + i : at + size - 1 - i;
    value = value << 8 | static_cast<std::uint8_t>(bytes[next]);
  }
  return value;
}

/// The orientation in EXIF's data, a small TIFF file; 1 where there is none.
inline int exif_orientation(std::string_view exif) {
  const bool big_endian = exif.substr(0, 4) == std::string_view("MM\0*", 4);
  if (!big_endian && exif.substr(0, 4) != std::string_view("II*\0", 4)) {
    return 1;
  }
  const std::size_t table = number_at(exif, 4, 4, big_endian);
  const std::uint32_t entries = number_at(exif, table, 2, big_endian);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = table + 2 + 12 * i;
    if (number_at(exif, entry, 2, big_endian) != 0x0112) continue;
    const auto value =
        static_cast<int>(number_at(exif, entry + 8, 2, big_endian));
    return value >= 1 && value <= 8 ? value : 1;
  }
  return 1;
}

/// What is wrong with the size that a segment of a JPEG file claims, if it is
/// one that does. A block of 8 x 8 pixels takes a bit at least but in
/// arithmetic coding, which hardly anybody uses: of the small, any is taken.
inline std::string check_jpeg_size(std::uint8_t marker, std::string_view data,
                                   std::size_t file_size) {
  const bool is_frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 &&
                        marker != 0xc8 && marker != 0xcc;
  if (!is_frame) return "";
  const std::uint32_t height = number_at(data, 1, 2, true);
  const std::uint32_t width = number_at(data, 3, 2, true);
  const double pixels = static_cast<double>(width) * height;
  return pixels <= 0x1p22
             ? ""
             : check_packed(width, height, pixels, file_size, 8 * 64);
}

/// What is wrong with the size in a PNG's first chunk: width, height, the
/// bits of a channel, and the kind of color.
inline std::string check_png_size(std::string_view bytes) {
  const std::uint32_t width = number_at(bytes, 16, 4, true);
  const std::uint32_t height = number_at(bytes, 20, 4, true);
  const std::uint32_t bits = number_at(bytes, 24, 1, true);
  const std::uint32_t color = number_at(bytes, 25, 1, true);
  // Grey and palettes have 1 channel, RGB 3, and alpha is one more.
  const std::uint32_t channels = color == 2   ? 3
                                 : color == 6 ? 4
                                 : color == 4 ? 2
                                              : 1;
  const double needed =
      static_cast<double>(width) * height * channels * bits / 8;
  return check_packed(width, height, needed, bytes.size(), most_packed);
}

/// Walks over the segments of a JPEG file. Data after its end marker are
/// allowed: telephones put films there.
inline PictureFile inspect_jpeg(std::string_view bytes) {
  const PictureFile cut{
      "it is cut off: a JPEG ends with the bytes FF D9, and there are none "
      "in its " +
          std::to_string(bytes.size()) + " bytes",
      1, true};
  PictureFile result{"", 1, true};
  std::size_t at = 2;
  while (at + 1 < bytes.size()) {
    const auto marker = static_cast<std::uint8_t>(bytes[at + 1]);
    // Compressed data between segments: FF 00 is a byte of them, FF FF fills,
    // and D0 to D7 only restart the decoder.
    if (bytes[at] != '\xff' || marker == 0 || marker == 0xff) {
      ++at;
      continue;
    }
    if (marker == 0xd9) return result;
    if (marker == 1 || (marker >= 0xd0 && marker <= 0xd8)) {
      at += 2;
      continue;
    }
    const std::size_t length = number_at(bytes, at + 2, 2, true);
    if (length < 2 || length > bytes.size() - at - 2) return cut;
    const std::string_view data = bytes.substr(at + 4, length - 2);
    if (marker == 0xe1 &&
        data.substr(0, 6) == std::string_view("Exif\0\0", 6)) {
      result.orientation = exif_orientation(data.substr(6));
    }
    result.error = check_jpeg_size(marker, data, bytes.size());
    if (!result.error.empty()) return result;
    at += 2 + length;
  }
  return cut;
}

/// Looks for EXIF among the chunks of a PNG file. That it is whole, the
/// decoder finds out.
inline PictureFile inspect_png(std::string_view bytes) {
  PictureFile result{check_png_size(bytes), 1};
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = number_at(bytes, at, 4, true);
    if (length > bytes.size() - at - 12) break;
    if (bytes.substr(at + 4, 4) == "eXIf") {
      result.orientation = exif_orientation(bytes.substr(at + 8, length));
    }
    at += 12 + length;
  }
  return result;
}

/// What kind it is, the first bytes say, not the name.
inline PictureFile inspect_picture(std::string_view bytes) {
  if (bytes.substr(0, 3) == "\xff\xd8\xff") return inspect_jpeg(bytes);
  if (bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n") return inspect_png(bytes);
  return {bytes.empty() ? "it is empty" : "it is neither a PNG nor a JPEG",
          1};
}

}  // namespace lightwalk
