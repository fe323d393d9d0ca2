#pragma once

#include <optional>
#include <string>

#include "common/image/image.hpp"
#include "common/files/file_error.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace lightwalk::fuzz {

/// The whole image that some bytes are, or nothing where they are refused
/// with a reason.
inline std::optional<Image> decoded(Image (*decode)(const std::string&),
                                    const std::uint8_t* data,
                                    std::size_t size) {
  try {
    Image image = decode(text_of(data, size));
    check_pixels(image.width, image.height, image.pixels.size());
    return image;
  } catch (const FileError& error) {
    expect(*error.what() != '\0', "a refusal says why");
    return std::nullopt;
  }
}

}  // namespace lightwalk::fuzz
