#pragma once

// The small interface to OpenImageIO, which one compiled file implements: a
// module that is loaded when the first file needs it. Loading it at the start
// would cost every program a second.
//
// A library that Debian's OpenImageIO brings along starts threads while it is
// loaded. Where the system gives too few threads or too little memory, it
// ends the program, or waits for ever. So a child process tries first, before
// anything is rendered.

#include <string>
#include <string_view>

#include "common/files/file_error.hpp"
#include "common/files/windows.hpp"
#include "common/image/render_result.hpp"
#include "common/image/texture.hpp"

#ifndef _WIN32
#include <dlfcn.h>
#endif
#ifdef __linux__
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>
#endif

namespace lightwalk {

/// Each function returns what went wrong, or an empty string. `format` is
/// what OpenImageIO calls it, such as "exr".
struct ImageModule {
  /// Makes OpenImageIO start its threads.
  std::string (*start)();
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

/// Loads and starts the module; null, with the reason in `error`, if that
/// fails.
inline const ImageModule* start_image_module(std::string& error) {
  GetImageModule* const get =
      load_image_module(LIGHTWALK_IMAGE_MODULE, error);
  if (!get) return nullptr;
  error = get()->start();
  return error.empty() ? get() : nullptr;
}

#ifdef __linux__
/// Kills this process in 20 seconds, by the clock since a process that waits
/// for ever takes no processor time. Not by alarm(): the library that waits
/// has blocked all signals that can be blocked.
inline void live_for_20_seconds() {
  sigevent event{};
  event.sigev_notify = SIGEV_SIGNAL;
  event.sigev_signo = SIGKILL;
  timer_t timer{};
  const itimerspec once{{0, 0}, {20, 0}};
  if (timer_create(CLOCK_MONOTONIC, &event, &timer) != 0 ||
      timer_settime(timer, 0, &once, nullptr) != 0) {
    _exit(1);
  }
}

/// Whether a child process survives the start of the module, which takes a
/// third of a second.
inline bool image_module_starts_in_a_child() {
  const pid_t child = fork();
  if (child < 0) return false;
  if (child == 0) {
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDERR_FILENO);
    for (const int ending : {SIGABRT, SIGSEGV}) {
      std::signal(ending, SIG_DFL);
    }
    live_for_20_seconds();
    try {
      std::string reason;  // the parent finds it out again
      start_image_module(reason);
    } catch (...) {
      _exit(1);
    }
    _exit(0);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return true;  // nothing is known: try it
  }
  return status == 0;
}
#else
inline bool image_module_starts_in_a_child() {
  return true;
}
#endif

/// Loads the module for files with this ending. Throws a FileError if there
/// is none, or if it cannot start.
inline const ImageModule& image_module(std::string_view ending) {
  const std::string needs = std::string(ending) + " needs OpenImageIO, ";
  if (std::string_view(LIGHTWALK_IMAGE_MODULE).empty()) {
    throw FileError(needs + "and this program was built without it; a .pfm " +
                    "has the same numbers");
  }
  static std::string why = "too few threads or too little memory";
  static const ImageModule* const module =
      image_module_starts_in_a_child() ? start_image_module(why) : nullptr;
  if (!module) {
    throw FileError(needs + "which cannot be loaded: " + why +
                    "; a .pfm has the same numbers");
  }
  return *module;
}

/// Throws a FileError with the module's message, if there is one.
inline void throw_unless_empty(const std::string& error) {
  if (!error.empty()) throw FileError(error);
}

}  // namespace lightwalk
