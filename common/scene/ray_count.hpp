#pragma once

// # Counting rays
//
// The cost of a render is its number of rays, so every ray is counted. Each
// thread counts its own: a counter shared by the threads would cost more than
// the rays do.
//
// Every ray of every path tracer passes through here, so a render can be
// watched here. A renderer may set a watcher for the thread, which is called
// every 256 rays, some ten thousand times a second. The watcher may throw to
// end the sample, wherever it is: no loop over a path has to check whether it
// should go on. This costs two instructions per ray.

#include <cstdint>

#include "common/geometry/inlining.hpp"

namespace lightwalk {

/// Watches the rays of a thread.
class RayWatcher {
 public:
  /// Called every 256 rays. Throws to end the sample.
  virtual void look() = 0;

 protected:
  ~RayWatcher() = default;
};

/// Rays that this thread has cast so far, of both kinds.
inline constinit thread_local std::uint64_t rays_cast = 0;

/// The watcher of this thread's rays; null if there is none.
inline constinit thread_local RayWatcher* ray_watcher = nullptr;

LIGHTWALK_NOINLINE inline void ask_ray_watcher() {
  if (ray_watcher) ray_watcher->look();
}

/// Counts a ray that is about to be cast.
inline void count_ray() {
  if ((++rays_cast & 0xff) == 0) [[unlikely]]
    ask_ray_watcher();
}

/// Counts several rays, at most 256.
inline void count_rays(unsigned rays) {
  const std::uint64_t before = rays_cast;
  rays_cast += rays;
  if (((before ^ rays_cast) & ~std::uint64_t{0xff}) != 0) [[unlikely]]
    ask_ray_watcher();
}

}  // namespace lightwalk
