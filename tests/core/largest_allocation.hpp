#pragma once

#include <cstddef>

namespace lightwalk::tests {

/// The largest block that this thread has asked `new` for since this was last
/// set to 0. A broken header must not make a program reserve what the file
/// cannot fill.
extern constinit thread_local std::size_t largest_allocation;

}  // namespace lightwalk::tests
