#pragma once

// # A number for each path
//
// A register of a processor holds 4, 8 or 16 floats, and an instruction works
// on all of them in the time of one. `Floats` is such a row of numbers, one
// for each of as many paths. What happens in a lane of it is what would
// happen to a single float, with the same rounding: so the bits of a picture
// do not depend on the length of the row.
//
// `Doubles` and `Ints` are rows of other numbers, and a `Mask` is a row of
// answers to yes or no. A row has 16 lanes where a register holds 8 floats or
// 16, and otherwise as many as it holds. The instructions are chosen by
// Highway (github.com/google/highway), which knows them for each processor.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "common/math/vector.hpp"
#include "stages/6_many_paths/rows/registers.hpp"

#ifdef LIGHTWALK_ROWS

namespace lightwalk {

namespace hn = hwy::HWY_NAMESPACE;

/// What a register holds, in Highway's words.
template <class Number>
using RegisterTag = hn::ScalableTag<Number>;
template <class Number>
inline constexpr int register_lanes =
    static_cast<int>(hn::MaxLanes(RegisterTag<Number>()));

inline constexpr int row_lanes =
    register_lanes<float> >= 8 ? 16 : register_lanes<float>;
template <class Number>
inline constexpr int row_parts = row_lanes / register_lanes<Number>;

// Row after row of the same: `operation` with each part of some rows. `x...`
// are the parts.
template <class Result, class Operation, class... Rows>
HWY_INLINE Result part_by_part(Operation operation, const Rows&... rows) {
  Result result;
  result.part[0] = operation(rows.part[0]...);
  // Not a loop: GCC keeps in memory what a loop indexes.
  if constexpr (Result::parts > 1)
    result.part[1] = operation(rows.part[1]...);
  if constexpr (Result::parts > 2) {
    result.part[2] = operation(rows.part[2]...);
    result.part[3] = operation(rows.part[3]...);
  }
  static_assert(Result::parts == 1 || Result::parts == 2 ||
                Result::parts == 4);
  return result;
}
#define LIGHTWALK_EACH(Result, operation, ...)                       \
  part_by_part<Result>([](auto... x) HWY_ATTR { return operation; }, \
                       __VA_ARGS__)

/// Yes or no in each lane, from a comparison of rows of `Number`.
template <class Number>
struct MaskOf {
  using Tag = RegisterTag<Number>;
  static constexpr int parts = row_parts<Number>;
  hn::Mask<Tag> part[parts];

  friend HWY_INLINE MaskOf operator&(const MaskOf& a, const MaskOf& b) {
    return LIGHTWALK_EACH(MaskOf, hn::And(x...), a, b);
  }
  friend HWY_INLINE MaskOf operator|(const MaskOf& a, const MaskOf& b) {
    return LIGHTWALK_EACH(MaskOf, hn::Or(x...), a, b);
  }
  friend HWY_INLINE MaskOf operator!(const MaskOf& a) {
    return LIGHTWALK_EACH(MaskOf, hn::Not(x...), a);
  }
};
using Mask = MaskOf<float>;

/// A number in each lane. A single number is the same in all of them.
template <class Number>
struct Row {
  using Tag = RegisterTag<Number>;
  // Ints are compared into the masks of floats, which are as wide.
  using MaskNumber =
      std::conditional_t<std::is_same_v<Number, double>, double, float>;
  using RowMask = MaskOf<MaskNumber>;
  static constexpr int parts = row_parts<Number>;
  hn::Vec<Tag> part[parts];

  Row() = default;
  HWY_INLINE Row(Number all)
      : Row(part_by_part<Row>([=]()
                                  HWY_ATTR { return hn::Set(Tag(), all); })) {
  }

  /// The number in one lane.
  Number operator[](int lane) const {
    return hn::GetLane(
        hn::LoadU(hn::CappedTag<Number, 1>(),
                  reinterpret_cast<const Number*>(part) + lane));
  }
  void set(int lane, Number number) {
    hn::StoreU(hn::Set(hn::CappedTag<Number, 1>(), number),
               hn::CappedTag<Number, 1>(),
               reinterpret_cast<Number*>(part) + lane);
  }

