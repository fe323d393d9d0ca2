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
#define LIGHTWALK_FLATTEN __attribute__((flatten))
#else
#define LIGHTWALK_FLATTEN
#endif

#if defined(__GNUC__) || defined(__clang__)
#define LIGHTWALK_NOINLINE [[gnu::noinline]]
#else
#define LIGHTWALK_NOINLINE
#endif
