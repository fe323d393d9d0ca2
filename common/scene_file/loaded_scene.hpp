#pragma once

#include <cinttypes>
#include <compare>
#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/scene.hpp"

namespace lightwalk {

/// A place in a file.
struct LineAndColumn {
  std::uint32_t line, column;
  auto operator<=>(const LineAndColumn&) const = default;
};

/// The 64-bit FNV-1a hash of the bytes, as 16 hexadecimal digits (G. Fowler,
/// L. Noll, K.-P. Vo; IETF draft-eastlake-fnv). It says whether two pictures
/// are from the same scene file, and does not protect against forgery.
inline std::string fnv_1a(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char byte : bytes) {
    hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  }
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016" PRIx64, hash);
  return digits;
}

/// A scene as it was read, with what else its file says.
struct LoadedScene {
  Scene scene;
  std::string hash;  ///< of the file's bytes: fnv_1a()
  std::optional<int> samples_per_pixel;
  std::optional<int> max_bounces;
  std::map<const Material*, std::string> material_names;
  /// The place of each shape, by type, in the scene's order.
  std::map<ShapeType, std::vector<LineAndColumn>> shape_places;
  std::vector<std::string> warnings;  ///< one line each, with file and line
};

}  // namespace lightwalk
