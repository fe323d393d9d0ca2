// The module that programs load for EXR files and for other formats of
// OpenImageIO. It is a file of its own, since OpenImageIO's header takes
// seconds to compile and its libraries a second to load.
//
// Our EXR files have the mean radiance in the channels R, G, B, which every
// reader shows, and the variance in the layer `variance`. Both are in one
// part, since most readers support only one part.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <array>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "common/files/file_path.hpp"
#include "common/image/image_limits.hpp"
#include "common/image/image_module.hpp"

namespace lightwalk {

namespace {

using Channels = std::array<int, 3>;  // where they are in the file

[[noreturn]] void fail(const std::string& why, const char* otherwise) {
  throw FileError(why.empty() ? otherwise : why);
}

// ## Writing

std::string encode_exr(const RenderResult& result, std::string& bytes) {
  const Image& mean = result.radiance;
  const bool both = !result.variance.pixels.empty();
  OIIO::ImageSpec spec(mean.width, mean.height, both ? 6 : 3,
                       OIIO::TypeDesc::FLOAT);
  spec.channelnames = {"R", "G", "B"};
  if (both) {
    for (const char* name : {"variance.R", "variance.G", "variance.B"}) {
      spec.channelnames.emplace_back(name);
    }
  }
  spec.attribute("compression", "zip");
  // Fixed, so that equal renders make equal files.
  spec.attribute("DateTime", "2000:01:01 00:00:00");
  spec.attribute("Software", "Lightwalk " + result.info.version + ", " +
                                 result.info.stage);
  for (const auto& [name, text] : texts_of(result.info)) {
    spec.attribute("lightwalk:" + name, text);
  }
  std::vector<Vec3> pixels;
  pixels.reserve(mean.pixels.size() * (both ? 2 : 1));
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
    pixels.push_back(mean.pixels[i]);
    if (both) pixels.push_back(result.variance.pixels[i]);
  }
  const auto out = OIIO::ImageOutput::create("exr");
  if (!out) fail(OIIO::geterror(), "EXR is not supported");
  OIIO::Filesystem::IOVecOutput file;
  if (!out->set_ioproxy(&file) || !out->open("image.exr", spec) ||
      !out->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) ||
      !out->close()) {
    fail(out->geterror(), "it cannot be encoded");
  }
  bytes.assign(file.buffer().begin(), file.buffer().end());
  return "";
}

/// Encodes a picture of several blocks: with the first one, OpenImageIO and
/// OpenEXR start the threads that they use from then on.
std::string start() {
  RenderResult picture{Image(64, 64), Image(64, 64), {}};
  std::string bytes;
  try {
    return encode_exr(picture, bytes);
  } catch (const std::exception& error) {
    fail("it does not start (" + std::string(error.what()) +
             "); are threads or memory short?",
         "");
  }
}

// ## Reading

/// Opens a file as this format and no other: ImageInput::open would try a
/// broken file with each of OpenImageIO's readers in turn.
std::unique_ptr<OIIO::ImageInput> open_as(const char* format,
                                          const std::string& name) {
  auto in = OIIO::ImageInput::create(format);
  OIIO::ImageSpec spec, as_stored;
  // Otherwise each color is multiplied by its alpha.
  as_stored.attribute("oiio:UnassociatedAlpha", 1);
  if (!in) fail(OIIO::geterror(), "its format is not supported");
  if (!in->open(name, spec, as_stored)) {
    fail(in->geterror(), "it is not an image");
  }
  return in;
}

/// The pixels of the display window, all channels of each, row by row.
template <class Number>
struct Pixels {
  int width = 0, height = 0;
  std::size_t channels = 0;
  std::vector<Number> values = {};

  /// Three of the channels.
  template <class Pixel>
  void copy(const Channels& which, std::vector<Pixel>& to) const {
    to.resize(values.size() / channels);
    for (std::size_t i = 0; i < to.size(); ++i) {
      const Number* const pixel = &values[i * channels];
      to[i] = {pixel[which[0]], pixel[which[1]], pixel[which[2]]};
    }
  }
};

