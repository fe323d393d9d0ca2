#pragma once

// PNG and JPEG files, by stb.

#include <string>

#include "common/image/image.hpp"
#include "common/image/texture.hpp"

namespace lightwalk {

/// The bytes of a PNG file with eight bits per channel. The image must be in
/// [0, 1], as light to the power of 1 / `gamma`.
std::string encode_png(const Image& image, float gamma);

/// Reads the colors of a PNG or JPEG file as they are stored, and ignores
/// alpha; gray becomes three equal channels. Throws a FileError.
Texture read_png_or_jpeg(const std::string& name);

}  // namespace lightwalk
