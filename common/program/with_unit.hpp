#pragma once

#include <cstdio>
#include <string>

namespace lightwalk {

/// A number with three digits or so and a unit: "4.56 M".
inline std::string with_unit(double value) {
  const char* unit = "";
  if (value >= 1e9) {
    value /= 1e9, unit = "G";
  } else if (value >= 1e6) {
    value /= 1e6, unit = "M";
  } else if (value >= 1e3) {
    value /= 1e3, unit = "k";
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %s", value, unit);
  return text;
}

}  // namespace lightwalk
