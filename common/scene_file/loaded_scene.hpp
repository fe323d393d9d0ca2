#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/scene.hpp"

namespace lightwalk {

/// Where something stands in a file.
struct LineAndColumn {
  std::uint32_t line, column;
  auto operator<=>(const LineAndColumn&) const = default;
};

/// A scene as it was read, with what its file says beside it.
struct LoadedScene {
  Scene scene;
  std::string sha256;  ///< of the file's bytes, in hexadecimal
  std::optional<int> samples_per_pixel;
  std::optional<int> max_bounces;
  std::map<const Material*, std::string> material_names;
  /// Where each shape stands, of each type in the scene's order.
  std::map<ShapeType, std::vector<LineAndColumn>> shape_places;
  std::vector<std::string> warnings;  ///< one line each, with file and line
};

}  // namespace lightwalk
