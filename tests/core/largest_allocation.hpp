#pragma once

#include <cstddef>

namespace lightwalk::tests {

/// The largest block that this thread has requested from `new` since this was
/// last set to 0. A broken header must not make a program reserve more than the
/// file can fill. With `constinit` no function initializes it at its first use:
/// GCC 12 and its sanitizer of references disagree about that function.
extern constinit thread_local std::size_t largest_allocation;

}  // namespace lightwalk::tests
