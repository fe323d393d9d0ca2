#pragma once

// # Where to cut
//
// A tree of boxes is built from the top: a list of shapes is cut in two, and
// the larger part again, until there are eight parts or each fits into a
// pack. Where to cut? A ray that meets a box meets a smaller box within it
// with a probability that is the ratio of their surfaces. So the expected
// work after a cut is the number of packs on each side, weighted with the
// surface of that side's box (the surface area heuristic, Goldsmith and
// Salmon 1987). Trying every cut would take long: the centers are sorted into
// 16 bins along each axis, and only cuts between bins are tried (Wald, "On
// fast Construction of SAH-based Bounding Volume Hierarchies", 2007).
//
// The centers of concentric shells are all the same. So where a cut by
// centers saves little, the shapes are sorted by the sizes of their boxes as
// well. No cut can separate shapes that are equal in both.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "common/geometry/bounds.hpp"
#include "common/geometry/lanes.hpp"

namespace lightwalk::bvh {

/// A shape while the tree is built.
struct Item {
  Bounds box;
  std::uint32_t shape;
};

/// Some of the shapes, with the bounds of them and of their centers.
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

/// The expected work for a box with so many shapes, up to a constant factor.
inline float sah_cost(const Bounds& box, std::ptrdiff_t count) {
  const std::ptrdiff_t packs = (count + lane_count - 1) / lane_count;
  return static_cast<float>(packs) * box.half_area();
}

/// What shapes are sorted by: the centers of their boxes along axis `by`, or,
/// from 3 on, the sizes along axis `by - 3`.
inline float sorting_key(const Item& item, int by) {
  const Bounds& box = item.box;
  return by < 3 ? box.center()[by] : box.high[by - 3] - box.low[by - 3];
}

inline constexpr int bin_count = 16;

/// Between which bins a part is cut.
struct Cut {
  float work = infinity;  ///< of rays, after it
  int by = 0, bin = 0;
  float low = 0, extent = 0;  ///< of all keys

  int bin_of(const Item& item) const {
    const float share = (sorting_key(item, by) - low) / extent;
    return std::min(static_cast<int>(share * bin_count), bin_count - 1);
  }
};

/// Looks for a better cut by a key that lies between `low` and `high`.
inline void improve(Cut& best, const Part& part, int by, float low,
                    float high) {
  Cut next{.by = by, .low = low, .extent = high - low};
  if (!(next.extent > 0 && next.extent < infinity)) return;
  struct Bin {
    Bounds box;
    std::ptrdiff_t count = 0;
    void include(const Bin& other) {
      box.include(other.box);
      count += other.count;
    }
  };
  std::array<Bin, bin_count> bins;
  for (const Item* item = part.begin; item != part.end; ++item) {
    bins[static_cast<std::size_t>(next.bin_of(*item))].include(
        {item->box, 1});
  }
  // The work to the right of each cut, then that to its left.
  std::array<float, bin_count> right{};
  Bin side;
  for (std::size_t i = bin_count - 1; i > 0; --i) {
    side.include(bins[i]);
    right[i] = sah_cost(side.box, side.count);
  }
  side = {};
  for (std::size_t i = 1; i < bin_count; ++i) {
    side.include(bins[i - 1]);
    next.work = sah_cost(side.box, side.count) + right[i];
    next.bin = static_cast<int>(i);
    if (side.count > 0 && side.count < part.size() && next.work < best.work) {
      best = next;
    }
  }
}

/// The best cut; its work is infinite if there is none.
inline Cut best_cut(const Part& part) {
  Cut best;
  const Bounds& centers = part.centers;
  for (int axis = 0; axis < 3; ++axis) {
    improve(best, part, axis, centers.low[axis], centers.high[axis]);
  }
  // A cut by centers that saves a fifth of the work is good enough. The fifth
  // is chosen: it trades time of building for time of rendering, and changes
  // no answer. tests/core/test_deep_trees.cpp has shells, which need sizes.
  if (best.work < 0.8f * sah_cost(part.box, part.size())) return best;
  Bounds sizes;
  for (const Item* item = part.begin; item != part.end; ++item) {
    sizes.include(item->box.high - item->box.low);
  }
  for (int axis = 0; axis < 3; ++axis) {
    improve(best, part, axis + 3, sizes.low[axis], sizes.high[axis]);
  }
  return best;
}

/// Splits a part in two, and returns where the second begins. Without a cut,
/// any halves will do.
inline Item* cut(const Part& part) {
  const Cut best = best_cut(part);
  if (!(best.work < infinity)) return part.begin + part.size() / 2;
  return std::partition(part.begin, part.end, [&](const Item& item) {
    return best.bin_of(item) < best.bin;
  });
}

}  // namespace lightwalk::bvh
