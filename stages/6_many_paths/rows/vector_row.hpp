#pragma once

// # A vector for each path

#include "common/math/basis.hpp"
#include "common/math/sine_cosine.hpp"
#include "stages/6_many_paths/rows/row.hpp"

#ifdef LIGHTWALK_ROWS

namespace lightwalk {

/// Two numbers in each lane.
struct Vec2s {
  Floats x, y;
};

/// A vector in each lane, of rows of `Number`.
template <class Number>
struct VectorRow {
  using Numbers = Row<Number>;
  using One = glm::vec<3, Number>;
  Numbers x, y, z;

  VectorRow() = default;
  HWY_INLINE VectorRow(const Numbers& x_, const Numbers& y_,
                       const Numbers& z_)
      : x(x_), y(y_), z(z_) {}
  /// The same vector in all lanes.
  HWY_INLINE VectorRow(const One& all) : x(all.x), y(all.y), z(all.z) {}

  /// The vector in one lane.
  One operator[](int lane) const { return {x[lane], y[lane], z[lane]}; }
  void set(int lane, const One& v) {
    x.set(lane, v.x);
    y.set(lane, v.y);
    z.set(lane, v.z);
  }

  friend HWY_INLINE VectorRow operator+(const VectorRow& a,
                                        const VectorRow& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend HWY_INLINE VectorRow operator-(const VectorRow& a,
                                        const VectorRow& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend HWY_INLINE VectorRow operator*(const VectorRow& a,
                                        const VectorRow& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
  }
  friend HWY_INLINE VectorRow operator*(const Numbers& a,
                                        const VectorRow& b) {
    return {a * b.x, a * b.y, a * b.z};
  }
  friend HWY_INLINE VectorRow operator*(const VectorRow& a,
                                        const Numbers& b) {
    return {a.x * b, a.y * b, a.z * b};
  }
  friend HWY_INLINE VectorRow operator/(const VectorRow& a,
                                        const Numbers& b) {
    return {a.x / b, a.y / b, a.z / b};
  }
  friend HWY_INLINE VectorRow operator-(const VectorRow& a) {
    return {-a.x, -a.y, -a.z};
  }
  friend HWY_INLINE Numbers dot(const VectorRow& a, const VectorRow& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  friend HWY_INLINE VectorRow normalize(const VectorRow& v) {
    return v * (Number{1} / sqrt(dot(v, v)));
  }
  friend HWY_INLINE VectorRow select(const typename Numbers::RowMask& mask,
                                     const VectorRow& yes,
                                     const VectorRow& no) {
    return {select(mask, yes.x, no.x), select(mask, yes.y, no.y),
            select(mask, yes.z, no.z)};
  }
};
using Vec3s = VectorRow<float>;
using DoubleVec3s = VectorRow<double>;

HWY_INLINE DoubleVec3s to_double(const Vec3s& v) {
  return {to_double(v.x), to_double(v.y), to_double(v.z)};
}
HWY_INLINE Vec3s to_float(const DoubleVec3s& v) {
  return {to_float(v.x), to_float(v.y), to_float(v.z)};
}

HWY_INLINE Floats max_component(const Vec3s& v) {
  return max(v.x, max(v.y, v.z));
}
HWY_INLINE Floats max_abs_component(const Vec3s& v) {
  return max(abs(v.x), max(abs(v.y), abs(v.z)));
}
HWY_INLINE Mask is_black(const Vec3s& color) {
  return (color.x == 0.0f) & (color.y == 0.0f) & (color.z == 0.0f);
}

// The formulas are those of single numbers.
HWY_INLINE Floats sin(const Floats& radians) {
  return sine(radians);
}
HWY_INLINE Floats cos(const Floats& radians) {
  return cosine(radians);
}
using Bases = BasisOf<Vec3s>;

}  // namespace lightwalk

#endif
