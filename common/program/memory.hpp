#pragma once

// Whether a picture fits into the machine's memory. A system that promises
// more memory than it has would otherwise kill the program hours later.

#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

#include <stdexcept>
#include <string>

#include "common/files/windows.hpp"
#include "common/program/progress.hpp"
#include "common/render/film.hpp"
#include "common/scene/camera.hpp"

namespace lightwalk {

/// The memory of the machine in bytes, or 0 if it is not known.
inline double physical_memory() {
#ifdef _WIN32
  MEMORYSTATUSEX status{};
  status.dwLength = sizeof status;
  return GlobalMemoryStatusEx(&status)
             ? static_cast<double>(status.ullTotalPhys)
             : 0;
#elif defined(_SC_PHYS_PAGES) && defined(_SC_PAGESIZE)
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(sysconf(_SC_PAGESIZE));
#else
  return 0;
#endif
}

/// Throws if the picture would take more than 0.8 of the machine's memory.
inline void check_memory(const Camera& camera) {
  const double needed =
      static_cast<double>(sizeof(Pixel) + 4 * sizeof(Vec3)) * camera.width *
      camera.height;
  const double memory = physical_memory();
  if (memory > 0 && needed > 0.8 * memory) {
    throw std::runtime_error(
        "an image of " + std::to_string(camera.width) + " x " +
        std::to_string(camera.height) + " pixels needs " + with_unit(needed) +
        "B of memory, and this machine has " + with_unit(memory) + "B");
  }
}

}  // namespace lightwalk
