#pragma once

// For the harnesses that have the functions of the image library in them.

#include "common/image/image_codecs.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" const lightwalk::ImageCodecs* lightwalk_image_codecs();

namespace lightwalk::fuzz {

/// Fails where an image that was read is not whole.
inline void check_pixels(int width, int height, std::size_t count) {
  expect(width > 0 && height > 0, "an image has pixels");
  expect(count == static_cast<std::size_t>(width) *
                      static_cast<std::size_t>(height),
         "an image has width x height pixels",
         std::to_string(width) + " x " + std::to_string(height) + " and " +
             std::to_string(count));
}

}  // namespace lightwalk::fuzz
