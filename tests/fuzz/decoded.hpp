#pragma once

#include <optional>
#include <string>

#include "common/files/file_error.hpp"
#include "common/image/render_result.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace lightwalk::fuzz {

/// The picture that some bytes encode, or nullopt if they are refused with a
/// reason.
template <class Decode>
std::optional<RenderResult> decoded(Decode decode, const std::uint8_t* data,
                                    std::size_t size) {
  try {
    RenderResult result = decode(text_of(data, size));
    const Image& image = result.radiance;
    check_pixels(image.width, image.height, image.pixels.size());
    return result;
  } catch (const FileError& error) {
    expect(*error.what() != '\0', "a refusal says why");
    return std::nullopt;
  }
}

}  // namespace lightwalk::fuzz
