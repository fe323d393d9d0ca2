#pragma once

// Windows' header, without its macros that are words of ours. Elsewhere it
// is empty.

#ifdef _WIN32
#ifndef WIN32_LEAN_AND_MEAN
#define WIN32_LEAN_AND_MEAN
#endif
#ifndef NOMINMAX
#define NOMINMAX
#endif
#ifndef NOGDI  // drawing, with a function Rectangle
#define NOGDI
#endif
#include <windows.h>

// Of 16-bit times. Other headers of Windows write them in capitals.
#undef near
#undef far
#undef NEAR
#undef FAR
#define NEAR
#define FAR
#endif
