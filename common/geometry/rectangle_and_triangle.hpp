#pragma once

// # Rectangles and triangles
//
// Both are a corner $c$ and two edges $u$, $v$: the points $c + s u + t v$,
// with $0 \le s, t \le 1$ for a rectangle and $0 \le s, t$ and $s + t \le 1$
// for a triangle. A ray is first cut with their plane. Then $s$ and $t$ are
// read off with two vectors $a$, $b$ in the plane that were prepared once,
// such that $a \cdot u = b \cdot v = 1$ and $a \cdot v = b \cdot u = 0$:
//
// $$s = a \cdot (x - c), \quad t = b \cdot (x - c)$$
//
// Where two of them share an edge, rounding must not leave a gap: a ray that
// slips into a glass cube without being refracted is wrong from there on. So
// each shape reaches over its edges as far as rounding may have moved $x$:
// half a millionth of its size and of the distance $d$, divided by the cosine
// at which the ray grazes the plane. But it never reaches farther than its
// own length: a ray that is parallel to the plane but for rounding meets the
// plane miles away.
//
// Half a millionth is $2^{-21}$, or eight roundings of $2^{-24}$. With the
// roundings of each dot product (three), difference, quotient, product and
// sum, all to the same side, $s$ is off by $(9d + 8\,|x - c|)\,|a|$ roundings
// over the cosine, if $a$ and the normal are exact. The code allows for
// $8\,(d\,|a| + 1)$. So the eight is chosen, a little below the worst case:
// tests/core/test_watertight.cpp aims at shared edges and finds no gap.

#include "common/geometry/lanes.hpp"
#include "common/geometry/plane.hpp"
#include "common/geometry/ray.hpp"

namespace lightwalk {

/// A flat piece of surface, spanned from `corner` by two edges.
struct FlatShape {
  Vec3 corner, edge_u, edge_v;
  Vec3 normal;  ///< unit, along edge_u x edge_v
  const Material* material;
  const Light* light = nullptr;  ///< the scene's light that it is, if any

  FlatShape(const Vec3& corner_, const Vec3& edge_u_, const Vec3& edge_v_,
            const Material* material_)
      : corner(corner_),
        edge_u(edge_u_),
        edge_v(edge_v_),
        normal(normalize(cross(edge_u_, edge_v_))),
        material(material_) {}

  /// The coordinates (s, t) of a position in the plane.
  Vec2 coordinates(const Vec3& position) const {
    return {dot(dual_u(), position - corner),
            dot(dual_v(), position - corner)};
  }

  Vec3 dual_u() const {
    const Vec3 across = cross(edge_v, normal);
    return across / dot(across, edge_u);
  }
  Vec3 dual_v() const {
    const Vec3 across = cross(normal, edge_u);
    return across / dot(across, edge_v);
  }
};

/// corner + s edge_u + t edge_v with 0 <= s, t <= 1.
struct Rectangle : FlatShape {
  using FlatShape::FlatShape;
};

/// corner + s edge_u + t edge_v with 0 <= s, t and s + t <= 1.
struct Triangle : FlatShape {
  using FlatShape::FlatShape;
};

/// What it takes to intersect rectangles, or triangles: eight with one ray,
/// or one with many.
template <class Shape, class Vector, class Number>
struct FlatForm {
  Vector corner, normal, dual_u, dual_v;
  Number size_u{}, size_v{};  // of the duals

  // #region flat-intersection
  /// Distances along the ray; what is not above 0 or not finite is no hit.
  template <class Rays>
  auto intersect(const Rays& ray) const {
    const auto from_corner = ray.origin - corner;
    const auto slope = dot(normal, ray.direction);
    const auto distance = -dot(normal, from_corner) / slope;
    const auto x = from_corner + distance * ray.direction;
    const auto s = dot(dual_u, x);
    const auto t = dot(dual_v, x);
    const auto cosine = abs(slope);
    const auto over_s = min(0x1p-21f * (1.0f + distance * size_u), cosine);
    const auto over_t = min(0x1p-21f * (1.0f + distance * size_v), cosine);
    auto inside = (s * cosine >= -over_s) & (t * cosine >= -over_t);
    if constexpr (std::is_same_v<Shape, Rectangle>) {
      inside = inside & ((1.0f - s) * cosine >= -over_s) &
               ((1.0f - t) * cosine >= -over_t);
    } else {
      inside = inside & ((1.0f - s - t) * cosine >= -(over_s + over_t));
    }
    return select(inside, distance, infinity);
  }
  // #endregion flat-intersection
};

template <class Shape>
FlatForm<Shape, Vec3, float> form_of_flat(const Shape& flat) {
  const Vec3 dual_u = flat.dual_u(), dual_v = flat.dual_v();
  return {flat.corner, flat.normal,    dual_u,
          dual_v,      length(dual_u), length(dual_v)};
}
inline auto intersector_of(const Rectangle& rectangle) {
  return form_of_flat(rectangle);
}
inline auto intersector_of(const Triangle& triangle) {
  return form_of_flat(triangle);
}

/// Eight rectangles, or eight triangles. A lane that is not set is hit by no
/// ray.
template <class Shape>
struct FlatPack : FlatForm<Shape, Vec3x8, Float8> {
  void set(int lane, const Shape& flat) {
    const auto form = intersector_of(flat);
    this->corner.set(lane, form.corner);
    this->normal.set(lane, form.normal);
    this->dual_u.set(lane, form.dual_u);
    this->dual_v.set(lane, form.dual_v);
    this->size_u[lane] = form.size_u;
    this->size_v[lane] = form.size_v;
  }
};

/// Completes a hit at `hit.position`, which rounding has put near the plane,
/// and moves it back by `back` within the plane.
inline void snap_to_surface(const FlatShape& flat, const Vec3& back,
                            Hit& hit) {
  hit.normal = flat.normal;
  const DoubleVec3 x(hit.position - back), n(flat.normal);
  const double height = dot(n, x - DoubleVec3(flat.corner));
  hit.position = Vec3(project_onto_plane(x, height, n));
  hit.diameter = 0;
}

}  // namespace lightwalk
