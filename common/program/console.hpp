#pragma once

// What a program prints is UTF-8, with the same bytes on every system.

#include <cstdio>

#include "common/files/windows.hpp"

#ifdef _WIN32
#include <fcntl.h>
#include <io.h>
#endif

namespace lightwalk {

inline void prepare_console() {
#ifdef _WIN32
  _setmode(_fileno(stdout), _O_BINARY);
  _setmode(_fileno(stderr), _O_BINARY);
  SetConsoleOutputCP(CP_UTF8);
#endif
}

}  // namespace lightwalk
