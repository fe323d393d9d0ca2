#pragma once

// # What a file may claim
//
// Forty bytes can claim to be a picture of gigabytes. So a header is believed
// only if the file is large enough for what it claims. Of a packed file that
// can be told, too: the packer of PNG and of most EXR files, deflate, makes
// at best 1 byte of 1032. And no picture has more pixels than a render could
// have made.

#include <cstdint>
#include <string>

namespace lightwalk {

/// More pixels than any picture has that a render could have made.
inline constexpr std::int64_t most_pixels = std::int64_t{1} << 28;

/// How many bytes deflate packs into one, where all of them are equal.
inline constexpr double most_packed = 1032;

/// What is wrong with a size, before a byte is allocated for it.
inline std::string check_size(std::int64_t width, std::int64_t height,
                              std::int64_t most = most_pixels) {
  if (width <= 0 || height <= 0) return "it has no pixels";
  if (width > most || height > most || width * height > most) {
    return "its header claims " + std::to_string(width) + " x " +
           std::to_string(height) + " pixels, more than " +
           std::to_string(most);
  }
  return "";
}

/// What is wrong with a size in the text before or between the pixels.
inline std::string check_written_size(long long width, long long height) {
  constexpr long long most_in_a_row = 65536;
  if (width >= 1 && height >= 1 && width <= most_in_a_row &&
      height <= most_in_a_row && width * height <= most_pixels) {
    return "";
  }
  return "its header claims " + std::to_string(width) + " x " +
         std::to_string(height) + " pixels";
}

/// What is wrong where a picture that takes `needed` bytes unpacked claims to
/// be in a file of `size` bytes that are packed `packed` to one at best.
inline std::string check_packed(std::int64_t width, std::int64_t height,
                                double needed, std::uintmax_t size,
                                double packed) {
  if (needed <= packed * static_cast<double>(size)) return "";
  return "it is cut off: " + std::to_string(size) + " bytes cannot hold " +
         std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

}  // namespace lightwalk
