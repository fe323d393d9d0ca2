// PNG and JPEG files by OpenImageIO.

#include <filesystem>

#include "common/files/read_file.hpp"
#include "common/image/openimageio.hpp"
#include "common/image/orientation.hpp"
#include "common/image/picture_file.hpp"

namespace lightwalk::openimageio {
namespace {

/// 200 MB of texture.
constexpr std::int64_t most_texels = std::int64_t{1} << 26;

/// A file that is no larger than any picture.
constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 30;

PictureFile inspect(const std::string& path) {
  if (std::filesystem::file_size(path) > most_bytes) {
    return {"it is larger than 1 GB", 1};
  }
  return inspect_picture(read_file(path, most_bytes));
}

/// Reads the colors as they are stored: three values a pixel, upright. Grey
/// becomes three equal channels, and what is transparent keeps its color.
template <class Pixel>
std::string read_colors(const std::string& path, std::int64_t most,
                        TypeDesc type, int& width, int& height,
                        std::vector<Pixel>& pixels) {
  const PictureFile file = inspect(path);
  if (!file.error.empty()) return file.error;
  // Else each color is multiplied by its alpha.
  ImageSpec as_stored;
  as_stored.attribute("oiio:UnassociatedAlpha", 1);
  std::string error;
  const auto in =
      open_as(file.is_jpeg ? "jpeg" : "png", path, as_stored, error);
  if (!in) return error;
  const ImageSpec spec = in->spec(0);
  error = check_size(spec.width, spec.height, most);
  if (!error.empty()) return error;
  using Number = std::decay_t<decltype(pixels[0][0])>;
  const std::size_t channels = spec.nchannels >= 3 ? 3 : 1;
  width = spec.width;
  height = spec.height;
  pixels.resize(static_cast<std::size_t>(width) *
                static_cast<std::size_t>(height));
  std::vector<Number> values(pixels.size() * channels);
  if (!in->read_image(0, 0, 0, static_cast<int>(channels), type,
                      values.data())) {
    return reason(in->geterror(), "it cannot be read");
  }
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Number* color = &values[i * channels];
    pixels[i] = {color[0], color[channels / 2], color[channels - 1]};
  }
  turn_upright(file.orientation, width, height, pixels);
  return "";
}

}  // namespace

std::string encode_png(const Image& image, float gamma, std::string& bytes) {
  ImageSpec spec(image.width, image.height, 3, TypeDesc::UINT8);
  // The chunk gAMA. An sRGB chunk would claim a curve that was not used.
  spec.attribute("oiio:ColorSpace", "GammaCorrected");
  spec.attribute("oiio:Gamma", gamma);
  spec.attribute("DateTime", date);
  return encode("png", spec, &image.pixels[0].x, bytes);
}

std::string read_png(const std::string& path, Image& image) {
  return read_colors(path, most_pixels, TypeDesc::FLOAT, image.width,
                     image.height, image.pixels);
}

std::string read_texture(const std::string& path, Texture& texture) {
  return read_colors(path, most_texels, TypeDesc::UINT8, texture.width,
                     texture.height, texture.texels);
}

}  // namespace lightwalk::openimageio
