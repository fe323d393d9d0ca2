#pragma once

// The small interface to OpenImageIO, or to two smaller libraries where that
// is not there, which few compiled files implement. It is loaded when the
// first image needs it: at the start of every program it would cost a second.

#include <string>
#include <string_view>

#include "common/image/render_result.hpp"
#include "common/image/texture.hpp"
#include "common/files/windows.hpp"

#ifndef _WIN32
#include <dlfcn.h>
#endif

namespace lightwalk {

/// Each function returns what went wrong, or an empty string.
struct ImageCodecs {
  /// The bytes of an EXR file.
  std::string (*encode_exr)(const RenderResult&, std::string& bytes);
  /// Those of a PNG file with eight bits a channel; the image is already in
  /// [0, 1], and light to the power of 1 / `gamma`.
  std::string (*encode_png)(const Image&, float gamma, std::string& bytes);
  /// Reads the channels R, G, B, and the layer `variance` if there is one;
  /// of files with other layers, one that is called like a picture.
  std::string (*read_exr)(const std::string& path, RenderResult&);
  /// Eight or sixteen bits a channel, to values in [0, 1], as they are
  /// stored, whatever the alpha; upright.
  std::string (*read_png)(const std::string& path, Image&);
  /// Colors as they are stored, in 8 bits, whatever the alpha; grey becomes
  /// three equal channels. Upright, as EXIF's orientation asks.
  std::string (*read_texture)(const std::string& path, Texture&);
};

using GetImageCodecs = const ImageCodecs*();
inline constexpr const char* image_codecs_symbol = "lightwalk_image_codecs";

/// The function that a module has, looked for beside the program; null and
/// the reason in `error` where there is none.
inline GetImageCodecs* load_image_codecs(const char* file,
                                         std::string& error) {
#ifdef _WIN32
  const HMODULE module = LoadLibraryA(file);
  if (!module) error = std::string("there is no ") + file;
  // By way of a function without a type: each cast is warned of otherwise.
  return module
             ? reinterpret_cast<GetImageCodecs*>(reinterpret_cast<void (*)()>(
                   GetProcAddress(module, image_codecs_symbol)))
             : nullptr;
#else
#ifdef __APPLE__
  void* const module =
      dlopen((std::string("@rpath/") + file).c_str(), RTLD_NOW | RTLD_LOCAL);
#else
  void* const module = dlopen(file, RTLD_NOW | RTLD_LOCAL);
#endif
  if (!module) error = dlerror();
  return module ? reinterpret_cast<GetImageCodecs*>(
                      dlsym(module, image_codecs_symbol))
                : nullptr;
#endif
}

/// The library, or null and the reason in `error`.
inline const ImageCodecs* image_codecs(std::string& error) {
  if (std::string_view(LIGHTWALK_IMAGE_LIBRARY).empty()) {
    error =
        "needs OpenImageIO, or tinyexr and stb, and this program was "
        "built with neither; .pfm and .ppm need none";
    return nullptr;
  }
  static std::string why;
  static GetImageCodecs* const get =
      load_image_codecs(LIGHTWALK_IMAGE_LIBRARY, why);
  if (!get) {
    error = "needs the image library, which cannot be loaded: " + why;
    return nullptr;
  }
  return get();
}

}  // namespace lightwalk
