// EXR files by OpenImageIO. The mean radiance is in the channels R, G, B,
// which every reader shows, and the variance in the layer `variance` beside
// it, in one part: most readers know but one part.

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "common/image/exr_header.hpp"
#include "common/image/exr_layers.hpp"
#include "common/image/openimageio.hpp"
#include "common/image/orientation.hpp"

namespace lightwalk::openimageio {
namespace {

void describe(const RenderInfo& info, ImageSpec& spec) {
  // Whole numbers of 64 bits as text: EXR's integers have 32.
  spec.attribute("lightwalk:stage", info.stage);
  spec.attribute("lightwalk:samples_per_pixel",
                 static_cast<float>(info.samples_per_pixel));
  spec.attribute("lightwalk:seed", std::to_string(info.seed));
  spec.attribute("lightwalk:max_bounces", info.max_bounces);
  spec.attribute("lightwalk:scene_hash", info.scene_hash);
  spec.attribute("lightwalk:rays", std::to_string(info.rays));
  spec.attribute("lightwalk:dropped", std::to_string(info.dropped));
  spec.attribute("lightwalk:version", info.version);
  spec.attribute("Software", "Lightwalk " + info.version);
}

RenderInfo description(const ImageSpec& spec) {
  const auto text = [&](const char* key) {
    return std::string(spec.get_string_attribute(key));
  };
  const auto number = [&](const char* key) {
    return static_cast<std::uint64_t>(
        std::strtoull(text(key).c_str(), nullptr, 10));
  };
  RenderInfo info;
  info.stage = text("lightwalk:stage");
  info.samples_per_pixel = static_cast<double>(
      spec.get_float_attribute("lightwalk:samples_per_pixel"));
  info.seed = number("lightwalk:seed");
  info.max_bounces = spec.get_int_attribute("lightwalk:max_bounces");
  info.scene_hash = text("lightwalk:scene_hash");
  info.rays = number("lightwalk:rays");
  info.dropped = number("lightwalk:dropped");
  info.version = text("lightwalk:version");
  return info;
}

/// Reads one layer. Where the pixels stored are not those displayed, there is
/// black around them.
std::string read_layer(ImageInput& in, const ExrLayer& layer, Image& image) {
  const ImageSpec spec = in.spec(layer.part);
  if (spec.deep || spec.depth > 1) return "it is not a flat image";
  std::string error = check_size(spec.width, spec.height);
  if (error.empty()) {
    error = check_size(spec.full_width, spec.full_height);
  }
  if (!error.empty()) return error;
  const int left = std::max(spec.x, spec.full_x);
  const int top = std::max(spec.y, spec.full_y);
  const std::int64_t right =
      std::min(std::int64_t{spec.x} + spec.width,
               std::int64_t{spec.full_x} + spec.full_width);
  const std::int64_t bottom =
      std::min(std::int64_t{spec.y} + spec.height,
               std::int64_t{spec.full_y} + spec.full_height);
  if (left >= right || top >= bottom) {
    return "none of its pixels is inside its display window";
  }
  const auto [first, last] =
      std::minmax_element(layer.channels.begin(), layer.channels.end());
  const auto channels = static_cast<std::size_t>(*last - *first + 1);
  std::vector<float> values(static_cast<std::size_t>(spec.width) *
                            static_cast<std::size_t>(spec.height) * channels);
  if (!in.read_image(layer.part, 0, *first, *last + 1, TypeDesc::FLOAT,
                     values.data())) {
    return reason(in.geterror(), "it cannot be read");
  }
  image = Image(spec.full_width, spec.full_height);
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const float* pixel = &values[(static_cast<std::size_t>(y - spec.y) *
                                        static_cast<std::size_t>(spec.width) +
                                    static_cast<std::size_t>(x - spec.x)) *
                                   channels];
      for (int c = 0; c < 3; ++c) {
        image.at(x - spec.full_x, y - spec.full_y)[c] =
            pixel[layer.channels[static_cast<std::size_t>(c)] - *first];
      }
    }
  }
  turn_upright(spec.get_int_attribute("Orientation", 1), image.width,
               image.height, image.pixels);
  return "";
}

std::vector<ExrPart> parts_of(ImageInput& in) {
  std::vector<ExrPart> parts;
  for (int i = 0;; ++i) {
    const ImageSpec spec = in.spec(i);
    if (spec.undefined()) break;
    parts.push_back(
        {std::string(spec.get_string_attribute("oiio:subimagename")),
         spec.channelnames});
  }
  in.geterror();  // asking for one part too many is how they are counted
  return parts;
}

}  // namespace

std::string encode_exr(const RenderResult& result, std::string& bytes) {
  const Image& mean = result.radiance;
  const bool both = !result.variance.pixels.empty();
  ImageSpec spec(mean.width, mean.height, both ? 6 : 3, TypeDesc::FLOAT);
  spec.channelnames = {"R", "G", "B"};
  if (both) {
    for (const char* name : {"variance.R", "variance.G", "variance.B"}) {
      spec.channelnames.emplace_back(name);
    }
  }
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", date);
  describe(result.info, spec);
  std::vector<Vec3> pixels;
  pixels.reserve(mean.pixels.size() * (both ? 2 : 1));
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
    pixels.push_back(mean.pixels[i]);
    if (both) pixels.push_back(result.variance.pixels[i]);
  }
  return encode("exr", spec, &pixels[0].x, bytes);
}

std::string read_exr(const std::string& path, RenderResult& result) {
  std::ifstream file(path, std::ios::binary);
  std::string error =
      ExrHeader(file, std::filesystem::file_size(path)).check();
  if (!error.empty()) return error;
  const auto in = open_as("exr", path, ImageSpec(), error);
  if (!in) return error;
  const std::vector<ExrPart> parts = parts_of(*in);
  const ExrChoice choice = choose_picture(parts);
  if (!choice.error.empty()) return choice.error;
  result.note = choice.note;
  result.info = description(in->spec(choice.picture.part));
  error = read_layer(*in, choice.picture, result.radiance);
  for (const ExrLayer& layer : color_layers(parts)) {
    if (!error.empty() || layer.name != "variance") continue;
    error = read_layer(*in, layer, result.variance);
    if (error.empty() && (result.variance.width != result.radiance.width ||
                          result.variance.height != result.radiance.height)) {
      error = "its variance has another size than its picture";
    }
  }
  return error;
}

}  // namespace lightwalk::openimageio
