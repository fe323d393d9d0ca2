// One shape and a ray: a hit lies ahead, on the ray and on the shape. It must
// agree with textbook formulas in double precision, unless rounding decides. A
// ray that leaves the shape must not hit it again where it cannot.

#include "tests/fuzz/geometry.hpp"

using namespace lightwalk;
using namespace lightwalk::fuzz;

namespace {

/// The distance of a point from a shape, to compare with rounding.
double off(const Plane& plane, const Vec3& place) {
  return std::abs(dot(DoubleVec3(plane.normal), DoubleVec3(place)) +
                  static_cast<double>(plane.distance));
}
double off(const Sphere& sphere, const Vec3& place) {
  return std::abs(length(DoubleVec3(place) - DoubleVec3(sphere.center)) -
                  static_cast<double>(sphere.radius));
}
double off(const FlatShape& flat, const Vec3& place) {
  return std::abs(dot(DoubleVec3(flat.normal),
                      DoubleVec3(place) - DoubleVec3(flat.corner)));
}

float size_of(const Plane& plane) {
  return std::abs(plane.distance);
}
float size_of(const Sphere& sphere) {
  return max_abs_component(sphere.center) + sphere.radius;
}
float size_of(const FlatShape& flat) {
  return max_abs_component(flat.corner) + max_abs_component(flat.edge_u) +
         max_abs_component(flat.edge_v);
}

/// The hit by textbook formulas, where rounding cannot matter.
struct Expected {
  bool sure = false;
  double distance = 0;  ///< 0 where the ray misses
};

Expected of_plane(double height, double slope, double size) {
  const double distance = -height / slope;
  if (!(std::abs(slope) > 1e-2) ||
      std::abs(distance) < 1e-3 * (std::abs(height) + size)) {
    return {};
  }
  return {true, std::max(0.0, distance)};
}

Expected expected(const Plane& plane, const Ray& ray) {
  const DoubleVec3 normal(plane.normal), origin(ray.origin);
  const auto d = static_cast<double>(plane.distance);
  return of_plane(dot(normal, origin) + d,
                  dot(normal, DoubleVec3(ray.direction)),
                  length(origin) + std::abs(d));
}

Expected expected(const Sphere& sphere, const Ray& ray) {
  const DoubleVec3 f = DoubleVec3(ray.origin) - DoubleVec3(sphere.center);
  const DoubleVec3 direction(ray.direction);
  const auto r = static_cast<double>(sphere.radius);
  const double b = -dot(f, direction);
  const DoubleVec3 beside = f + b * direction;
  const double square = r * r - dot(beside, beside);
  const double size =
      r + length(f) + static_cast<double>(max_abs_component(ray.origin));
  if (std::abs(square) < 1e-3 * size * size) return {};
  if (square < 0) return {true, 0};
  const double near = b - std::sqrt(square), far = b + std::sqrt(square);
  if (std::min(std::abs(near), std::abs(far)) < 1e-3 * size) return {};
  return {true, near > 0 ? near : std::max(0.0, far)};
}

template <class Flat>
Expected expected(const Flat& flat, const Ray& ray) {
  const DoubleVec3 from = DoubleVec3(ray.origin) - DoubleVec3(flat.corner);
  const DoubleVec3 direction(ray.direction);
  const double slope = dot(DoubleVec3(flat.normal), direction);
  const double size =
      length(from) + static_cast<double>(max_abs_component(ray.origin));
  const Expected met =
      of_plane(dot(DoubleVec3(flat.normal), from), slope, size);
  if (!met.sure || met.distance <= 0) return met;
  const DoubleVec3 x = from + met.distance * direction;
  const double way = 0x1p-18 * (size + met.distance) / std::abs(slope);
  const DoubleVec3 u(flat.dual_u()), v(flat.dual_v());
  const double s = dot(u, x), t = dot(v, x);
  const double doubt = 1e-2 + way * (length(u) + length(v));
  const double inside = std::is_same_v<Flat, Rectangle>
                            ? std::min(std::min(s, 1 - s), std::min(t, 1 - t))
                            : std::min(std::min(s, t), 1 - s - t);
  if (!(std::abs(inside) > doubt)) return {};
  return {true, inside > 0 ? met.distance : 0};
}

/// A ray that leaves the hit: out of the shape or into it.
void check_leaving(const Geometry& geometry, const Hit& hit, Vec3 direction,
                   bool is_sphere, float scene_size) {
  const Ray ray = spawn_ray(hit, direction);
  expect(is_finite(ray.origin), "a leaving ray starts somewhere",
         text(ray.origin));
  const auto again = geometry.nearest_hit(ray);
  const bool inwards = dot(direction, hit.normal) < 0;
  if (!is_sphere || !inwards) {
    expect(!again, "a ray that leaves a shape does not meet it again");
    expect(!geometry.occluded(ray, infinity),
           "a ray that leaves a shape is not in its shadow");
    return;
  }
  // The far side, where the chord ends.
  expect(again.has_value() == (ray.self_hit_distance > 0),
         "a ray into a sphere meets its far side");
  if (again) {
    check_hit(ray, *again, scene_size);
    expect(again->distance <= hit.diameter * 1.0001f,
           "a chord is not longer than the diameter");
  }
}

template <class Shape>
void check(const Shape& shape, Numbers& numbers) {
  Geometry geometry;
  geometry.add(shape);
  while (!numbers.empty()) {
    const Vec3 origin = numbers.vector();
    const Ray ray{origin, numbers.direction()};
    const auto hit = geometry.nearest_hit(ray);
    expect(geometry.occluded(ray, infinity) == hit.has_value(),
           "what is met is in the way");
    if (const Expected right = expected(shape, ray); right.sure) {
      expect(hit.has_value() == (right.distance > 0),
             "a ray meets a shape where it should", text(ray.origin));
      if (hit) {
        const auto distance = static_cast<double>(hit->distance);
        expect(std::abs(distance - right.distance) <= 1e-3 * right.distance,
               "a hit has the right distance",
               std::to_string(distance) + ", not " +
                   std::to_string(right.distance));
      }
    }
    if (!hit) continue;
    check_hit(ray, *hit, size_of(shape));
    expect(!geometry.occluded(ray, hit->distance),
           "nothing is in front of the first hit");
    expect(hit->shape_index == 0 && hit->material == &material,
           "a hit is of the shape");
    const Vec3 there = ray.origin + hit->distance * ray.direction;
    const float size = size_of(shape) + max_abs_component(hit->position) +
                       max_abs_component(there);
    expect(off(shape, hit->position) <= 0x1p-22 * static_cast<double>(size),
           "a hit's place is on the shape",
           text(hit->position) + " is off by " +
               std::to_string(off(shape, hit->position) / 0x1p-22 /
                              static_cast<double>(size)) +
               " roundings, from " + text(ray.origin) + " after " +
               std::to_string(hit->distance));
    constexpr bool is_sphere = std::is_same_v<Shape, Sphere>;
    check_leaving(geometry, *hit, numbers.direction(), is_sphere,
                  size_of(shape));
    check_leaving(geometry, *hit, -ray.direction, is_sphere, size_of(shape));
    check_leaving(geometry, *hit, ray.direction, is_sphere, size_of(shape));
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Numbers numbers(data, size);
  constexpr float scales[] = {1, 1, 1e-3f, 1e3f};
  const float scale = scales[numbers.below(4)];
  switch (numbers.below(4)) {
    case 0:
      check(numbers.plane(), numbers);
      break;
    case 1:
      check(numbers.sphere(scale), numbers);
      break;
    case 2:
      check(numbers.flat<Rectangle>(scale), numbers);
      break;
    default:
      check(numbers.flat<Triangle>(scale), numbers);
  }
  return 0;
}
