// The code of tinyexr and stb, which are headers: compiled here, once, as they
// are. Their asserts would end a program whose file is broken; what they ask
// for is checked before.

#ifndef NDEBUG
#define NDEBUG
#endif

// What a damaged JPEG leaves unset is zero, so that what becomes of it does
// not depend on what was in the memory before.
#include <cstdlib>
#define STBI_MALLOC(size) std::calloc(1, size)
#define STBI_REALLOC(memory, size) std::realloc(memory, size)
#define STBI_FREE(memory) std::free(memory)

#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#include <stb_image.h>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

// zlib, or where it is not installed what stands in for it: stb_zlib/.
#include <zlib.h>

#define TINYEXR_IMPLEMENTATION
#define TINYEXR_USE_MINIZ 0
#define TINYEXR_USE_PIZ 0
#define TINYEXR_USE_THREAD 0
#include <tinyexr.h>
