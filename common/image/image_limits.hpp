#pragma once

// # What a file may claim
//
// Forty bytes can claim to be a picture of gigabytes. So a header is accepted
// only if a render could be so large, and if the file has enough bytes for
// what the header claims.

#include <cstdint>
#include <string>

#include "common/files/file_error.hpp"

namespace lightwalk {

/// More pixels than any render has.
inline constexpr std::int64_t max_pixels = std::int64_t{1} << 28;
inline constexpr std::int64_t max_side = 65536;

/// The pixels of a texture: 200 MB.
inline constexpr std::int64_t max_texels = std::int64_t{1} << 26;

/// Throws a FileError for a size that no picture has, before a byte is
/// allocated for it.
inline void check_size(std::int64_t width, std::int64_t height,
                       std::int64_t most = max_pixels) {
  const bool fits = width >= 1 && height >= 1 && width <= max_side &&
                    height <= max_side && width * height <= most;
  if (fits) return;
  throw FileError(
      "its header claims " + std::to_string(width) + " x " +
      std::to_string(height) + " pixels; possible are sides of 1 to " +
      std::to_string(max_side) + ", and " + std::to_string(most) + " pixels");
}

/// Throws a FileError if `size` bytes, each of which stands for at most
/// `packed` bytes, cannot hold a picture of `needed` bytes.
inline void check_packed(std::int64_t width, std::int64_t height,
                         double needed, std::uintmax_t size, double packed) {
  if (needed <= packed * static_cast<double>(size)) return;
  throw FileError("it is cut off: " + std::to_string(size) +
                  " bytes cannot hold " + std::to_string(width) + " x " +
                  std::to_string(height) + " pixels");
}

}  // namespace lightwalk
