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
// slips into a glass cube without being refracted is never right again. So
// each reaches over its edges as far as rounding may have moved $x$: a few
// millionths of its size and of the way there, divided by the cosine at which
// the ray grazes the plane. But never farther than its own length: a ray that
// is parallel to the plane but for rounding meets it miles away.

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

/// What it takes to intersect eight rectangles, or eight triangles. A lane
/// that is not set is hit by no ray.
template <class Shape>
struct FlatPack {
  Vec3x8 corner, normal, dual_u, dual_v;
  Float8 size_u{}, size_v{};  // of the duals

  // #region flat-intersection
  /// Distances along the ray; what is not above 0 or not finite is no hit.
  Float8 intersect(const Ray& ray) const {
    const Vec3x8 from_corner = ray.origin - corner;
    const Float8 slope = dot(normal, ray.direction);
    const Float8 distance = -dot(normal, from_corner) / slope;
    const Vec3x8 x = from_corner + scale(distance, ray.direction);
    const Float8 s = dot(dual_u, x);
    const Float8 t = dot(dual_v, x);
    const Float8 cosine = abs(slope);
    const Float8 over_s = min(0x1p-21f * (1.0f + distance * size_u), cosine);
    const Float8 over_t = min(0x1p-21f * (1.0f + distance * size_v), cosine);
    Int8 inside = (s * cosine >= -over_s) & (t * cosine >= -over_t);
    if constexpr (std::is_same_v<Shape, Rectangle>) {
      inside = inside & ((1.0f - s) * cosine >= -over_s) &
               ((1.0f - t) * cosine >= -over_t);
    } else {
      inside = inside & ((1.0f - s - t) * cosine >= -(over_s + over_t));
    }
    return select(inside, distance, broadcast(infinity));
  }
  // #endregion flat-intersection

  void set(int lane, const FlatShape& flat) {
    corner.set(lane, flat.corner);
    normal.set(lane, flat.normal);
    dual_u.set(lane, flat.dual_u());
    dual_v.set(lane, flat.dual_v());
    size_u[lane] = length(flat.dual_u());
    size_v[lane] = length(flat.dual_v());
  }
};

/// Completes a hit at `hit.position`, which rounding has put near the plane,
/// and moves it back by `back` within the plane.
inline void place_hit(const FlatShape& flat, const Vec3& back, Hit& hit) {
  hit.normal = flat.normal;
  const DoubleVec3 x(hit.position - back);
  const double height =
      dot(DoubleVec3(flat.normal), x - DoubleVec3(flat.corner));
  hit.position = point_below(x, height, flat.normal);
  hit.diameter = 0;
}

}  // namespace lightwalk
