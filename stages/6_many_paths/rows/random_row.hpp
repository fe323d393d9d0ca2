#pragma once

// # Random numbers for each path
//
// Each lane draws from its own sample's sequence, and only when its path
// would draw: then the numbers are those that the path has alone.

#include "common/math/random.hpp"
#include "stages/6_many_paths/rows/vector_row.hpp"

#ifdef LIGHTWALK_ROWS

namespace lightwalk {

/// 64 bits in each lane.
using Bits = Row<std::uint64_t>;

HWY_INLINE Bits operator^(const Bits& a, const Bits& b) {
  return part_by_part<Bits>(
      [](auto x, auto y) HWY_ATTR { return hn::Xor(x, y); }, a, b);
}
HWY_INLINE Bits operator>>(const Bits& a, int distance) {
  return part_by_part<Bits>(
      [=](auto x) HWY_ATTR { return hn::ShiftRightSame(x, distance); }, a);
}
/// The lower 64 bits of the product, made of 32 bits times 32 bits, as most
/// processors have no more.
HWY_INLINE Bits operator*(const Bits& a, std::uint64_t b) {
  const Bits::Tag bits;
  const hn::Repartition<std::uint32_t, Bits::Tag> halves;
  const auto lower = hn::BitCast(halves, hn::Set(bits, b));
  const auto upper = hn::BitCast(halves, hn::Set(bits, b >> 32));
  return part_by_part<Bits>(
      [=](auto x) HWY_ATTR {
        const auto x_lower = hn::BitCast(halves, x);
        const auto x_upper = hn::BitCast(halves, hn::ShiftRight<32>(x));
        const auto across =
            hn::Add(hn::MulEven(x_lower, upper), hn::MulEven(x_upper, lower));
        return hn::Add(hn::MulEven(x_lower, lower),
                       hn::ShiftLeft<32>(across));
      },
      a);
}

/// A Random in each lane.
class Randoms {
 public:
  Randoms() = default;
  HWY_INLINE Randoms(std::uint64_t seed, const Bits& pixel,
                     const Bits& sample)
      : state_(Random::key(seed, pixel, sample)) {}

  Random operator[](int lane) const { return Random(state_[lane]); }
  void set(int lane, const Random& random) {
    state_.set(lane, random.state());
  }

  /// A number for each lane that wants one, uniform in [0, 1). The others
  /// draw nothing.
  HWY_INLINE Floats uniform(const Mask& wanted) {
    return to_floats(next(wanted) >> 40);
  }
  HWY_INLINE Vec2s uniform_2d(const Mask& wanted) {
    const Bits bits = next(wanted);
    return {to_floats(bits >> 40), to_floats((bits >> 16) & Bits(0xffffff))};
  }

 private:
  HWY_INLINE Bits next(const Mask& wanted) {
    state_ = state_ + (Bits(Random::step) & everywhere(wanted));
    return Random::mix(state_);
  }

  /// All bits of the lanes that are set.
  static HWY_INLINE Bits everywhere(const Mask& mask) {
    const hn::RebindToSigned<Bits::Tag> wide;
    const hn::Half<Ints::Tag> half;
    Bits row;
    const auto widen = [&](auto part, auto& lower, auto& upper) HWY_ATTR {
      const auto narrow =
          hn::VecFromMask(Ints::Tag(), hn::RebindMask(Ints::Tag(), part));
      lower = hn::BitCast(Bits::Tag(),
                          hn::PromoteTo(wide, hn::LowerHalf(half, narrow)));
      upper = hn::BitCast(Bits::Tag(),
                          hn::PromoteTo(wide, hn::UpperHalf(half, narrow)));
    };
    widen(mask.part[0], row.part[0], row.part[1]);
    if constexpr (Mask::parts > 1) {
      widen(mask.part[1], row.part[2], row.part[3]);
    }
    return row;
  }

  /// 24 bits of each lane as a number in [0, 1).
  static HWY_INLINE Floats to_floats(const Bits& bits) {
    Floats row;
    const auto narrow = [](auto lower, auto upper) HWY_ATTR {
      const Ints::Tag ints;
      return hn::ConvertTo(Floats::Tag(),
                           hn::ConcatEven(ints, hn::BitCast(ints, upper),
                                          hn::BitCast(ints, lower)));
    };
    row.part[0] = narrow(bits.part[0], bits.part[1]);
    if constexpr (Floats::parts > 1) {
      row.part[1] = narrow(bits.part[2], bits.part[3]);
    }
    return row * 0x1p-24f;
  }

  Bits state_;
};

}  // namespace lightwalk

#endif
