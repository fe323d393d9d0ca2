#pragma once

// Makes shapes and rays from any bytes. Numbers are like those of scenes: whole
// numbers and fractions, so that edges touch and rays hit corners, times a
// scale.

#include <fuzzer/FuzzedDataProvider.h>

#include "common/geometry/geometry.hpp"
#include "common/scene/material.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace lightwalk::fuzz {

inline const Material material;

/// Reads numbers, vectors and shapes; zeros after the end of the bytes.
class Numbers {
 public:
  Numbers(const std::uint8_t* data, std::size_t size) : bytes_(data, size) {}

  bool empty() { return bytes_.remaining_bytes() == 0; }
  int below(int limit) { return bytes_.ConsumeIntegralInRange(0, limit - 1); }

  /// From -128 to 128: a whole number, quarters, or any fraction.
  float number() {
    switch (below(4)) {
      case 0:
        return bytes_.ConsumeIntegral<std::int8_t>();
      case 1:
        return 0.25f *
               static_cast<float>(bytes_.ConsumeIntegral<std::int8_t>());
      default:
        return 0x1p-8f *
               static_cast<float>(bytes_.ConsumeIntegral<std::int16_t>());
    }
  }
  Vec3 vector() {
    const float x = number(), y = number(), z = number();
    return {x, y, z};
  }
  /// A unit vector, also along an axis.
  Vec3 direction() {
    const Vec3 v = vector();
    return v == Vec3(0) ? Vec3(0, 0, 1) : normalize(v);
  }

  Plane plane() {
    const Vec3 normal = direction();
    return {normal, number(), &material};
  }
  Sphere sphere(float scale = 1) {
    const Vec3 center = vector();
    const float radius = scale * std::abs(number());
    return {scale * center, radius > 0 ? radius : scale, &material};
  }
  /// Two edges that span an area; those of a scene may be flatter.
  template <class Flat>
  Flat flat(float scale = 1) {
    const Vec3 corner = vector(), u = vector();
    Vec3 v = vector();
    if (u == Vec3(0) ||
        !(length(cross(u, v)) > 1e-3f * length(u) * length(v))) {
      return Flat(scale * corner, Vec3(scale, 0, 0), Vec3(0, scale, 0),
                  &material);
    }
    return Flat(scale * corner, scale * u, scale * v, &material);
  }

 private:
  FuzzedDataProvider bytes_;
};

/// Checks what holds for every hit in a scene whose coordinates are at most
/// `scene_size`: a position is rounded like its largest coordinate.
inline void check_hit(const Ray& ray, const Hit& hit, float scene_size) {
  expect(hit.distance > 0 && hit.distance < infinity,
         "a hit's distance is above 0 and finite",
         std::to_string(hit.distance));
  expect(is_finite(hit.position), "a hit has a place", text(hit.position));
  expect(std::abs(length(hit.normal) - 1) < 1e-5f,
         "a normal is a unit vector", text(hit.normal));
  const Vec3 there = ray.origin + hit.distance * ray.direction;
  const float size =
      std::max(max_abs_component(ray.origin), max_abs_component(there));
  expect(length(hit.position - there) <=
             1e-4f * (size + hit.distance) + 0x1p-20f * scene_size,
         "a hit's place is on the ray", text(hit.position));
}

}  // namespace lightwalk::fuzz
