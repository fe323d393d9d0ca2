#pragma once

// # What a render says while it goes on
//
// A line on the terminal says how far the render is. If a path becomes a
// tree, a few more bounces are the difference between a minute and a year: so
// a warning estimates the time, as soon as the first samples show it.
//
// Hand-written: Debian has no package of indicators.

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "common/render/render_progress.hpp"

#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

namespace lightwalk {

/// If the system cannot tell, the answer is no.
inline bool stderr_is_terminal() {
#ifdef STDERR_FILENO
  return isatty(STDERR_FILENO) != 0;
#else
  return false;
#endif
}

/// A number with about three digits and a unit: "4.56 M".
inline std::string with_unit(double value) {
  constexpr const char* units[] = {"", "k", "M", "G"};
  int unit = 0;
  for (; value >= 1000 && unit < 3; ++unit) value /= 1000;
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %s", value, units[unit]);
  return text;
}

/// Seconds, hours, days or years, whichever is easiest to read.
inline std::string time_text(double seconds) {
  const double hours = seconds / 3600, days = hours / 24;
  const double years = days / 365.25;
  if (years > 1e6) return "a million years";
  const auto [number, unit] = hours < 2    ? std::pair(seconds, "s")
                              : hours < 48 ? std::pair(hours, "hours")
                              : days < 730 ? std::pair(days, "days")
                                           : std::pair(years, "years");
  char text[32];
  std::snprintf(text, sizeof text, "%.0f %s", number, unit);
  return text;
}

/// How far a render is.
struct RenderCost {
  double samples, rays;  ///< so far
  double seconds;        ///< since it began
  int threads;
  double total_samples;
};

/// The warning about a render that takes absurdly long: at least two hours,
/// with at least a thousand rays per sample. A sample that a thread has begun
/// and not ended counts as one, so neither number is too large.
inline std::optional<std::string> cost_warning(const RenderCost& cost) {
  const double begun = cost.samples + cost.threads;
  const double rays = cost.rays / begun;
  const double seconds = cost.seconds * cost.total_samples / begun;
  if (rays < 1000 || seconds < 7200) return std::nullopt;
  // While few samples are done, those that have just begun count too much.
  const char* about =
      cost.samples < 20.0 * cost.threads ? "more than " : "about ";
  return "each sample follows " + (about + with_unit(rays)) +
         " rays; the picture would take " + about + time_text(seconds) +
         "; fewer --max-bounces take less";
}

/// Watches a render in its own thread until this object is destroyed: prints
/// the line five times a second, if stderr is a terminal, and the warning at
/// most once. If the system gives no thread, the render goes on unwatched.
class Progress {
 public:
  Progress(std::string program, const RenderProgress& progress, int threads,
           double total_samples)
      : program_(std::move(program)),
        progress_(progress),
        threads_(threads),
        total_(total_samples) {
    try {
      thread_ = std::thread([this] { watch(); });
    } catch (const std::exception&) {
    }
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() {
    if (!thread_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
    }
    wake_.notify_all();
    thread_.join();
    std::fputs(erase_, stderr);
  }

 private:
  void watch() {
    std::unique_lock lock(mutex_);
    int looks = 0;
    bool warned = false;
    while (!wake_.wait_for(lock, std::chrono::milliseconds(200),
                           [this] { return done_; })) {
      const std::chrono::duration<double> elapsed =
          std::chrono::steady_clock::now() - start_;
      const RenderCost cost{static_cast<double>(progress_.samples.load()),
                            static_cast<double>(progress_.rays.load()),
                            elapsed.count(), threads_, total_};
      if (++looks % 5 == 0 && !warned) warned = warn(cost);
      if (*erase_) print(cost);
    }
  }

  bool warn(const RenderCost& cost) const {
    const auto warning = cost_warning(cost);
    if (!warning) return false;
    std::fprintf(stderr, "%s%s: %s\n", erase_, program_.c_str(),
                 warning->c_str());
    return true;
  }

  void print(const RenderCost& cost) const {
    const double rate = cost.samples / cost.seconds;
    const double left = rate > 0 ? (total_ - cost.samples) / rate : 0;
    // A narrow terminal cuts the line (DECAWM off) instead of wrapping it.
    std::fprintf(stderr, "\x1b[?7l%s%3.0f %%  %s left  %ssamples/s\x1b[?7h",
                 erase_, 100 * cost.samples / total_, time_text(left).c_str(),
                 with_unit(rate).c_str());
    std::fflush(stderr);
  }

  std::string program_;
  const RenderProgress& progress_;
  int threads_;
  double total_;
  /// What erases the line; empty without a terminal.
  const char* erase_ = stderr_is_terminal() ? "\r\x1b[K" : "";
  std::chrono::steady_clock::time_point start_ =
      std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::thread thread_;
};

}  // namespace lightwalk
