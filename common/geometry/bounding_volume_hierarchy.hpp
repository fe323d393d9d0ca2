#pragma once

// # Many shapes
//
// Ten shapes are best tried one pack after the other. With a million nearly
// all of that work is wasted, so packs of shapes that are close together are
// put into boxes, and the boxes into larger boxes: a ray that misses a box
// misses everything in it. This is a bounding volume hierarchy.
//
// The same lanes that try eight shapes at once try eight boxes at once, so
// each node of this tree has up to eight children, and each leaf is a pack.
// There are few levels to descend through. A tree takes about as much memory
// as the shapes do: 54 bytes for a sphere in all, 130 for a triangle.

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "common/geometry/bounds.hpp"
#include "common/geometry/cut.hpp"
#include "common/geometry/lanes.hpp"
#include "common/geometry/ray.hpp"

namespace lightwalk {

// ## How deep
//
// A cut may take one shape away and leave a million. So from some depth on
// parts are halved, the part with most shapes first. Then each of a node's
// eight parts has an eighth of its shapes, rounded up. There are fewer than
// 2^32 shapes: ten levels on, four of them would be left for a node, and
// these are a pack. So there are no more than ten such levels. A walk down
// keeps at most seven children of each node for later, so its stack has a
// fixed size.

class BoundingVolumeHierarchy {
 public:
  /// From this depth on parts are halved.
  static constexpr int deepest_cut = 32;
  static constexpr int max_levels = deepest_cut + 10;
  static constexpr std::uint32_t no_shape = 0xffffffff;

  BoundingVolumeHierarchy() = default;

  /// `order` becomes the shapes' indices as the leaves have them, eight to a
  /// pack; lanes that stay free have `no_shape`. Parts are halved from the
  /// depth `halved_from` on, at most `deepest_cut`.
  template <class Shape>
  BoundingVolumeHierarchy(const std::vector<Shape>& shapes,
                          std::vector<std::uint32_t>& order,
                          int halved_from = deepest_cut)
      : halved_from_(halved_from) {
    std::vector<Item> items;
    items.reserve(shapes.size());
    for (const Shape& shape : shapes) {
      items.push_back(
          {bounds(shape), static_cast<std::uint32_t>(items.size())});
    }
    order.clear();
    build(Part(items.data(), items.data() + items.size()), 0, order);
    nodes_.shrink_to_fit();
    order.shrink_to_fit();
  }

  bool empty() const { return nodes_.empty(); }

  /// The number of levels of nodes.
  int levels() const { return levels_; }

  // #region walk
  /// Calls `visit(pack)` for the packs that the ray may meet, the nearest of
  /// a node's boxes first. `visit` returns the distance up to which hits
  /// still matter.
  template <class Visit>
  void walk(const Ray& ray, float end, Visit visit) const {
    const BoundsRay box_ray(ray);
    std::array<Entry, stack_size> later;
    std::size_t height = 0;
    Entry next{0, 0};
    for (;;) {
      if (next.child < 0) {
        end = visit(static_cast<std::uint32_t>(~next.child));
      } else {
        const Node& node = nodes_[static_cast<std::size_t>(next.child)];
        const BoxHits met = box_ray.meet(node.boxes, end);
        unsigned lanes = met.lanes;
        if (lanes != 0) {  // go on with the nearest child
          const auto entry = [&] {
            const int lane = std::countr_zero(lanes);
            return Entry{met.distances[lane], node.child[lane]};
          };
          next = entry();
          while ((lanes &= lanes - 1) != 0) {
            Entry other = entry();
            if (other.distance < next.distance) std::swap(other, next);
            later[height++] = other;
          }
          continue;
        }
      }
      do {
        if (height == 0) return;
        next = later[--height];
      } while (next.distance > end);
    }
  }
  // #endregion walk

 private:
  using Item = bvh::Item;
  using Part = bvh::Part;

  /// A child is a node, or, as ~pack, a pack of shapes.
  struct Node {
    BoundsPack boxes;
    std::int32_t child[lane_count] = {};
  };
  struct Entry {
    float distance;
    std::int32_t child;
  };
  static constexpr std::size_t stack_size = (lane_count - 1) * max_levels + 1;
  std::int32_t build(const Part& whole, int depth,
                     std::vector<std::uint32_t>& order) {
    const auto index = nodes_.size();
    nodes_.emplace_back();
    levels_ = std::max(levels_, depth + 1);
    const bool halved = depth >= halved_from_;
    // Rays meet the largest box most often; of equal boxes, the one with most
    // shapes matters.
    const auto matters_less = [halved](const Part& a, const Part& b) {
      const auto key = [halved](const Part& part) {
        return std::pair(halved ? 0 : part.box.half_area(), part.size());
      };
      return b.fits_a_pack() < a.fits_a_pack() ||
             (b.fits_a_pack() == a.fits_a_pack() && key(a) < key(b));
    };
    std::vector<Part> parts{whole};
    while (parts.size() < lane_count) {
      const auto most =
          std::max_element(parts.begin(), parts.end(), matters_less);
      if (most->fits_a_pack()) break;
      const Part part = *most;
      Item* const middle =
          halved ? part.begin + part.size() / 2 : bvh::cut(part);
      *most = Part(part.begin, middle);
      parts.emplace_back(middle, part.end);
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::int32_t child = parts[i].fits_a_pack()
                                     ? add_pack(parts[i], order)
                                     : build(parts[i], depth + 1, order);
      nodes_[index].boxes.set(static_cast<int>(i), parts[i].box);
      nodes_[index].child[i] = child;
    }
    return static_cast<std::int32_t>(index);
  }

  static std::int32_t add_pack(const Part& part,
                               std::vector<std::uint32_t>& order) {
    const auto pack = static_cast<std::int32_t>(order.size() / lane_count);
    for (const Item* item = part.begin; item != part.end; ++item) {
      order.push_back(item->shape);
    }
    order.resize((static_cast<std::size_t>(pack) + 1) * lane_count, no_shape);
    return ~pack;
  }

  std::vector<Node> nodes_;
  int halved_from_ = deepest_cut, levels_ = 0;
};

}  // namespace lightwalk
