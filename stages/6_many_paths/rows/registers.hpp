#pragma once

// # Are there registers for rows?
//
// Highway knows the registers of each processor. One set of instructions is
// chosen when a program is compiled. LIGHTWALK_HIGHWAY says that the library
// is there; LIGHTWALK_ROWS that registers hold four floats or more besides,
// with what rows need. A program that any x86-64 can run has no rows.

// On ARM it wants the instructions for ciphers, too (armv8-a+crypto).

#if defined(LIGHTWALK_HIGHWAY) && \
    (defined(__SSSE3__) ||        \
     (defined(__ARM_NEON) && defined(__ARM_FEATURE_AES)))
#define LIGHTWALK_ROWS
// Its headers alone: the checks of a debug build are in its library.
#ifndef HWY_COMPILE_ONLY_STATIC
#define HWY_COMPILE_ONLY_STATIC
#endif
#ifndef HWY_IS_DEBUG_BUILD
#define HWY_IS_DEBUG_BUILD 0
#endif
#include <hwy/highway.h>
#endif
