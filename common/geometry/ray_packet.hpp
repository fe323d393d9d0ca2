#pragma once

// # Sixteen rays at once
//
// Where a pack of eight shapes meets one ray, eight answers must be searched
// for the nearest. It is less work the other way around: one shape meets
// eight rays, and each of them keeps its own nearest. But a path has only one
// ray at a time.
//
// So sixteen paths are on their way at once. Each puts the ray that it wants
// to know about into its place of a packet, and waits. When all sixteen wait,
// their rays meet every shape together, and all can go on. How a path waits
// is told in common/geometry/path_group.hpp.

#include <array>
#include <cstdint>

#include "common/geometry/lanes.hpp"
#include "common/geometry/ray.hpp"

namespace lightwalk {

/// Eight rays.
struct Ray8 {
  Vec3x8 origin, direction;
};

/// What a ray meets first.
struct FirstShape {
  float distance;      ///< infinity where it meets nothing
  std::int32_t place;  ///< the shape's, as Geometry counts them
};

/// Sixteen rays, eight to a row, and what they meet.
struct RayPacket {
  static constexpr int row_count = 2;
  static constexpr int size = row_count * lane_count;

  struct Row {
    Ray8 rays;
    Float8 distance = broadcast(infinity);
    Int8 place = broadcast(std::int32_t{0});

    void put(int lane, const Ray& ray) {
      rays.origin.set(lane, ray.origin);
      rays.direction.set(lane, ray.direction);
    }
    FirstShape first(int lane) const { return {distance[lane], place[lane]}; }
  };
  std::array<Row, row_count> rows;
};

}  // namespace lightwalk
