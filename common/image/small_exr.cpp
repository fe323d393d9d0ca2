// EXR files by tinyexr, of the kinds that it reads without a fault.

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "common/image/exr_header.hpp"
#include "common/image/exr_layers.hpp"
#include "common/files/read_file.hpp"
#include "common/files/file_path.hpp"
#include "common/image/orientation.hpp"
#include "common/image/small_exr_parts.hpp"
#include "common/image/small_images.hpp"

namespace lightwalk::small_images {
namespace {

/// A file that is no larger than any picture.
constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 31;

/// What OpenImageIO reads and this does not.
std::string check_kind(const ExrTraits& traits) {
  if (traits.deep) return "it is not a flat image";
  if (!traits.whole) return "it is cut off: its header is not whole";
  if (traits.tiled) {
    return "its pixels are in tiles, and without OpenImageIO only rows can "
           "be read";
  }
  if (traits.subsampled) {
    return "one of its channels has not a value in each pixel, and without "
           "OpenImageIO such a file cannot be read";
  }
  constexpr std::array names = {
      "no compression", "RLE", "ZIPS", "ZIP",  "PIZ",
      "PXR24",          "B44", "B44A", "DWAA", "DWAB"};
  for (const int kind : traits.compressions) {
    if (kind == 0 || kind == 2 || kind == 3) continue;
    const auto index = static_cast<std::size_t>(kind);
    return "it is packed by " +
           (kind >= 0 && index < names.size()
                ? std::string(names[index])
                : "number " + std::to_string(kind)) +
           ", and without OpenImageIO only ZIP, ZIPS and no compression can "
           "be read";
  }
  return "";
}

std::vector<ExrPart> parts_of(const ExrParts& file) {
  std::vector<ExrPart> parts;
  for (std::size_t i = 0; i < file.size(); ++i) {
    ExrPart& part = parts.emplace_back();
    part.name = file.header(i).name;
    for (int c = 0; c < file.header(i).num_channels; ++c) {
      part.channels.emplace_back(file.header(i).channels[c].name);
    }
  }
  return parts;
}

/// The bytes of an attribute, or none where there is none of this type.
std::string attribute(const EXRHeader& header, const char* name,
                      const char* type) {
  for (int i = 0; i < header.num_custom_attributes; ++i) {
    const EXRAttribute& one = header.custom_attributes[i];
    if (std::strcmp(one.name, name) == 0 &&
        std::strcmp(one.type, type) == 0) {
      return {reinterpret_cast<const char*>(one.value),
              static_cast<std::size_t>(one.size)};
    }
  }
  return "";
}

template <class Number>
Number number(const EXRHeader& header, const char* name, const char* type,
              Number otherwise) {
  const std::string bytes = attribute(header, name, type);
  Number value = otherwise;
  if (bytes.size() == sizeof value) {
    std::memcpy(&value, bytes.data(), sizeof value);
  }
  return value;
}

RenderInfo description(const EXRHeader& header) {
  const auto text = [&](const char* key) {
    // Ends at a NUL, as an empty text does for tinyexr.
    return std::string(attribute(header, key, "string").c_str());
  };
  const auto whole = [&](const char* key) {
    return static_cast<std::uint64_t>(
        std::strtoull(text(key).c_str(), nullptr, 10));
  };
  RenderInfo info;
  info.stage = text("lightwalk:stage");
  info.samples_per_pixel = static_cast<double>(
      number(header, "lightwalk:samples_per_pixel", "float", 0.0f));
  info.seed = whole("lightwalk:seed");
  info.max_bounces = number(header, "lightwalk:max_bounces", "int", 0);
  info.scene_hash = text("lightwalk:scene_hash");
  info.rays = whole("lightwalk:rays");
  info.dropped = whole("lightwalk:dropped");
  info.version = text("lightwalk:version");
  return info;
}

/// A channel's value. Whole numbers are parts of the largest, as OpenImageIO
/// reads them.
float value(const EXRHeader& header, const EXRImage& image, int channel,
            std::size_t at) {
  const unsigned char* const values = image.images[channel];
  if (header.pixel_types[channel] != TINYEXR_PIXELTYPE_UINT) {
    return reinterpret_cast<const float*>(values)[at];
  }
  const auto whole = reinterpret_cast<const std::uint32_t*>(values)[at];
  return static_cast<float>(whole / 4294967295.0);
}

/// Takes one layer. Where the pixels stored are not those displayed, there is
/// black around them.
std::string take_layer(const ExrParts& file, const ExrLayer& layer,
                       Image& result) {
  const auto part = static_cast<std::size_t>(layer.part);
  const EXRHeader& header = file.header(part);
  const EXRBox2i &data = header.data_window, &shown = header.display_window;
  const std::int64_t width = std::int64_t{shown.max_x} - shown.min_x + 1;
  const std::int64_t height = std::int64_t{shown.max_y} - shown.min_y + 1;
  const std::string error = check_size(width, height);
  if (!error.empty()) return error;
  const int left = std::max(data.min_x, shown.min_x);
  const int top = std::max(data.min_y, shown.min_y);
  const int right = std::min(data.max_x, shown.max_x);
  const int bottom = std::min(data.max_y, shown.max_y);
  if (left > right || top > bottom) {
    return "none of its pixels is inside its display window";
  }
  result = Image(static_cast<int>(width), static_cast<int>(height));
  const EXRImage& image = file.image(part);
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const std::size_t at = static_cast<std::size_t>(y - data.min_y) *
                                 static_cast<std::size_t>(image.width) +
                             static_cast<std::size_t>(x - data.min_x);
      for (int c = 0; c < 3; ++c) {
        result.at(x - shown.min_x, y - shown.min_y)[c] = value(
            header, image, layer.channels[static_cast<std::size_t>(c)], at);
      }
    }
  }
  turn_upright(number(header, "Orientation", "int", 1), result.width,
               result.height, result.pixels);
  return "";
}

}  // namespace

std::string read_exr(const std::string& path, RenderResult& result) {
  if (std::filesystem::file_size(file_path(path)) > most_bytes) {
    return "it is larger than 2 GB";
  }
  const std::string bytes = read_file(path, most_bytes);
  std::istringstream stream(bytes);
  ExrHeader claims(stream, bytes.size());
  std::string error = claims.check();
  if (error.empty()) error = check_kind(claims.traits());
  if (!error.empty()) return error;
  ExrParts file;
  error = file.read(bytes);
  if (!error.empty()) return error;
  const std::vector<ExrPart> parts = parts_of(file);
  const ExrChoice choice = choose_picture(parts);
  if (!choice.error.empty()) return choice.error;
  error = file.read_pixels(bytes);
  if (!error.empty()) return error;
  result.note = choice.note;
  result.info =
      description(file.header(static_cast<std::size_t>(choice.picture.part)));
  error = take_layer(file, choice.picture, result.radiance);
  for (const ExrLayer& layer : color_layers(parts)) {
    if (!error.empty() || layer.name != "variance") continue;
    error = take_layer(file, layer, result.variance);
    if (error.empty() && (result.variance.width != result.radiance.width ||
                          result.variance.height != result.radiance.height)) {
      error = "its variance has another size than its picture";
    }
  }
  return error;
}

}  // namespace lightwalk::small_images
