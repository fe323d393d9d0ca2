#pragma once

// # Eight at a time
//
// A processor adds four or eight floats about as fast as one, if they lie
// side by side. So shapes are kept by type, eight to a pack, and a ray meets
// a whole pack at once. `Float8` is such a row of eight numbers; all
// operations work on each of the eight lanes by itself, in the same order and
// with the same rounding as one float would. So it makes no difference to the
// bits how many lanes the processor takes at a time.
//
// A row is made of parts, each as wide as the processor's registers: one part
// of eight lanes with AVX2, two of four on any other x86 and on ARM, and
// eight single numbers for compilers without vector types. A row wider than
// the registers must not be left to the compiler: GCC splits comparisons of
// such a row into single numbers, which is slower than no vectors at all.

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "common/math/vector.hpp"

#if (defined(__GNUC__) || defined(__clang__)) && \
    !defined(LIGHTWALK_PLAIN_LANES)
#define LIGHTWALK_VECTORS
#ifdef __SSE2__
#include <immintrin.h>
#endif
#endif

namespace lightwalk {

inline constexpr int lane_count = 8;

#ifdef LIGHTWALK_VECTORS
#ifdef __AVX2__
inline constexpr int part_bytes = 32;
#else
inline constexpr int part_bytes = 16;
#endif
using FloatPart = float __attribute__((vector_size(part_bytes)));
using IntPart = std::int32_t __attribute__((vector_size(part_bytes)));
#else
inline constexpr int part_bytes = 4;
using FloatPart = float;
using IntPart = std::int32_t;
#endif
inline constexpr int part_count = 4 * lane_count / part_bytes;

/// Eight numbers in as many parts as the processor needs.
template <class Number, class Part>
struct Lanes {
  Part part[part_count];

