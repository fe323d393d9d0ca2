#pragma once

// # Paths that wait for each other
//
// A path is written as one story: a ray, a hit, the next ray. A processor
// that follows one such story spends most of its time waiting for the last
// number before it can work out the next. Sixteen stories that are told in
// turns keep it busy.
//
// So each path has a stack of its own, on which its functions keep what they
// know, and the thread goes from one stack to the next whenever a path asks
// what its ray meets. Such a stack is called a fiber. Nothing happens at the
// same time: paths take turns in a fixed order, on one thread, so there is
// nothing to lock. And no path is written differently for it.
//
// Leaving one stack for another takes a few instructions that C++ has no
// words for, so a library does it: Boost.Context. Without the library paths
// are followed one after the other, as they are in builds for debugging,
// where whoever steps through a path wants to stay on it. The picture has the
// same bits.

#include <functional>

#include "common/compiler.hpp"
#include "common/geometry.hpp"
#include "common/ray_packet.hpp"

#ifdef LIGHTWALK_FIBERS
#include <array>
#include <boost/context/fiber.hpp>
#include <boost/context/protected_fixedsize_stack.hpp>
#include <utility>
#endif

namespace lightwalk {

#ifdef LIGHTWALK_FIBERS

/// Sixteen fibers of this thread, which share one packet of rays.
class PathGroup final : RayPacket {
 public:
  PathGroup() {
    for (unsigned path = 0; path < size; ++path) {
      fibers_[path] = Fiber(std::allocator_arg, Stack(stack_bytes),
                            [this](Fiber&& from) { return live(from); });
    }
  }
  PathGroup(const PathGroup&) = delete;
  PathGroup& operator=(const PathGroup&) = delete;

  /// Runs `work` on all fibers, in turns, until each of them has returned
  /// from it. Rays that it casts must be meant for `geometry`.
  void run(const Geometry& geometry, const std::function<void()>& work) {
    geometry_ = &geometry;
    work_ = &work;
    for (unsigned path = 0; path < size; ++path)
      next_[path] = (path + 1) % size;
    before_ = size - 1;
    ray_packet = this;
    path_ = starter;
    go_to(0);
    ray_packet = nullptr;
  }

 private:
  using Fiber = boost::context::fiber;
  using Stack = boost::context::protected_fixedsize_stack;

  /// Room for path tracers that are written as recursive functions. Memory
  /// that no path reaches is never taken from the system.
  static constexpr std::size_t stack_bytes = 1 << 20;

  static constexpr unsigned starter = size;  ///< the caller of run()

  /// What a fiber does from its first turn on.
  Fiber live(Fiber& from) {
    fibers_[left_] = std::move(from);
    for (;;) {
      (*work_)();
      const unsigned path = path_;
      const unsigned other = next_[path];
      next_[before_] = other;  // the others go on without it
      if (other == path) {
        go_to(starter);
      } else {
        take_turn(other);
      }
    }
  }

  // #region turns
  void wait() override {
    const unsigned path = path_;
    const unsigned other = next_[path];
    before_ = path;
    take_turn(other);
  }

  /// Goes on with another path; at the end of a round, with what rays meet.
  void take_turn(unsigned other) {
    if (other <= path_) geometry_->meet(*this);
    if (other != path_) go_to(other);
  }

  /// Leaves the current fiber, and returns when another one comes back to it.
  void go_to(unsigned other) {
    left_ = path_;
    path_ = other;
    fibers_[left_] = std::move(fibers_[other]).resume();
  }
  // #endregion turns

  const Geometry* geometry_ = nullptr;
  const std::function<void()>* work_ = nullptr;
  std::array<Fiber, size + 1> fibers_;
  std::array<unsigned, size> next_{};  ///< whose turn it is after each path's
  unsigned before_ = 0;      ///< the path whose turn was before this one
  unsigned left_ = starter;  ///< the fiber that was left last
};

#endif

/// Runs `work` so that several paths of this thread can take turns in it, or
/// just once.
inline void run_paths(const Geometry& geometry,
                      const std::function<void()>& work) {
#ifdef LIGHTWALK_FIBERS
  if (geometry.suits_packets()) {
    thread_local PathGroup group;
    return group.run(geometry, work);
  }
#else
  static_cast<void>(geometry);
#endif
  work();
}

}  // namespace lightwalk
