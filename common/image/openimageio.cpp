// EXR and PNG files by OpenImageIO: the one file of the core that is compiled
// by itself, since its header takes seconds and its libraries a second to
// load.

#include <OpenImageIO/imageio.h>

#include <memory>

#include "common/image/image_codecs.hpp"

#ifndef _WIN32
#include <fcntl.h>
#include <unistd.h>
#endif

namespace {

using lightwalk::Image;
using lightwalk::RenderInfo;
using lightwalk::RenderResult;
using lightwalk::Vec3;
using OIIO::ImageInput;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

/// Fixed, so that equal renders are equal files.
constexpr const char* date = "2000:01:01 00:00:00";

/// More pixels than any picture has that a render could have made.
constexpr std::int64_t most_pixels = std::int64_t{1} << 28;

/// 200 MB of texture.
constexpr std::int64_t most_texels = std::int64_t{1} << 26;

ImageSpec part(const Image& image, const std::string& name) {
  ImageSpec spec(image.width, image.height, 3, TypeDesc::FLOAT);
  spec.channelnames = {"R", "G", "B"};
  spec.attribute("oiio:subimagename", name);
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", date);
  return spec;
}

void describe(const RenderInfo& info, ImageSpec& spec) {
  // Whole numbers of 64 bits as text: EXR's integers have 32.
  spec.attribute("lightwalk:stage", info.stage);
  spec.attribute("lightwalk:samples_per_pixel",
                 static_cast<float>(info.samples_per_pixel));
  spec.attribute("lightwalk:seed", std::to_string(info.seed));
  spec.attribute("lightwalk:max_bounces", info.max_bounces);
  spec.attribute("lightwalk:scene_sha256", info.scene_sha256);
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
  info.scene_sha256 = text("lightwalk:scene_sha256");
  info.rays = number("lightwalk:rays");
  info.dropped = number("lightwalk:dropped");
  info.version = text("lightwalk:version");
  return info;
}

std::string reason(const std::string& error, const char* otherwise) {
  return error.empty() ? otherwise : error;
}

/// OpenEXR does not notice that the disk was full when its last block was
/// written. The file is whole if its last row can be read.
std::string check_last_row(const std::string& path, const Image& last,
                           int number) {
  std::vector<Vec3> row(static_cast<std::size_t>(last.width));
  auto in = ImageInput::open(path);
  if (in && in->read_scanlines(number, 0, last.height - 1, last.height, 0, 0,
                               3, TypeDesc::FLOAT, row.data())) {
    return "";
  }
  OIIO::geterror();
  return "the file is cut off: is the disk full?";
}

std::string write_exr(const std::string& path, const RenderResult& result) {
  std::unique_ptr<ImageOutput> out = ImageOutput::create("exr");
  if (!out) return reason(OIIO::geterror(), "EXR files are not supported");
  const Image* images[] = {&result.radiance, &result.variance};
  ImageSpec specs[] = {part(result.radiance, "radiance"),
                       part(result.variance, "variance")};
  const int parts = result.variance.pixels.empty() ? 1 : 2;
  describe(result.info, specs[0]);
  if (!out->open(path, parts, specs)) {
    return reason(out->geterror(), "open failed");
  }
  for (int i = 0; i < parts; ++i) {
    if (i > 0 && !out->open(path, specs[i], ImageOutput::AppendSubimage)) {
      return reason(out->geterror(), "the second part cannot be added");
    }
    if (!out->write_image(TypeDesc::FLOAT, images[i]->pixels.data())) {
      return reason(out->geterror(), "write failed");
    }
  }
  if (!out->close()) return reason(out->geterror(), "close failed");
  return check_last_row(path, *images[parts - 1], parts - 1);
}

std::string write_png(const std::string& path, const Image& image) {
  std::unique_ptr<ImageOutput> out = ImageOutput::create("png");
  if (!out) return reason(OIIO::geterror(), "PNG files are not supported");
  ImageSpec spec(image.width, image.height, 3, TypeDesc::UINT8);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("DateTime", date);
  if (!out->open(path, spec)) return reason(out->geterror(), "open failed");
  if (!out->write_image(TypeDesc::FLOAT, image.pixels.data())) {
    return reason(out->geterror(), "write failed");
  }
  return out->close() ? "" : reason(out->geterror(), "close failed");
}

/// What is wrong with the header, before a byte is allocated for it.
std::string check(const ImageSpec& spec, std::int64_t most) {
  if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1) {
    return "it is not a flat image";
  }
  const std::int64_t pixels = std::int64_t{spec.width} * spec.height;
  if (pixels > most) {
    return "its header claims " + std::to_string(spec.width) + " x " +
           std::to_string(spec.height) + " pixels, more than " +
           std::to_string(most);
  }
  return "";
}