  Number& operator[](int i) { return reinterpret_cast<Number*>(part)[i]; }
  const Number& operator[](int i) const {
    return reinterpret_cast<const Number*>(part)[i];
  }
};
using Float8 = Lanes<float, FloatPart>;
using Int8 = Lanes<std::int32_t, IntPart>;  // as a mask, 0 or -1 in each lane

template <class Result, class Function>
Result each_part(Function function) {
  Result result;
  for (int i = 0; i < part_count; ++i) result.part[i] = function(i);
  return result;
}

// A comparison of vectors gives a mask; one of single numbers gives a bool.
inline IntPart as_mask(bool b) {
  return IntPart{} - b;
}
#ifdef LIGHTWALK_VECTORS
inline IntPart as_mask(IntPart mask) {
  return mask;
}
#endif

#define LIGHTWALK_ARITHMETIC(op)                                             \
  inline Float8 operator op(const Float8& a, const Float8& b) {              \
    return each_part<Float8>([&](int i) { return a.part[i] op b.part[i]; }); \
  }                                                                          \
  inline Float8 operator op(const Float8& a, float b) {                      \
    return each_part<Float8>([&](int i) { return a.part[i] op b; });         \
  }                                                                          \
  inline Float8 operator op(float a, const Float8& b) {                      \
    return each_part<Float8>([&](int i) { return a op b.part[i]; });         \
  }
#define LIGHTWALK_COMPARISON(op)                                            \
  inline Int8 operator op(const Float8& a, const Float8& b) {               \
    return each_part<Int8>(                                                 \
        [&](int i) { return as_mask(a.part[i] op b.part[i]); });            \
  }                                                                         \
  inline Int8 operator op(const Float8& a, float b) {                       \
    return each_part<Int8>([&](int i) { return as_mask(a.part[i] op b); }); \
  }
LIGHTWALK_ARITHMETIC(+)
LIGHTWALK_ARITHMETIC(-)
LIGHTWALK_ARITHMETIC(*)
LIGHTWALK_ARITHMETIC(/)
LIGHTWALK_COMPARISON(<)
LIGHTWALK_COMPARISON(<=)
LIGHTWALK_COMPARISON(>)
LIGHTWALK_COMPARISON(>=)
LIGHTWALK_COMPARISON(==)
#undef LIGHTWALK_ARITHMETIC
#undef LIGHTWALK_COMPARISON

inline Float8 operator-(const Float8& a) {
  return each_part<Float8>([&](int i) { return -a.part[i]; });
}
inline Int8 operator&(const Int8& a, const Int8& b) {
  return each_part<Int8>([&](int i) { return a.part[i] & b.part[i]; });
}

/// In each lane `yes` where the mask is set, and otherwise `no`.
template <class Number, class Part>
Lanes<Number, Part> select(const Int8& mask, const Lanes<Number, Part>& yes,
                           const Lanes<Number, Part>& no) {
  return each_part<Lanes<Number, Part>>(
      [&](int i) { return mask.part[i] ? yes.part[i] : no.part[i]; });
}
/// The smaller of two numbers; neither may be NaN.
inline Float8 min(const Float8& a, const Float8& b) {
  return select(a < b, a, b);
}
inline Float8 max(const Float8& a, const Float8& b) {
  return select(a < b, b, a);
}

/// Eight times the same number.
inline Float8 broadcast(float x) {
  return each_part<Float8>([&](int) { return x + FloatPart{}; });
}
inline Int8 broadcast(std::int32_t x) {
  return each_part<Int8>([&](int) { return x + IntPart{}; });
}
inline Float8 select(const Int8& mask, const Float8& yes, float no) {
  return select(mask, yes, broadcast(no));
}

inline Float8 abs(const Float8& x) {
  return max(x, -x);
}

inline Float8 sqrt(const Float8& x) {
#if defined(LIGHTWALK_VECTORS) && defined(__AVX2__)
  return {{_mm256_sqrt_ps(x.part[0])}};
#elif defined(LIGHTWALK_VECTORS) && defined(__SSE2__)
  return {{_mm_sqrt_ps(x.part[0]), _mm_sqrt_ps(x.part[1])}};
#else
  Float8 root;
  for (int i = 0; i < lane_count; ++i) root[i] = std::sqrt(x[i]);
  return root;
#endif
}

/// The lanes of a mask that are set: lane 0 is bit 0.
inline unsigned lanes_of(const Int8& mask) {
#if defined(LIGHTWALK_VECTORS) && defined(__AVX2__)
  return static_cast<unsigned>(
      _mm256_movemask_ps(reinterpret_cast<__m256>(mask.part[0])));
#elif defined(LIGHTWALK_VECTORS) && defined(__SSE2__)
  return static_cast<unsigned>(
      _mm_movemask_ps(reinterpret_cast<__m128>(mask.part[0])) |
      _mm_movemask_ps(reinterpret_cast<__m128>(mask.part[1])) << 4);
#else
  unsigned lanes = 0;
  for (int i = 0; i < lane_count; ++i)
    lanes |= static_cast<unsigned>(-mask[i]) << i;
  return lanes;
#endif
}

/// Whether a lane of the mask is set.
inline bool any(const Int8& mask) {
  return lanes_of(mask) != 0;
}

/// The smallest of the eight; none may be NaN.
inline float smallest(const Float8& x) {
#if defined(LIGHTWALK_VECTORS) && defined(__SSE2__)
#ifdef __AVX2__
  __m128 least = _mm_min_ps(_mm256_castps256_ps128(x.part[0]),
                            _mm256_extractf128_ps(x.part[0], 1));
#else
  __m128 least = _mm_min_ps(x.part[0], x.part[1]);
#endif
  least = _mm_min_ps(least, _mm_movehl_ps(least, least));
  least = _mm_min_ss(least, _mm_shuffle_ps(least, least, 1));
  return _mm_cvtss_f32(least);
#else
  float least = x[0];
  for (int i = 1; i < lane_count; ++i) least = std::min(least, x[i]);
  return least;
#endif
}

/// Eight vectors, each component in its own row.
struct Vec3x8 {
  Float8 x = broadcast(0.0f), y = broadcast(0.0f), z = broadcast(0.0f);

  Vec3 operator[](int lane) const { return {x[lane], y[lane], z[lane]}; }

  void set(int lane, const Vec3& v) {
    x[lane] = v.x;
    y[lane] = v.y;
    z[lane] = v.z;
  }
};

inline Float8 dot(const Vec3x8& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Float8 dot(const Vec3& a, const Vec3x8& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Float8 dot(const Vec3x8& a, const Vec3x8& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3x8 operator-(const Vec3& a, const Vec3x8& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
/// For each lane a, the vector a * b.
inline Vec3x8 operator*(const Float8& a, const Vec3& b) {
  return {a * b.x, a * b.y, a * b.z};
}
inline Vec3x8 operator+(const Vec3x8& a, const Vec3x8& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

}  // namespace lightwalk
