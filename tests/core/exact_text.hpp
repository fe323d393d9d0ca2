#pragma once

#include <cstdio>
#include <string>

#include "common/math/vector.hpp"

namespace lightwalk::tests {

/// Prints all digits of a float, so that the text gives back the same float.
inline std::string text(const Vec3& v) {
  char line[80];
  std::snprintf(line, sizeof line, "(%.9g, %.9g, %.9g)",
                static_cast<double>(v.x), static_cast<double>(v.y),
                static_cast<double>(v.z));
  return line;
}

}  // namespace lightwalk::tests
