// EXR files in memory, by tinyexr: as openimageio_exr.cpp writes them.

#include <tinyexr.h>

#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "common/image/small_images.hpp"

namespace lightwalk::small_images {
namespace {

/// What is said about the picture, as EXR's attributes: names, types, bytes.
class Attributes {
 public:
  void text(const char* name, const std::string& value) {
    add(name, "string", value);
  }
  void number(const char* name, int value) { add_number(name, "int", value); }
  void number(const char* name, float value) {
    add_number(name, "float", value);
  }

  /// For tinyexr, as long as this lives and nothing is added.
  std::vector<EXRAttribute> list() {
    std::vector<EXRAttribute> attributes;
    for (One& one : all_) {
      EXRAttribute& next = attributes.emplace_back();
      std::strncpy(next.name, one.name, sizeof next.name - 1);
      std::strncpy(next.type, one.type, sizeof next.type - 1);
      next.value = reinterpret_cast<unsigned char*>(one.bytes.data());
      next.size = static_cast<int>(one.bytes.size());
    }
    return attributes;
  }

 private:
  struct One {
    const char *name, *type;
    std::string bytes;
  };
  void add(const char* name, const char* type, const std::string& bytes) {
    all_.push_back({name, type, bytes});
  }
  /// Four bytes, the lowest first.
  template <class Number>
  void add_number(const char* name, const char* type, Number value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) {
      bytes += static_cast<char>(bits >> shift & 255);
    }
    add(name, type, bytes);
  }
  std::vector<One> all_;
};

Attributes describe(const RenderInfo& info) {
  // Whole numbers of 64 bits as text: EXR's integers have 32.
  Attributes all;
  all.text("lightwalk:stage", info.stage);
  all.number("lightwalk:samples_per_pixel",
             static_cast<float>(info.samples_per_pixel));
  all.text("lightwalk:seed", std::to_string(info.seed));
  all.number("lightwalk:max_bounces", info.max_bounces);
  all.text("lightwalk:scene_hash", info.scene_hash);
  all.text("lightwalk:rays", std::to_string(info.rays));
  all.text("lightwalk:dropped", std::to_string(info.dropped));
  all.text("lightwalk:version", info.version);
  all.text("Software", "Lightwalk " + info.version);
  return all;
}

}  // namespace

std::string encode_exr(const RenderResult& result, std::string& bytes) {
  // By name, as EXR wants them.
  static constexpr std::array<const char*, 6> names = {
      "B", "G", "R", "variance.B", "variance.G", "variance.R"};
  const Image& mean = result.radiance;
  const std::size_t count = result.variance.pixels.empty() ? 3 : 6;
  std::vector<std::vector<float>> values(count);
  std::vector<unsigned char*> images;
  std::vector<EXRChannelInfo> channels(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Image& from = i < 3 ? mean : result.variance;
    values[i].reserve(from.pixels.size());
    const auto color = static_cast<int>(2 - i % 3);
    for (const Vec3& pixel : from.pixels) values[i].push_back(pixel[color]);
    images.push_back(reinterpret_cast<unsigned char*>(values[i].data()));
    std::strncpy(channels[i].name, names[i], sizeof channels[i].name - 1);
  }
  std::vector<int> types(count, TINYEXR_PIXELTYPE_FLOAT);
  Attributes about = describe(result.info);
  std::vector<EXRAttribute> attributes = about.list();

  EXRHeader header;
  InitEXRHeader(&header);
  header.num_channels = static_cast<int>(count);
  header.channels = channels.data();
  header.pixel_types = types.data();
  header.requested_pixel_types = types.data();
  header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
  header.num_custom_attributes = static_cast<int>(attributes.size());
  header.custom_attributes = attributes.data();
  EXRImage image;
  InitEXRImage(&image);
  image.num_channels = header.num_channels;
  image.images = images.data();
  image.width = mean.width;
  image.height = mean.height;

  unsigned char* memory = nullptr;
  const char* why = nullptr;
  const std::size_t size =
      SaveEXRImageToMemory(&image, &header, &memory, &why);
  const std::unique_ptr<unsigned char, void (*)(void*)> kept(memory,
                                                             std::free);
  const std::string error = why ? why : "it cannot be encoded";
  FreeEXRErrorMessage(why);
  if (size == 0 || !memory) return error;
  bytes.assign(reinterpret_cast<const char*>(memory), size);
  return "";
}

}  // namespace lightwalk::small_images
