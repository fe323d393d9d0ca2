#pragma once

// # Counting rays
//
// Rays are what a path tracer pays with, so every ray is counted. Each thread
// counts its own: a counter shared by the threads would cost more than the
// rays do.

#include <cstdint>

namespace lightwalk {

/// Rays that this thread has cast so far, of both kinds.
inline constinit thread_local std::uint64_t rays_cast = 0;

}  // namespace lightwalk
