#pragma once

// # Eight at a time
//
// A processor adds eight floats about as fast as one, if they lie side by
// side. So shapes are kept by type, eight to a pack, and a ray meets a whole
// pack at once. `Float8` is such a row of eight numbers; all operations work
// on each of the eight lanes by itself, in the same order and with the same
// rounding as one float would, so the compiler's vectors and the plain loop
// beside them give the same bits.

#include <cmath>
#include <cstdint>
#include <cstring>

#include "common/vector.hpp"

namespace lightwalk {

inline constexpr int lane_count = 8;

#if (defined(__GNUC__) || defined(__clang__)) && \
    !defined(LIGHTWALK_PLAIN_LANES)

using Float8 = float __attribute__((vector_size(32)));
using Int8 = std::int32_t __attribute__((vector_size(32)));  // also a mask

inline Float8 select(Int8 mask, Float8 yes, Float8 no) {
  return mask ? yes : no;
}
inline Int8 select(Int8 mask, Int8 yes, Int8 no) {
  return mask ? yes : no;
}

#else

/// Eight numbers, for compilers without vectors. A mask is 0 or -1.
template <class Number>
struct Row {
  Number lane[lane_count];

  Number& operator[](int i) { return lane[i]; }
  const Number& operator[](int i) const { return lane[i]; }
};
using Float8 = Row<float>;
using Int8 = Row<std::int32_t>;

template <class Result, class Function>
Result each_lane(Function function) {
  Result result;
  for (int i = 0; i < lane_count; ++i) result[i] = function(i);
  return result;
}

#define LIGHTWALK_ARITHMETIC(op)                                   \
  inline Float8 operator op(const Float8& a, const Float8& b) {    \
    return each_lane<Float8>([&](int i) { return a[i] op b[i]; }); \
  }                                                                \
  inline Float8 operator op(const Float8& a, float b) {            \
    return each_lane<Float8>([&](int i) { return a[i] op b; });    \
  }                                                                \
  inline Float8 operator op(float a, const Float8& b) {            \
    return each_lane<Float8>([&](int i) { return a op b[i]; });    \
  }
#define LIGHTWALK_COMPARISON(op)                                    \
  inline Int8 operator op(const Float8& a, const Float8& b) {       \
    return each_lane<Int8>([&](int i) { return -(a[i] op b[i]); }); \
  }                                                                 \
  inline Int8 operator op(const Float8& a, float b) {               \
    return each_lane<Int8>([&](int i) { return -(a[i] op b); });    \
  }
LIGHTWALK_ARITHMETIC(+)
LIGHTWALK_ARITHMETIC(-)
LIGHTWALK_ARITHMETIC(*)
LIGHTWALK_ARITHMETIC(/)
LIGHTWALK_COMPARISON(<)
LIGHTWALK_COMPARISON(<=)
LIGHTWALK_COMPARISON(>)
LIGHTWALK_COMPARISON(>=)
#undef LIGHTWALK_ARITHMETIC
#undef LIGHTWALK_COMPARISON

inline Float8 operator-(const Float8& a) {
  return each_lane<Float8>([&](int i) { return -a[i]; });
}
inline Int8 operator&(const Int8& a, const Int8& b) {
  return each_lane<Int8>([&](int i) { return a[i] & b[i]; });
}
inline Float8 select(const Int8& mask, const Float8& yes, const Float8& no) {
  return each_lane<Float8>([&](int i) { return mask[i] ? yes[i] : no[i]; });
}
inline Int8 select(const Int8& mask, const Int8& yes, const Int8& no) {
  return each_lane<Int8>([&](int i) { return mask[i] ? yes[i] : no[i]; });
}

#endif

/// Eight times the same number.
inline Float8 broadcast(float x) {
  return Float8{x, x, x, x, x, x, x, x};
}
inline Int8 broadcast(std::int32_t x) {
  return Int8{x, x, x, x, x, x, x, x};
}

inline Float8 sqrt(Float8 x) {
  for (int i = 0; i < lane_count; ++i) x[i] = std::sqrt(x[i]);
  return x;
}

inline Float8 abs(Float8 x) {
  for (int i = 0; i < lane_count; ++i) x[i] = std::abs(x[i]);
  return x;
}

/// Whether a lane of the mask is set.
inline bool any(const Int8& mask) {
  std::uint64_t halves[4];
  static_assert(sizeof halves == sizeof mask);
  std::memcpy(halves, &mask, sizeof mask);
  return (halves[0] | halves[1] | halves[2] | halves[3]) != 0;
}

/// Eight vectors, each component in its own row.
struct Vec3x8 {
  Float8 x = broadcast(0.0f), y = broadcast(0.0f), z = broadcast(0.0f);

  void set(int lane, const Vec3& v) {
    x[lane] = v.x;
    y[lane] = v.y;
    z[lane] = v.z;
  }
};

inline Float8 dot(const Vec3x8& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Float8 dot(const Vec3x8& a, const Vec3x8& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3x8 operator-(const Vec3& a, const Vec3x8& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3x8 operator-(const Vec3x8& a, const Vec3x8& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
/// For each lane a, the vector a * b.
inline Vec3x8 scale(const Float8& a, const Vec3& b) {
  return {a * b.x, a * b.y, a * b.z};
}
inline Vec3x8 operator+(const Vec3x8& a, const Vec3x8& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

}  // namespace lightwalk
