#pragma once

// # Many shapes
//
// Ten shapes are best tried one pack after the other. With a million nearly
// all of that work is in vain, so packs of shapes that are close together are
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
#include "common/geometry/lanes.hpp"
#include "common/geometry/ray.hpp"

namespace lightwalk {

// ## Building
//
// From the top: a list of shapes is cut in two, and the larger part again,
// until there are eight parts or each fits into a pack. Where to cut? A ray
// that meets a box meets a smaller box within it with a probability that is
// the ratio of their surfaces. So the expected work after a cut is the number
// of packs on each side, weighted with the surface of that side's box (the
// surface area heuristic, Goldsmith and Salmon 1987). Trying every cut would
// take long: the centers are sorted into 16 bins along each axis, and only
// cuts between bins are tried (Wald, "On fast Construction of SAH-based
// Bounding Volume Hierarchies", 2007).

class BoundingVolumeHierarchy {
 public:
  BoundingVolumeHierarchy() = default;

  /// `order` becomes the shapes' indices as the leaves have them, eight to a
  /// pack; lanes that stay free have `no_shape`.
  template <class Shape>
  BoundingVolumeHierarchy(const std::vector<Shape>& shapes,
                          std::vector<std::uint32_t>& order) {
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

  static constexpr std::uint32_t no_shape = 0xffffffff;

  bool empty() const { return nodes_.empty(); }

  // #region walk
  /// Calls `visit(pack)` for the packs that the ray may meet, the nearest of
  /// a node's boxes first. It returns the distance up to which hits still
  /// matter.
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
        const BoundsMet met = box_ray.meet(node.boxes, end);
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

  /// Calls `visit(pack)` for the packs whose boxes meet this one, in their
  /// order, until it returns false.
  template <class Visit>
  void visit_near(const Bounds& box, Visit visit) const {
    std::array<std::int32_t, stack_size> later{};
    std::size_t height = 1;
    while (height > 0) {
      const std::int32_t next = later[--height];
      if (next < 0) {
        if (!visit(static_cast<std::uint32_t>(~next))) return;
        continue;
      }
      const Node& node = nodes_[static_cast<std::size_t>(next)];
      const unsigned lanes = lanes_of(node.boxes.meet(box));
      for (int lane = lane_count - 1; lane >= 0; --lane) {
        if (lanes >> lane & 1) later[height++] = node.child[lane];
      }
    }
  }

 private:
  /// A child is a node, or, as ~pack, a pack of shapes.
  struct Node {
    BoundsPack boxes;
    std::int32_t child[lane_count] = {};
  };
  struct Entry {
    float distance;
    std::int32_t child;
  };
  struct Item {
    Bounds box;
    std::uint32_t shape;
  };

  /// Some of the shapes, and what is around them and around their centers.
  struct Part {
    Item *begin, *end;
    Bounds box, centers;

    Part(Item* begin_, Item* end_) : begin(begin_), end(end_) {
      for (const Item* item = begin; item != end; ++item) {
        box.include(item->box);
        centers.include(item->box.center());
      }
    }
    std::ptrdiff_t size() const { return end - begin; }
    bool fits_a_pack() const { return size() <= lane_count; }
  };

  // Below this depth parts are halved, which ends soon whatever the scene.
  static constexpr int deepest_cut = 32;
  static constexpr std::size_t stack_size = lane_count * (deepest_cut + 12);
  static constexpr int bin_count = 16;

  std::int32_t build(const Part& whole, int depth,
                     std::vector<std::uint32_t>& order) {
    const auto index = nodes_.size();
    nodes_.emplace_back();
    std::vector<Part> parts{whole};
    while (parts.size() < lane_count) {
      // Cut the part that rays meet most often.
      std::size_t largest = parts.size();
      for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!parts[i].fits_a_pack() &&
            (largest == parts.size() ||
             parts[i].box.half_area() > parts[largest].box.half_area())) {
          largest = i;
        }
      }
      if (largest == parts.size()) break;
      const Part part = parts[largest];
      Item* const middle = cut(part, depth);
      parts[largest] = Part(part.begin, middle);
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

  /// The bin of a center along an axis.
  static int bin_of(const Part& part, const Item& item, int axis) {
    const float low = part.centers.low[axis], high = part.centers.high[axis];
    const float share = (item.box.center()[axis] - low) / (high - low);
    return std::min(static_cast<int>(share * bin_count), bin_count - 1);
  }

  /// Arranges a part in two, and returns where the second begins.
  static Item* cut(const Part& part, int depth) {
    float best = infinity;
    int best_axis = -1, best_bin = 0;
    for (int axis = 0; axis < 3 && depth < deepest_cut; ++axis) {
      const float extent = part.centers.high[axis] - part.centers.low[axis];
      if (!(extent > 0 && extent < infinity)) continue;
      struct Bin {
        Bounds box;
        std::ptrdiff_t count = 0;
      };
      std::array<Bin, bin_count> bins;
      for (const Item* item = part.begin; item != part.end; ++item) {
        Bin& bin = bins[static_cast<std::size_t>(bin_of(part, *item, axis))];
        bin.box.include(item->box);
        ++bin.count;
      }
      // The work to the right of each cut, then that to its left.
      std::array<float, bin_count> right{};
      Bin side;
      const auto include = [&side](const Bin& bin) {
        side.box.include(bin.box);
        side.count += bin.count;
        const std::ptrdiff_t packs =
            (side.count + lane_count - 1) / lane_count;
        return static_cast<float>(packs) * side.box.half_area();
      };
      for (std::size_t i = bin_count - 1; i > 0; --i) {
        right[i] = include(bins[i]);
      }
      side = Bin{};
      for (std::size_t i = 1; i < bin_count; ++i) {
        const float work = include(bins[i - 1]) + right[i];
        if (side.count > 0 && side.count < part.size() && work < best) {
          best = work;
          best_axis = axis;
          best_bin = static_cast<int>(i);
        }
      }
    }
    // All in one place, or too deep already: any halves will do.
    if (best_axis < 0) return part.begin + part.size() / 2;
    return std::partition(part.begin, part.end, [&](const Item& item) {
      return bin_of(part, item, best_axis) < best_bin;
    });
  }

  std::vector<Node> nodes_;
};

}  // namespace lightwalk