/// Reads one part into `image`; grey images become three equal channels.
std::string read_part(ImageInput& in, int number, Image& image) {
  const ImageSpec spec = in.spec(number);
  if (std::string error = check(spec, most_pixels); !error.empty()) {
    return error;
  }
  int first = spec.channelindex("R");
  const bool color = first >= 0 && spec.channelindex("G") == first + 1 &&
                     spec.channelindex("B") == first + 2;
  if (!color) first = 0;
  const int channels = color || spec.nchannels >= 3 ? 3 : 1;
  image = Image(spec.width, spec.height);
  std::vector<float> values(image.pixels.size() *
                            static_cast<std::size_t>(channels));
  if (!in.read_image(number, 0, first, first + channels, TypeDesc::FLOAT,
                     values.data())) {
    return reason(in.geterror(), "it cannot be read");
  }
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = channels == 1 ? Vec3(values[i])
                                    : Vec3(values[3 * i], values[3 * i + 1],
                                           values[3 * i + 2]);
  }
  return "";
}

std::string read_exr(const std::string& path, RenderResult& result) {
  auto in = ImageInput::open(path);
  if (!in) return reason(OIIO::geterror(), "it is not an image");
  int radiance = 0, variance = -1;
  for (int i = 0;; ++i) {
    const ImageSpec spec = in->spec(i);
    if (spec.undefined()) break;
    const auto name = spec.get_string_attribute("oiio:subimagename");
    if (name == "radiance") radiance = i;
    if (name == "variance") variance = i;
  }
  in->geterror();  // asking for one part too many is how they are counted
  result.info = description(in->spec(radiance));
  std::string error = read_part(*in, radiance, result.radiance);
  if (error.empty() && variance >= 0) {
    error = read_part(*in, variance, result.variance);
  }
  return error;
}

std::string read_png(const std::string& path, Image& image) {
  auto in = ImageInput::open(path);
  if (!in) return reason(OIIO::geterror(), "it is not an image");
  return read_part(*in, 0, image);
}

std::string read_texture(const std::string& path,
                         lightwalk::Texture& texture) {
  auto in = ImageInput::open(path);
  if (!in) return reason(OIIO::geterror(), "it is not an image");
  const ImageSpec spec = in->spec(0);
  if (std::string error = check(spec, most_texels); !error.empty()) {
    return error;
  }
  const int channels = spec.nchannels >= 3 ? 3 : 1;
  const auto pixels = static_cast<std::size_t>(spec.width) *
                      static_cast<std::size_t>(spec.height);
  std::vector<std::uint8_t> bytes(pixels *
                                  static_cast<std::size_t>(channels));
  if (!in->read_image(0, 0, 0, channels, TypeDesc::UINT8, bytes.data())) {
    return reason(in->geterror(), "it cannot be read");
  }
  texture.width = spec.width;
  texture.height = spec.height;
  texture.texels.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      texture.texels[i][c] = channels == 3 ? bytes[3 * i + c] : bytes[i];
    }
  }
  return "";
}

/// libpng prints its errors itself, beside those that it returns. While one of
/// these lives, nobody prints to stderr.
class QuietStderr {
 public:
#ifndef _WIN32
  QuietStderr() : kept_(dup(STDERR_FILENO)) {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) {
      dup2(nowhere, STDERR_FILENO);
      close(nowhere);
    }
  }
  ~QuietStderr() {
    if (kept_ >= 0) {
      dup2(kept_, STDERR_FILENO);
      close(kept_);
    }
  }
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

 private:
  int kept_;
#endif
};

/// No exception crosses the border between the library and the program.
template <auto function, class... Arguments>
std::string guarded(Arguments... arguments) {
  try {
    const QuietStderr quiet;
    return function(arguments...);
  } catch (const std::bad_alloc&) {
    return "there is not enough memory for it";
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace

#ifdef _WIN32
#define LIGHTWALK_EXPORT __declspec(dllexport)
#else
#define LIGHTWALK_EXPORT __attribute__((visibility("default")))
#endif

extern "C" LIGHTWALK_EXPORT const lightwalk::ImageCodecs*
lightwalk_image_codecs();

const lightwalk::ImageCodecs* lightwalk_image_codecs() {
  static const lightwalk::ImageCodecs library = {
      guarded<write_exr, const std::string&, const RenderResult&>,
      guarded<write_png, const std::string&, const Image&>,
      guarded<read_exr, const std::string&, RenderResult&>,
      guarded<read_png, const std::string&, Image&>,
      guarded<read_texture, const std::string&, lightwalk::Texture&>};
  return &library;
}
