#pragma once

// The small interface to OpenImageIO, which one compiled file implements: a
// module that is loaded when the first file needs it. Loading it at the start
// would cost every program a second.

#include <string>
#include <string_view>

#include "common/files/file_error.hpp"
#include "common/files/windows.hpp"
#include "common/image/render_result.hpp"
#include "common/image/texture.hpp"

#ifndef _WIN32
#include <dlfcn.h>
#endif

namespace lightwalk {

/// Each function returns what went wrong, or an empty string. `format` is
/// what OpenImageIO calls it, such as "exr".
struct ImageModule {
  /// The bytes of an EXR file.
  std::string (*encode_exr)(const RenderResult&, std::string& bytes);
  /// Reads the channels R, G, B, and variance.R, .G, .B if they are there.
  std::string (*read_radiance)(const std::string& name, const char* format,
                               RenderResult&);
  /// Colors as they are stored, in 8 bits, whatever the alpha; gray becomes
  /// three equal channels.
  std::string (*read_texture)(const std::string& name, const char* format,
                              Texture&);
};

using GetImageModule = const ImageModule*();
inline constexpr const char* image_module_symbol = "lightwalk_image_module";

/// The module's only function, looked for beside the program; null, with the
/// reason in `error`, if there is none.
inline GetImageModule* load_image_module(const char* file,
                                         std::string& error) {
#ifdef _WIN32
  const HMODULE module = LoadLibraryA(file);
  if (!module) error = std::string("there is no ") + file;
  // Through an untyped function: compilers warn of a direct cast.
  return module
             ? reinterpret_cast<GetImageModule*>(reinterpret_cast<void (*)()>(
                   GetProcAddress(module, image_module_symbol)))
             : nullptr;
#else
#ifdef __APPLE__
  void* const module =
      dlopen((std::string("@rpath/") + file).c_str(), RTLD_NOW | RTLD_LOCAL);
#else
  void* const module = dlopen(file, RTLD_NOW | RTLD_LOCAL);
#endif
  if (!module) error = dlerror();
  return module ? reinterpret_cast<GetImageModule*>(
                      dlsym(module, image_module_symbol))
                : nullptr;
#endif
}

/// Loads the module for files with this ending. Throws a FileError if there
/// is none.
inline const ImageModule& image_module(std::string_view ending) {
  const std::string needs = std::string(ending) + " needs OpenImageIO, ";
  if (std::string_view(LIGHTWALK_IMAGE_MODULE).empty()) {
    throw FileError(needs + "and this program was built without it; a .pfm " +
                    "has the same numbers");
  }
  static std::string why;
  static GetImageModule* const get =
      load_image_module(LIGHTWALK_IMAGE_MODULE, why);
  if (!get) throw FileError(needs + "which cannot be loaded: " + why);
  return *get();
}

/// Throws a FileError with the module's message, if there is one.
inline void throw_unless_empty(const std::string& error) {
  if (!error.empty()) throw FileError(error);
}

}  // namespace lightwalk