/// Reads pixels, upright, and black where the file has none. Throws before it
/// allocates memory if the file is too small for what it claims.
template <class Number>
Pixels<Number> read_pixels(OIIO::ImageInput& in, const std::string& name,
                           OIIO::TypeDesc type, std::int64_t most) {
  OIIO::ImageSpec spec = in.spec();
  if (spec.deep || spec.depth > 1) fail("", "it is not a flat image");
  check_size(spec.width, spec.height, most);
  check_size(spec.full_width, spec.full_height, most);
  const std::string packer(spec.get_string_attribute("compression"));
  check_packed(spec.width, spec.height,
               static_cast<double>(spec.image_bytes(true)),
               std::filesystem::file_size(file_path(name)),
               packer == "zip" || packer == "none" ? 1032 : 65536);
  spec.set_format(type);
  OIIO::ImageBuf stored(spec);
  if (!in.read_image(0, 0, 0, spec.nchannels, type, stored.localpixels())) {
    fail(in.geterror(), "it cannot be read");
  }
  const OIIO::ImageBuf upright = OIIO::ImageBufAlgo::reorient(stored);
  OIIO::ROI all = upright.roi_full();
  all.chbegin = 0;
  all.chend = spec.nchannels;
  Pixels<Number> pixels{all.width(), all.height(),
                        static_cast<std::size_t>(spec.nchannels)};
  pixels.values.resize(static_cast<std::size_t>(all.npixels()) *
                       pixels.channels);
  if (!upright.get_pixels(all, type, pixels.values.data())) {
    fail(upright.geterror(), "it cannot be read");
  }
  return pixels;
}

/// The indices of a layer's channels, such as "variance."; -1 if missing.
Channels layer(const OIIO::ImageSpec& spec, const std::string& name) {
  return {spec.channelindex(name + "R"), spec.channelindex(name + "G"),
          spec.channelindex(name + "B")};
}

bool is_there(const Channels& channels) {
  return channels[0] >= 0 && channels[1] >= 0 && channels[2] >= 0;
}

std::string read_radiance(const std::string& name, const char* format,
                          RenderResult& result) {
  const auto in = open_as(format, name);
  const OIIO::ImageSpec spec = in->spec();
  const Channels mean = layer(spec, ""), variance = layer(spec, "variance.");
  if (!is_there(mean)) {
    std::string names;
    for (const std::string& one : spec.channelnames) names += one + ", ";
    fail("its channels are " + names + "and R, G, B are expected", "");
  }
  for (const int channel : mean) {
    if (spec.channelformat(channel).is_floating_point()) continue;
    fail("its channel " + std::string(spec.channel_name(channel)) +
             " holds whole numbers, and radiance is floats",
         "");
  }
  InfoTexts texts;
  for (const OIIO::ParamValue& value : spec.extra_attribs) {
    const std::string key = value.name().string();
    constexpr std::string_view ours = "lightwalk:";
    if (key.starts_with(ours)) {
      texts[key.substr(ours.size())] = value.get_string();
    }
  }
  result.info = info_of(texts);
  const auto pixels =
      read_pixels<float>(*in, name, OIIO::TypeDesc::FLOAT, max_pixels);
  Image& image = result.radiance;
  image.width = pixels.width;
  image.height = pixels.height;
  pixels.copy(mean, image.pixels);
  if (is_there(variance)) {
    result.variance = image;
    pixels.copy(variance, result.variance.pixels);
  }
  return "";
}

std::string read_texture(const std::string& name, const char* format,
                         Texture& texture) {
  const auto in = open_as(format, name);
  if (in->spec().format.is_floating_point()) {
    fail("it holds floats, and a texture is 8 or 16 bits a channel", "");
  }
  const auto pixels =
      read_pixels<std::uint8_t>(*in, name, OIIO::TypeDesc::UINT8, max_texels);
  texture.width = pixels.width;
  texture.height = pixels.height;
  pixels.copy(pixels.channels < 3 ? Channels{0, 0, 0} : Channels{0, 1, 2},
              texture.texels);
  return "";
}

/// No exception crosses the border between the module and the program.
template <auto function, class... Arguments>
std::string guarded(Arguments... arguments) {
  try {
    return function(arguments...);
  } catch (const std::bad_alloc&) {
    return "there is not enough memory for it";
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace

}  // namespace lightwalk

#ifdef _WIN32
#define LIGHTWALK_EXPORT __declspec(dllexport)
#else
#define LIGHTWALK_EXPORT __attribute__((visibility("default")))
#endif

extern "C" LIGHTWALK_EXPORT const lightwalk::ImageModule*
lightwalk_image_module();

const lightwalk::ImageModule* lightwalk_image_module() {
  using namespace lightwalk;
  static const ImageModule module = {
      guarded<start>, guarded<encode_exr, const RenderResult&, std::string&>,
      guarded<read_radiance, const std::string&, const char*, RenderResult&>,
      guarded<read_texture, const std::string&, const char*, Texture&>};
  return &module;
}
