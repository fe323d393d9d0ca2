#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "common/scene_file/loaded_scene.hpp"

namespace lightwalk {

/// So many shapes in one place make a scene slow: a thousand spheres take a
/// ray as long as the rest of most scenes.
inline constexpr std::size_t crowded = 1000;

/// A warning if a tree of boxes is of no use, because very many shapes have
/// the same box; it begins with a line and a column.
inline std::optional<std::string> crowded_shapes(const LoadedScene& loaded) {
  const Geometry::Crowd crowd = loaded.scene.geometry.crowd();
  if (crowd.count < crowded) return std::nullopt;
  const LineAndColumn& place =
      loaded.shape_places.at(crowd.type)[crowd.first];
  constexpr const char* names[] = {"planes", "spheres", "rectangles",
                                   "triangles"};
  return std::to_string(place.line) + ':' + std::to_string(place.column) +
         ": warning: " + std::to_string(crowd.count) + ' ' +
         names[static_cast<std::size_t>(crowd.type)] +
         " take up the same place, this one first: each ray that comes near "
         "tries all of them, and that takes long";
}

}  // namespace lightwalk
