#pragma once

// # What to compile together
//
// A path is compiled into one piece of code, from the camera's ray to the
// film: passing hits on through memory would cost a tenth of the speed. GCC
// does so only on request. Code that is rare and long, such as a walk through
// a tree of boxes, is kept out of that piece.
//
// Both macros are hints. Compilers that lack them give the same bits.

#if defined(__GNUC__) && !defined(__clang__)
#define LIGHTWALK_FLATTEN __attribute__((flatten))
#else
#define LIGHTWALK_FLATTEN
#endif

#if defined(__GNUC__) || defined(__clang__)
#define LIGHTWALK_NOINLINE [[gnu::noinline]]
#else
#define LIGHTWALK_NOINLINE
#endif
