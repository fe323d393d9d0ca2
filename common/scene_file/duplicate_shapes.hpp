#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "common/scene_file/loaded_scene.hpp"

namespace lightwalk {

/// All numbers of a shape.
using ShapeNumbers = std::array<float, 9>;
inline ShapeNumbers numbers_of(const Plane& p) {
  return {p.normal.x, p.normal.y, p.normal.z, p.distance};
}
inline ShapeNumbers numbers_of(const Sphere& s) {
  return {s.center.x, s.center.y, s.center.z, s.radius};
}
inline ShapeNumbers numbers_of(const FlatShape& f) {
  const Vec3 &a = f.corner, &u = f.edge_u, &v = f.edge_v;
  return {a.x, a.y, a.z, u.x, u.y, u.z, v.x, v.y, v.z};
}

/// A warning about the first shape that the file has twice, if there is one;
/// it begins with a line and a column. A lamp or glass that was set apart
/// from what it lies on (common/scene/scene.hpp) is not a duplicate.
inline std::optional<std::string> duplicate_shapes(
    const LoadedScene& loaded) {
  struct Entry {
    ShapeType type;
    ShapeNumbers numbers;
    LineAndColumn place;
    auto key() const { return std::tie(type, numbers, place); }
  };
  std::vector<Entry> all;
  loaded.scene.geometry.for_each_shape([&](const auto& one, const Hit& hit) {
    const auto& places = loaded.shape_places.at(hit.shape_type);
    all.push_back({hit.shape_type, numbers_of(one), places[hit.shape_index]});
  });
  std::ranges::sort(all, {}, &Entry::key);
  std::size_t count = 0, first = 0;
  for (std::size_t i = 1; i < all.size(); ++i) {
    const Entry &a = all[i - 1], &b = all[i];
    if (a.type != b.type || a.numbers != b.numbers) continue;
    if (++count == 1 || all[i].place < all[first].place) first = i;
  }
  if (count == 0) return std::nullopt;
  const Entry &earlier = all[first - 1], &later = all[first];
  return std::to_string(later.place.line) + ':' +
         std::to_string(later.place.column) + ": warning: the " +
         shape_name(later.type) + " has the same numbers as that in line " +
         std::to_string(earlier.place.line) +
         ": a ray meets only one of them; delete the other" +
         (count > 1 ? " (and " + std::to_string(count - 1) + " more)" : "");
}

}  // namespace lightwalk
