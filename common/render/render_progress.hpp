#pragma once

// # What a render has done, and what ends it
//
// A render ends early for two reasons: the user asked for it, or one of its
// threads met an exception. Between two pixels it is easy to check for both.
// But one sample of a tree of paths (stage 3) can take longer than the user's
// life. So each thread also checks every 256 rays, and throws `Stopped` out
// of the sample, which is then not counted.
//
// This unwinds the stack as any exception does. Code that catches everything
// may catch `Stopped`, too: the next check throws it again.

#include <atomic>
#include <cstdint>
#include <exception>
#include <utility>

#include "common/scene/ray_count.hpp"

namespace lightwalk {

/// What a render has done so far; read while it runs to show progress.
struct RenderProgress {
  std::atomic<std::uint64_t> samples{0};
  std::atomic<std::uint64_t> rays{0};
};

/// Thrown out of a sample that is not wanted any more. It is not a
/// std::exception: nothing has gone wrong.
struct Stopped {};

/// Samples that this thread has taken so far.
inline constinit thread_local std::uint64_t samples_taken = 0;

/// The first of the exceptions that the threads of a render meet.
class FirstException {
 public:
  /// Keeps the exception that is being handled, if there was none before.
  void keep() noexcept {
    if (!any_.exchange(true)) exception_ = std::current_exception();
  }
  bool any() const { return any_.load(std::memory_order_relaxed); }

  /// Throws it again, if there is one. All threads must have ended.
  void rethrow() {
    if (exception_) std::rethrow_exception(std::exchange(exception_, {}));
  }

 private:
  std::atomic<bool> any_{false};
  std::exception_ptr exception_;
};

/// While this object lives, its thread works for a render: it adds to the
/// progress, and its rays throw `Stopped` when the render is over.
class RenderThread final : public RayWatcher {
 public:
  RenderThread(const std::atomic<bool>& stop, const FirstException& errors,
               RenderProgress& progress)
      : stop_(stop), errors_(errors), progress_(progress) {
    ray_watcher = this;
  }
  ~RenderThread() {
    publish();
    ray_watcher = before_;
  }
  RenderThread(const RenderThread&) = delete;
  RenderThread& operator=(const RenderThread&) = delete;

  bool is_over() const {
    return stop_.load(std::memory_order_relaxed) || errors_.any();
  }

  void look() override {
    // Not on each call: the threads would wait for each other.
    if (rays_cast - rays_ >= 0x10000) publish();
    if (is_over()) throw Stopped();
  }

  /// Adds to the progress what this thread has done since the last call.
  void publish() {
    progress_.rays += rays_cast - std::exchange(rays_, rays_cast);
    progress_.samples +=
        samples_taken - std::exchange(samples_, samples_taken);
  }

 private:
  const std::atomic<bool>& stop_;
  const FirstException& errors_;
  RenderProgress& progress_;
  RayWatcher* before_ = ray_watcher;
  std::uint64_t rays_ = rays_cast, samples_ = samples_taken;
};

}  // namespace lightwalk