  friend HWY_INLINE Row operator+(const Row& a, const Row& b) {
    return LIGHTWALK_EACH(Row, hn::Add(x...), a, b);
  }
  friend HWY_INLINE Row operator-(const Row& a, const Row& b) {
    return LIGHTWALK_EACH(Row, hn::Sub(x...), a, b);
  }
  friend HWY_INLINE Row operator*(const Row& a, const Row& b) {
    return LIGHTWALK_EACH(Row, hn::Mul(x...), a, b);
  }
  friend HWY_INLINE Row operator/(const Row& a, const Row& b) {
    return LIGHTWALK_EACH(Row, hn::Div(x...), a, b);
  }
  friend HWY_INLINE Row operator&(const Row& a, const Row& b) {
    return LIGHTWALK_EACH(Row, hn::And(x...), a, b);
  }
  friend HWY_INLINE Row operator-(const Row& a) {
    return LIGHTWALK_EACH(Row, hn::Neg(x...), a);
  }
  friend HWY_INLINE RowMask operator<(const Row& a, const Row& b) {
    return compare([](auto x, auto y) HWY_ATTR { return hn::Lt(x, y); }, a,
                   b);
  }
  friend HWY_INLINE RowMask operator<=(const Row& a, const Row& b) {
    return compare([](auto x, auto y) HWY_ATTR { return hn::Le(x, y); }, a,
                   b);
  }
  friend HWY_INLINE RowMask operator==(const Row& a, const Row& b) {
    return compare([](auto x, auto y) HWY_ATTR { return hn::Eq(x, y); }, a,
                   b);
  }
  friend HWY_INLINE RowMask operator>(const Row& a, const Row& b) {
    return b < a;
  }
  friend HWY_INLINE RowMask operator>=(const Row& a, const Row& b) {
    return b <= a;
  }
  friend HWY_INLINE RowMask operator!=(const Row& a, const Row& b) {
    return !(a == b);
  }
  /// In each lane `yes` where the mask is set, and otherwise `no`.
  friend HWY_INLINE Row select(const RowMask& mask, const Row& yes,
                               const Row& no) {
    return part_by_part<Row>(
        [](auto m, auto a, auto b) HWY_ATTR {
          return hn::IfThenElse(hn::RebindMask(Tag(), m), a, b);
        },
        mask, yes, no);
  }
  friend HWY_INLINE Row sqrt(const Row& a) {
    return LIGHTWALK_EACH(Row, hn::Sqrt(x...), a);
  }
  friend HWY_INLINE Row floor(const Row& a) {
    return LIGHTWALK_EACH(Row, hn::Floor(x...), a);
  }
  friend HWY_INLINE Row abs(const Row& a) {
    return LIGHTWALK_EACH(Row, hn::Abs(x...), a);
  }
  /// The smaller of two numbers, neither of them a NaN.
  friend HWY_INLINE Row min(const Row& a, const Row& b) {
    return LIGHTWALK_EACH(Row, hn::Min(x...), a, b);
  }
  friend HWY_INLINE Row max(const Row& a, const Row& b) {
    return LIGHTWALK_EACH(Row, hn::Max(x...), a, b);
  }
  /// The size of one number with the sign of another.
  friend HWY_INLINE Row copysign(const Row& size, const Row& sign) {
    return LIGHTWALK_EACH(Row, hn::CopySign(x...), size, sign);
  }

 private:
  template <class Comparison>
  static HWY_INLINE RowMask compare(Comparison comparison, const Row& a,
                                    const Row& b) {
    return part_by_part<RowMask>(
        [&](auto x, auto y) HWY_ATTR {
          return hn::RebindMask(RegisterTag<MaskNumber>(), comparison(x, y));
        },
        a, b);
  }
};
using Floats = Row<float>;
using Doubles = Row<double>;
using Ints = Row<std::int32_t>;
#undef LIGHTWALK_EACH

/// A row has half as many doubles in a register as it has floats.
HWY_INLINE Doubles to_double(const Floats& a) {
  const RegisterTag<double> to;
  const hn::Half<RegisterTag<float>> half;
  Doubles row;
  row.part[0] = hn::PromoteTo(to, hn::LowerHalf(half, a.part[0]));
  row.part[1] = hn::PromoteTo(to, hn::UpperHalf(half, a.part[0]));
  if constexpr (Floats::parts > 1) {
    row.part[2] = hn::PromoteTo(to, hn::LowerHalf(half, a.part[1]));
    row.part[3] = hn::PromoteTo(to, hn::UpperHalf(half, a.part[1]));
  }
  return row;
}
HWY_INLINE Floats to_float(const Doubles& a) {
  const RegisterTag<float> to;
  const hn::Half<RegisterTag<float>> half;
  Floats row;
  row.part[0] = hn::Combine(to, hn::DemoteTo(half, a.part[1]),
                            hn::DemoteTo(half, a.part[0]));
  if constexpr (Floats::parts > 1) {
    row.part[1] = hn::Combine(to, hn::DemoteTo(half, a.part[3]),
                              hn::DemoteTo(half, a.part[2]));
  }
  return row;
}

/// The lanes of a mask that are set: lane 0 is bit 0.
HWY_INLINE unsigned lanes_of(const Mask& mask) {
  unsigned set = 0;
  for (int i = 0; i < Mask::parts; ++i) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Mask::Tag(), mask.part[i], bytes);
    const unsigned bits = bytes[0] + 256u * bytes[1];
    set |= bits << (i * register_lanes<float>);
  }
  return set;
}
/// The mask in which these lanes are set.
HWY_INLINE Mask mask_of(unsigned set) {
  Mask mask;
  for (int i = 0; i < Mask::parts; ++i) {
    const unsigned bits = set >> (i * register_lanes<float>);
    const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits),
                                   static_cast<std::uint8_t>(bits >> 8)};
    mask.part[i] = hn::LoadMaskBits(Mask::Tag(), bytes);
  }
  return mask;
}
HWY_INLINE bool any(const Mask& mask) {
  return lanes_of(mask) != 0;
}
HWY_INLINE Mask no_lanes() {
  return Floats(0.0f) != Floats(0.0f);
}
HWY_INLINE unsigned count(const Mask& mask) {
  return static_cast<unsigned>(std::popcount(lanes_of(mask)));
}

/// Calls `function(lane)` for each lane of the mask that is set.
template <class Function>
HWY_INLINE void for_each_lane(const Mask& mask, Function function) {
  for (unsigned set = lanes_of(mask); set != 0; set &= set - 1) {
    function(std::countr_zero(set));
  }
}

}  // namespace lightwalk

#endif
