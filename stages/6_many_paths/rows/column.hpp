#pragma once

// # Looking up sixteen things at once
//
// With one path, `materials[i]` is a place in memory. With sixteen, each lane
// has an i of its own. Processors can fetch from sixteen places, one after
// the other. But they can also shuffle the numbers of a register at once, and
// a scene of up to 16 shapes fits into one: then the table is loaded whole,
// and each lane picks from it.

#include <vector>

#include "stages/6_many_paths/rows/vector_row.hpp"

#ifdef LIGHTWALK_ROWS

namespace lightwalk {

/// One column of a table, of floats or of ints.
template <class Number>
class Column {
 public:
  void push_back(Number number) {
    // Whole registers can be loaded from it.
    const auto padded = static_cast<std::size_t>(2 * register_lanes<Number>);
    const auto size = static_cast<std::size_t>(size_++);
    if (size == numbers_.size()) numbers_.resize(std::max(padded, 2 * size));
    numbers_[size] = number;
  }

  /// The value in each lane's line, 0 to size - 1.
  HWY_INLINE Row<Number> at(const Ints& line) const {
    const RegisterTag<Number> tag;
    constexpr auto lanes = register_lanes<Number>;
    const Number* const first = numbers_.data();
    if (size_ > 2 * lanes) {
      return part_by_part<Row<Number>>(
          [=](auto i) HWY_ATTR { return hn::GatherIndex(tag, first, i); },
          line);
    }
    const auto low = hn::LoadU(tag, first);
    if (size_ <= lanes) {
      return part_by_part<Row<Number>>(
          [=](auto i) HWY_ATTR {
            return hn::TableLookupLanes(low, hn::IndicesFromVec(tag, i));
          },
          line);
    }
    const auto high = hn::LoadU(tag, first + lanes);
    return part_by_part<Row<Number>>(
        [=](auto i) HWY_ATTR {
          const auto last = hn::Set(Ints::Tag(), lanes - 1);
          const auto index = hn::IndicesFromVec(tag, hn::And(i, last));
          return hn::IfThenElse(hn::RebindMask(tag, hn::Gt(i, last)),
                                hn::TableLookupLanes(high, index),
                                hn::TableLookupLanes(low, index));
        },
        line);
  }

 private:
  int size_ = 0;
  std::vector<Number> numbers_;
};

/// A column of vectors.
class Vec3Column {
 public:
  void push_back(const Vec3& v) {
    x_.push_back(v.x);
    y_.push_back(v.y);
    z_.push_back(v.z);
  }
  HWY_INLINE Vec3s at(const Ints& line) const {
    return {x_.at(line), y_.at(line), z_.at(line)};
  }

 private:
  Column<float> x_, y_, z_;
};

}  // namespace lightwalk

#endif
