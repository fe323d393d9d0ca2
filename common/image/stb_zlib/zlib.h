#pragma once

// What tinyexr wants of zlib, by stb: for systems on which zlib's headers are
// not installed. stb_image.h and stb_image_write.h come first.

#include <cstddef>
#include <cstring>

using Bytef = unsigned char;
using uLong = unsigned long;
using uLongf = unsigned long;
enum { Z_OK = 0, Z_BUF_ERROR = -5 };

/// More than stb makes of so many bytes that cannot be compressed.
inline uLong compressBound(uLong size) {
  return size + size / 8 + 1024;
}

inline int compress(Bytef* target, uLongf* target_size, const Bytef* source,
                    uLong source_size) {
  int size = 0;
  unsigned char* const bytes =
      stbi_zlib_compress(const_cast<unsigned char*>(source),
                         static_cast<int>(source_size), &size, 8);
  if (!bytes) return Z_BUF_ERROR;
  const bool fits = static_cast<uLong>(size) <= *target_size;
  if (fits) {
    std::memcpy(target, bytes, static_cast<std::size_t>(size));
    *target_size = static_cast<uLong>(size);
  }
  STBIW_FREE(bytes);
  return fits ? Z_OK : Z_BUF_ERROR;
}

inline int uncompress(Bytef* target, uLongf* target_size, const Bytef* source,
                      uLong source_size) {
  const int size = stbi_zlib_decode_buffer(
      reinterpret_cast<char*>(target), static_cast<int>(*target_size),
      reinterpret_cast<const char*>(source), static_cast<int>(source_size));
  if (size < 0) return Z_BUF_ERROR;
  *target_size = static_cast<uLong>(size);
  return Z_OK;
}
