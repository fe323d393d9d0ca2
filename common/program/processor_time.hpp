#pragma once

#include <ctime>

#include "common/files/windows.hpp"

namespace lightwalk {

/// The processor time of this program in seconds, all threads together. On
/// Windows std::clock would give the elapsed time.
inline double processor_seconds() {
#ifdef _WIN32
  FILETIME created, ended, in_system, in_program;
  if (!GetProcessTimes(GetCurrentProcess(), &created, &ended, &in_system,
                       &in_program)) {
    return 0;
  }
  const auto seconds = [](const FILETIME& time) {
    return 1e-7 * (0x1p32 * time.dwHighDateTime + time.dwLowDateTime);
  };
  return seconds(in_system) + seconds(in_program);
#else
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
#endif
}

}  // namespace lightwalk
