#pragma once

// # Counting rays
//
// Rays are what a path tracer pays with, so every ray is counted. Each thread
// counts its own: a counter shared by the threads would cost more than the
// rays do.
//
// Every ray of every path tracer comes by here, so from here a render can be
// watched. Whoever renders may leave a watcher with the thread, which is
// asked every 256 rays, some ten thousand times a second. It may throw, and
// the sample ends there, wherever it was: no loop over a path has to ask
// whether it should go on. A ray pays for it with two instructions.

#include <cstdint>

#include "common/geometry/inlining.hpp"

namespace lightwalk {

/// Looks after the rays of a thread.
class RayWatcher {
 public:
  /// Called every 256 rays. Throws where no more rays are wanted.
  virtual void look() = 0;

 protected:
  ~RayWatcher() = default;
};

/// Rays that this thread has cast so far, of both kinds.
inline constinit thread_local std::uint64_t rays_cast = 0;

/// Who watches the rays of this thread; null if nobody does.
inline constinit thread_local RayWatcher* ray_watcher = nullptr;

LIGHTWALK_NOINLINE inline void ask_ray_watcher() {
  if (ray_watcher) ray_watcher->look();
}

/// Counts a ray that is about to be cast.
inline void count_ray() {
  if ((++rays_cast & 0xff) == 0) [[unlikely]]
    ask_ray_watcher();
}

/// Counts some, at most 256.
inline void count_rays(unsigned rays) {
  const std::uint64_t before = rays_cast;
  rays_cast += rays;
  if (((before ^ rays_cast) & ~std::uint64_t{0xff}) != 0) [[unlikely]]
    ask_ray_watcher();
}

}  // namespace lightwalk
