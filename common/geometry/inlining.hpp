#pragma once

// # What to compile together
//
// A path is compiled into one piece of code, from the camera's ray to the
// film: handed on through memory, hits would cost a tenth of the speed. GCC
// has to be asked for that. What is rare and long, such as a walk through a
// tree of boxes, is kept apart, for it would only be in the way.
//
// Both are advice. Compilers that do not know it give the same bits.

#if defined(__GNUC__) && !defined(__clang__)
#define LIGHTWALK_IN_ONE_PIECE __attribute__((flatten))
#else
#define LIGHTWALK_IN_ONE_PIECE
#endif

#if defined(__GNUC__) || defined(__clang__)
#define LIGHTWALK_APART [[gnu::noinline]]
#else
#define LIGHTWALK_APART
#endif

// ## Where paths may take turns
//
// With the library for it, and neither in builds for debugging nor under
// sanitizers that keep watch over one stack for each thread: see
// common/geometry/path_group.hpp.

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define LIGHTWALK_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define LIGHTWALK_SANITIZED
#endif
#endif

#if defined(LIGHTWALK_BOOST_CONTEXT) && defined(NDEBUG) && \
    !defined(LIGHTWALK_SANITIZED)
#define LIGHTWALK_FIBERS
#endif
