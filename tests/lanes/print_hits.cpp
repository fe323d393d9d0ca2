// Prints a checksum of the bits of many hits. It is compiled for several
// instruction sets, and all must print the same.

#include <cstdint>
#include <cstdio>
#include <cstring>

#include "common/geometry/geometry.hpp"
#include "common/math/random.hpp"
#include "common/scene/material.hpp"

namespace {

using namespace lightwalk;

struct Checksum {
  std::uint64_t value = 14695981039346656037u;

  void add(float x) {
    std::uint32_t bits;
    std::memcpy(&bits, &x, sizeof bits);
    value = (value ^ bits) * 1099511628211u;
  }
  void add(const Vec3& v) {
    add(v.x);
    add(v.y);
    add(v.z);
  }
};

Vec3 position(Random& random, float reach) {
  const Vec2 xy = random.uniform_2d();
  const float z = random.uniform();
  return reach * (2.0f * Vec3(xy.x, xy.y, z) - 1.0f);
}

/// Few shapes are searched one by one, many in a tree.
void print_hits(int count) {
  const Material material;
  Geometry geometry;
  Random random(1, static_cast<std::uint64_t>(count), 0);
  geometry.add(Plane{{0, 1, 0}, 3, &material});
  geometry.add(Plane{{1, 0, 0}, 3, &material});
  const float size = 3 / std::cbrt(static_cast<float>(count));
  for (int i = 0; i < count; ++i) {
    const Vec3 place = position(random, 3);
    const Vec3 u = position(random, size);
    const Vec3 v = position(random, size);
    geometry.add(Sphere{place, 0.5f * size, &material});
    geometry.add(Rectangle{place + u, u, v, &material});
    geometry.add(Triangle{place - v, u, v, &material});
  }
  geometry.prepare();
  Checksum checksum;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 from = position(random, 3);
    const Vec3 to = position(random, 3);
    const Ray ray{from, normalize(to - from)};
    const auto hit = geometry.nearest_hit(ray);
    const bool occluded = geometry.occluded(ray, length(to - from));
    checksum.add(occluded ? 0.0f : 1.0f);
    if (!hit) continue;
    checksum.add(hit->distance);
    checksum.add(hit->position);
    checksum.add(hit->normal);
    checksum.add(static_cast<float>(hit->shape_index));
  }
  std::printf("%d of each: %016llx\n", count,
              static_cast<unsigned long long>(checksum.value));
}

}  // namespace

int main() {
  print_hits(5);
  print_hits(2000);
}
