#pragma once

// # All shapes of one type
//
// Shapes are kept twice: as they were given, for the members of a hit, and in
// packs of eight, with just what it takes to find the hit.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/geometry/bounding_volume_hierarchy.hpp"

namespace lightwalk {

/// From this many shapes of a type on, they are kept in a tree of boxes. The
/// number is chosen: fewer shapes are at most eight packs, as many as a node
/// has. tests/core/test_bounding_volume_hierarchy.cpp checks the answers of
/// trees from this size on.
inline constexpr std::size_t many_shapes = 64;

/// The shapes of one type, as they are and in packs of eight.
template <class Shape, class Pack>
class ShapeList {
 public:
  void add(const Shape& shape) {
    if (!tree_.empty()) forget_tree();
    shapes_.push_back(shape);
    add_to_packs(shapes_.size() - 1, shapes_.size() - 1);
  }

  /// Arranges the packs for fast search, if there are many shapes. Shapes
  /// that are added later undo it.
  void prepare() {
    if constexpr (requires(const Shape& one) { bounds(one); }) {
      if (shapes_.size() < many_shapes || !tree_.empty()) return;
      tree_ = BoundingVolumeHierarchy(shapes_, order_);
      packs_ = {};
      packs_.reserve(order_.size() / lane_count);
      for (std::size_t slot = 0; slot < order_.size(); ++slot) {
        add_to_packs(slot, order_[slot]);
      }
    }
  }

  const std::vector<Shape>& shapes() const { return shapes_; }
  const std::vector<Pack>& packs() const { return packs_; }
  const BoundingVolumeHierarchy& tree() const { return tree_; }

  /// The number of lanes of all packs, set or not.
  std::size_t slot_count() const { return packs_.size() * lane_count; }

  /// The index of the shape in a slot: slot 11 is lane 3 of pack 1.
  std::size_t index(std::size_t slot) const {
    return order_.empty() ? slot : order_[slot];
  }

 private:
  void add_to_packs(std::size_t slot, std::size_t index) {
    const int lane = static_cast<int>(slot % lane_count);
    if (lane == 0) packs_.emplace_back();
    if (index < shapes_.size()) packs_.back().set(lane, shapes_[index]);
  }

  void forget_tree() {
    tree_ = {};
    order_.clear();
    packs_.clear();
    for (std::size_t i = 0; i < shapes_.size(); ++i) add_to_packs(i, i);
  }

  std::vector<Shape> shapes_;
  std::vector<Pack> packs_;
  BoundingVolumeHierarchy tree_;
  std::vector<std::uint32_t> order_;  ///< of the shapes in the packs
};

}  // namespace lightwalk
