#pragma once

// The small interface to OpenImageIO, which few compiled files implement. It
// is loaded when the first image needs it: at the start of every program it
// would cost a second.

#include <string>

#include "common/image/render_result.hpp"
#include "common/image/texture.hpp"

#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#include <windows.h>
#else
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

/// The library, or null and the reason in `error`.
inline const ImageCodecs* image_codecs(std::string& error) {
#ifdef _WIN32
  static const HMODULE module = LoadLibraryA(LIGHTWALK_IMAGE_LIBRARY);
  static const std::string why = module ? "" : "it is not beside the program";
  const auto get = module ? reinterpret_cast<GetImageCodecs*>(
                                GetProcAddress(module, image_codecs_symbol))
                          : nullptr;
#else
#ifdef __APPLE__
  static constexpr const char* file = "@rpath/" LIGHTWALK_IMAGE_LIBRARY;
#else
  static constexpr const char* file = LIGHTWALK_IMAGE_LIBRARY;
#endif
  static void* const module = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  static const std::string why = module ? "" : dlerror();
  const auto get = module ? reinterpret_cast<GetImageCodecs*>(
                                dlsym(module, image_codecs_symbol))
                          : nullptr;
#endif
  if (!get) {
    error = "the image library cannot be loaded: " + why;
    return nullptr;
  }
  return get();
}

}  // namespace lightwalk
