// One shape and a ray: a hit lies ahead, on the ray and on the shape, and a
// ray that leaves the shape does not meet it again where it cannot.

#include "tests/fuzz/geometry.hpp"

using namespace lightwalk;
using namespace lightwalk::fuzz;

namespace {

/// How far a place is off a shape, to be measured by rounding.
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

/// A ray that leaves the hit: out of the shape or into it.
void check_leaving(const Geometry& geometry, const Hit& hit, Vec3 direction,
                   bool is_sphere) {
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
  expect(again.has_value() == (ray.again > 0),
         "a ray into a sphere meets its far side");
  if (again) {
    check_hit(ray, *again);
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
    if (!hit) continue;
    check_hit(ray, *hit);
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
    check_leaving(geometry, *hit, numbers.direction(), is_sphere);
    check_leaving(geometry, *hit, -ray.direction, is_sphere);
    check_leaving(geometry, *hit, ray.direction, is_sphere);
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
