#pragma once

// A path that becomes a tree doubles its rays at each bounce, and a few
// bounces more are the difference between a minute and a year. So the program
// says what is coming, as soon as it can be told from the first samples.

#include <cstdio>
#include <optional>
#include <string>

#include "common/program/periodically.hpp"
#include "common/program/progress_line.hpp"
#include "common/program/with_unit.hpp"
#include "common/render/render_progress.hpp"

namespace lightwalk {

/// Hours, days or years, whichever is read most easily.
inline std::string long_time(double seconds) {
  const double hours = seconds / 3600;
  const double days = hours / 24, years = days / 365.25;
  if (years > 1e6) return "a million years";
  char text[64];
  if (hours < 48) {
    std::snprintf(text, sizeof text, "%.0f hours", hours);
  } else if (days < 730) {
    std::snprintf(text, sizeof text, "%.0f days", days);
  } else {
    std::snprintf(text, sizeof text, "%.0f years", years);
  }
  return text;
}

/// How far a render is.
struct RenderCost {
  double samples, rays;  ///< so far
  double seconds;        ///< since it began
  int threads;
  double total_samples;
};

/// What is said about a render that takes absurdly long: hours to come, and
/// samples of a thousand rays and more. A sample that every thread has begun
/// and not ended counts as one: so neither number is too large.
inline std::optional<std::string> cost_warning(const RenderCost& cost) {
  const double begun = cost.samples + cost.threads;
  const double rays = cost.rays / begun;
  const double seconds = cost.seconds * cost.total_samples / begun;
  if (rays < 1000 || seconds < 7200) return std::nullopt;
  // Where few samples are done, those that have just begun count too much.
  const char* about =
      cost.samples < 20.0 * cost.threads ? "more than " : "about ";
  return "each sample follows " + (about + with_unit(rays)) +
         " rays; the picture would take " + about + long_time(seconds) +
         "; fewer --max-bounces take less";
}

/// Says it on stderr, once, while the render goes on.
class CostWarning {
 public:
  CostWarning(std::string program, const RenderProgress& progress,
              int threads, double total_samples)
      : program_(std::move(program)),
        progress_(progress),
        threads_(threads),
        total_(total_samples) {}

 private:
  void look() {
    if (said_) return;
    const std::chrono::duration<double> elapsed =
        std::chrono::steady_clock::now() - start_;
    const auto warning =
        cost_warning({static_cast<double>(progress_.samples.load()),
                      static_cast<double>(progress_.rays.load()),
                      elapsed.count(), threads_, total_});
    if (!warning) return;
    said_ = true;
    std::fprintf(stderr, "%s%s: %s\n", stderr_is_terminal() ? "\r\x1b[K" : "",
                 program_.c_str(), warning->c_str());
  }

  std::string program_;
  const RenderProgress& progress_;
  int threads_;
  double total_;
  bool said_ = false;
  std::chrono::steady_clock::time_point start_ =
      std::chrono::steady_clock::now();
  Periodically looks_{std::chrono::seconds(1), [this] { look(); }};
};

}  // namespace lightwalk
