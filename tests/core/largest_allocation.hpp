#pragma once

#include <cstddef>

namespace lightwalk::tests {

/// The largest block that this thread has asked `new` for since this was last
/// set to 0. A broken header must not make a program reserve what the file
/// cannot fill. With `constinit` it is reached without a function that might
/// set it up first, which GCC 12 and its sanitizer of references fall out over.
extern constinit thread_local std::size_t largest_allocation;

}  // namespace lightwalk::tests
