#pragma once

// Signals that ask a program to end: Ctrl-C, `kill`, a terminal that is
// closed, and a limit of processor time that is used up. A signal that
// `nohup` or a shell has set to be ignored stays ignored, except for Ctrl-C.

#include <csignal>

namespace lightwalk {

#ifdef SIGBREAK  // Windows: Ctrl-Break
inline constexpr int ending_signals[] = {SIGINT, SIGTERM, SIGBREAK};
#elif defined(SIGHUP)
inline constexpr int ending_signals[] = {SIGINT, SIGTERM, SIGHUP, SIGXCPU};
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

/// From here on, writing to a pipe without a reader or to a file that may not
/// grow is an error, and does not end the program.
inline void ignore_failing_writes() {
#ifdef SIGPIPE
  std::signal(SIGPIPE, SIG_IGN);
#endif
#ifdef SIGXFSZ
  std::signal(SIGXFSZ, SIG_IGN);
#endif
}

}  // namespace lightwalk
