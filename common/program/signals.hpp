#pragma once

// Signals that ask a program to end: Ctrl-C, `kill`, and a terminal that is
// closed. What `nohup` or a shell has set to be ignored stays ignored, but
// for Ctrl-C.

#include <csignal>

#include "common/image/write_file.hpp"

namespace lightwalk {

#ifdef SIGBREAK  // Windows: Ctrl-Break
inline constexpr int ending_signals[] = {SIGINT, SIGTERM, SIGBREAK};
#elif defined(SIGHUP)
inline constexpr int ending_signals[] = {SIGINT, SIGTERM, SIGHUP};
#else
inline constexpr int ending_signals[] = {SIGINT, SIGTERM};
#endif

/// Calls `handler(signal)` when a signal asks the program to end.
inline void catch_ending_signals(void (*handler)(int)) {
  for (const int signal : ending_signals) {
    const auto before = std::signal(signal, handler);
    if (before == SIG_IGN && signal != SIGINT) std::signal(signal, SIG_IGN);
  }
}

/// A handler: ends the program as the signal would have done, and leaves no
/// unfinished file behind.
inline void end_by_signal(int signal) {
  if (const char* const name = unfinished_file.load()) {
#ifdef _WIN32
    // Handlers run in a thread of their own there. An open file stays.
    DeleteFileA(name);
#else
    unlink(name);
#endif
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

}  // namespace lightwalk
