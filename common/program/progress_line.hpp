#pragma once

// A line on the terminal that says how far a render is. By hand: the library
// for it, indicators, is no package of Debian's.

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>

#include "common/program/periodically.hpp"
#include "common/program/with_unit.hpp"
#include "common/render/render_progress.hpp"

#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

namespace lightwalk {

/// Where it cannot be told, nobody watches.
inline bool stderr_is_terminal() {
#ifdef STDERR_FILENO
  return isatty(STDERR_FILENO) != 0;
#else
  return false;
#endif
}

/// Shows the progress on stderr, a few times a second, until it is destroyed.
/// Does nothing where stderr is not a terminal.
class ProgressLine {
 public:
  ProgressLine(const RenderProgress& progress, double total, bool wanted)
      : progress_(progress), total_(total) {
    if (wanted && stderr_is_terminal()) {
      prints_.emplace(std::chrono::milliseconds(200), [this] { print(); });
    }
  }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() {
    if (!prints_) return;
    prints_.reset();
    std::fprintf(stderr, "\r\x1b[K");
  }

 private:
  void print() const {
    const std::chrono::duration<double> elapsed =
        std::chrono::steady_clock::now() - start_;
    const auto samples = static_cast<double>(progress_.samples.load());
    const double rate = samples / elapsed.count();
    const double left = rate > 0 ? (total_ - samples) / rate : 0;
    std::fprintf(stderr, "\r\x1b[K%3.0f %%  %ssamples/s  %.0f s left",
                 100 * samples / total_, with_unit(rate).c_str(), left);
    std::fflush(stderr);
  }

  const RenderProgress& progress_;
  double total_;
  std::chrono::steady_clock::time_point start_ =
      std::chrono::steady_clock::now();
  std::optional<Periodically> prints_;
};

}  // namespace lightwalk
