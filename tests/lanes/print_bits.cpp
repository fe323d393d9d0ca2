// Prints checksums of the bits of many hits, and of the last two stages'
// pictures. It is compiled for several instruction sets, and all must print the
// same.

#include <cstdint>
#include <cstdio>
#include <cstring>

#include "common/geometry/geometry.hpp"
#include "common/math/random.hpp"
#include "common/render/paint.hpp"
#include "common/scene/material.hpp"
#include "stages/6_many_paths/path_tracer.hpp"

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

/// A few shapes are searched one by one, many in a tree.
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

/// All kinds of shapes, lobes and lights.
void add_box(Scene& scene) {
  const Material* white = scene.add(Material{.kd = Vec3(0.8f)});
  const Material* red = scene.add(Material{.kd = {0.8f, 0.2f, 0.2f}});
  const Material* plastic =
      scene.add(Material{.kd = {0.2f, 0.2f, 0.6f}, .ks = Vec3(0.3f)});
  const Material* glass =
      scene.add(Material{.ks = Vec3(0.1f), .kt = Vec3(0.9f)});
  const Material* crystal =
      scene.add(Material{.ks = Vec3(1), .kt = Vec3(1), .fresnel = true});
  const Material* lamp = scene.add(Material{.ke = {10, 9, 8}});
  scene.camera.width = scene.camera.height = 48;
  scene.add(Plane{{1, 0, 0}, 1, red});
  scene.add(Plane{{-1, 0, 0}, 1, white});
  scene.add(Plane{{0, 1, 0}, 1, white});
  scene.add(Plane{{0, -1, 0}, 1, white});
  scene.add(Plane{{0, 0, -1}, 1, white});
  scene.add(Sphere{{-0.5f, -0.7f, 0.25f}, 0.3f, plastic});
  scene.add(Sphere{{0.5f, -0.7f, -0.25f}, 0.3f, glass});
  scene.add(Sphere{{0, 0.1f, 0.3f}, 0.2f, crystal});
  scene.add(Triangle{{-1, -0.5f, 1}, {2, 0, 0}, {0, 1, 0}, plastic});
  scene.add(
      Rectangle{{-0.3f, 0.95f, -0.1f}, {0.6f, 0, 0}, {0, 0, 0.6f}, lamp});
  scene.add(PointLight{{0.3f, 0.5f, 0}, Vec3(0.2f)});
}

template <class PathTracer>
void print_picture(int stage) {
  Scene scene;
  add_box(scene);
  const RenderResult picture =
      paint<PathTracer>(scene, {.samples_per_pixel = 8});
  Checksum checksum;
  for (const Vec3& pixel : picture.radiance.pixels) checksum.add(pixel);
  std::printf("stage %d: %016llx\n", stage,
              static_cast<unsigned long long>(checksum.value));
}

}  // namespace

int main() {
  print_hits(5);
  print_hits(2000);
  print_picture<stage5::PathTracer>(5);
  print_picture<stage6::PathTracer>(6);
}
