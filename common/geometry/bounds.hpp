#pragma once

// # Bounds
//
// A box with its sides along the axes is quickly intersected, and every shape
// but a plane fits into one. A tree of boxes finds the few shapes near a ray
// among a million: see common/geometry/bounding_volume_hierarchy.hpp.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "common/geometry/lanes.hpp"
#include "common/geometry/ray.hpp"
#include "common/geometry/rectangle_and_triangle.hpp"
#include "common/geometry/sphere.hpp"

namespace lightwalk {

// #region box
/// What lies between two corners; empty at first.
struct Bounds {
  Vec3 low{infinity}, high{-infinity};

  void include(const Vec3& position) {
    low = glm::min(low, position);
    high = glm::max(high, position);
  }
  void include(const Bounds& box) {
    low = glm::min(low, box.low);
    high = glm::max(high, box.high);
  }
  Vec3 center() const { return 0.5f * low + 0.5f * high; }

  /// Half the surface area; 0 for an empty box.
  float half_area() const {
    const Vec3 size = glm::max(high - low, Vec3(0));
    return size.x * size.y + size.y * size.z + size.z * size.x;
  }
};
// #endregion box

// A hit is off by a few roundings, and flat shapes reach a little over their
// edges, so boxes are a little larger than what they hold: on each side by
// $2^{-18}$, or 64 roundings of $2^{-24}$, of the largest coordinate $m$. The
// corners have two roundings. A flat shape at distance $d$, with edges of
// length $l$ at a right angle, reaches $8 (l + d) / \cos\theta$ roundings
// over its edge, and $l$ is at most $2m$ along an axis. So 64 are enough
// straight ahead ($\cos\theta = 1$) up to $d = 5m$. For all other rays and
// edges the number is chosen: a tree may miss a hit beyond an edge.
// tests/fuzz/tree.cpp checks that a tree finds every hit that lies within
// half of this margin.

inline Bounds widened(Bounds box) {
  const float more = 0x1p-18f * std::max(max_abs_component(box.low),
                                         max_abs_component(box.high));
  return {box.low - more, box.high + more};
}
inline Bounds bounds(const Sphere& sphere) {
  return widened(
      {sphere.center - sphere.radius, sphere.center + sphere.radius});
}
inline Bounds bounds(const Triangle& triangle) {
  Bounds box;
  box.include(triangle.corner);
  box.include(triangle.corner + triangle.edge_u);
  box.include(triangle.corner + triangle.edge_v);
  return widened(box);
}
inline Bounds bounds(const Rectangle& rectangle) {
  Bounds box;
  box.include(rectangle.corner);
  box.include(rectangle.corner + rectangle.edge_u);
  box.include(rectangle.corner + rectangle.edge_v);
  box.include(rectangle.corner + rectangle.edge_u + rectangle.edge_v);
  return widened(box);
}

/// Eight boxes. A lane that is not set is met by no ray.
struct BoundsPack {
  std::array<Vec3x8, 2> corners;  // the low ones and the high ones

  BoundsPack() {
    for (int i = 0; i < lane_count; ++i) set(i, Bounds{});
  }
  void set(int lane, const Bounds& box) {
    corners[0].set(lane, box.low);
    corners[1].set(lane, box.high);
  }
};

// ## Meeting a box
//
// A box is the intersection of three slabs, each between two parallel planes.
// The ray enters each slab at one distance and leaves it at another, and it
// is in the box where it is in all three slabs. A direction of 0 along an
// axis would give 0/0 on the planes themselves, so it is replaced by a very
// small one.
//
// Rounding must not let a ray miss a box that it meets. So the farther of two
// planes is taken to be farther than it is, by more than all roundings here:
// the near distance has three of $2^{-24}$, the far one four, and $2^{-20}$
// is sixteen.

/// Which of eight boxes a ray meets.
struct BoxHits {
  unsigned lanes;    ///< a bit for each box that it meets
  Float8 distances;  ///< where it enters them
};

/// A ray, prepared to be intersected with many boxes.
class BoundsRay {
 public:
  explicit BoundsRay(const Ray& ray) : origin_(ray.origin) {
    for (int axis = 0; axis < 3; ++axis) {
      const float d = ray.direction[axis];
      to_near_[axis] =
          1 / (std::abs(d) < 1e-18f ? std::copysign(1e-18f, d) : d);
      near_[static_cast<std::size_t>(axis)] = to_near_[axis] < 0;
    }
    to_far_ = to_near_ * (1 + 0x1p-20f);
  }

  // #region box-intersection
  /// The boxes that the ray is in somewhere between distances 0 and `end`.
  BoxHits meet(const BoundsPack& boxes, float end) const {
    Float8 first = broadcast(0.0f), last = broadcast(end);
    clip(boxes, &Vec3x8::x, 0, first, last);
    clip(boxes, &Vec3x8::y, 1, first, last);
    clip(boxes, &Vec3x8::z, 2, first, last);
    return {lanes_of(first <= last), first};
  }

 private:
  void clip(const BoundsPack& boxes, Float8 Vec3x8::*along, int axis,
            Float8& first, Float8& last) const {
    const std::size_t nearer = near_[static_cast<std::size_t>(axis)];
    const Float8& near_plane = boxes.corners[nearer].*along;
    const Float8& far_plane = boxes.corners[1 - nearer].*along;
    first = max(first, (near_plane - origin_[axis]) * to_near_[axis]);
    last = min(last, (far_plane - origin_[axis]) * to_far_[axis]);
  }
  // #endregion box-intersection

  Vec3 origin_, to_near_, to_far_;
  std::array<std::size_t, 3> near_;  // which corner's plane is met first
};

}  // namespace lightwalk
