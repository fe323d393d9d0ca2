#pragma once

// What a program prints is UTF-8, with the same bytes on every system.

#include <cstdio>
#include <string>

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

/// The exit code of a program that has printed all it had to say: `code`, or
/// `failed` if that was success and the system did not take what was printed.
inline int checked_output(const std::string& program, int code, int failed) {
  const bool flushed = std::fflush(stdout) == 0;
  if (flushed && !std::ferror(stdout)) return code;
  std::fprintf(stderr,
               "%s: the standard output does not take all of the text\n",
               program.c_str());
  return code == 0 ? failed : code;
}

}  // namespace lightwalk
