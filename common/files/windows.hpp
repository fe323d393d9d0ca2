#pragma once

// The header of Windows, without the macros that clash with our names. On
// other systems this file is empty.

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

// From the time of 16 bits. Other headers of Windows use the capitals.
#undef near
#undef far
#undef NEAR
#undef FAR
#define NEAR
#define FAR
#endif
