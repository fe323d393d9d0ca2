// Rays of paths that take turns meet what one ray meets by itself.

#include <doctest/doctest.h>

#include <cstring>
#include <vector>

#include "common/geometry/geometry.hpp"
#include "common/scene/material.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

const Material material;

void put(RayPacket& packet, int path, const Ray& ray) {
  packet.rows[static_cast<std::size_t>(path / lane_count)].put(
      path % lane_count, ray);
}
FirstShape first(const RayPacket& packet, int path) {
  return packet.rows[static_cast<std::size_t>(path / lane_count)].first(
      path % lane_count);
}

/// `count` shapes of each type but planes, of which there are two.
Geometry mixed_shapes(int count) {
  Geometry geometry;
  Random random(7, 0, 0);
  geometry.add(Plane{{0, 1, 0}, 3, &material});
  geometry.add(Plane{{1, 0, 0}, 3, &material});
  for (int i = 0; i < count; ++i) {
    const Vec3 place = random_position(random, 2);
    const Vec3 u = random_position(random, 1);
    const Vec3 v = random_position(random, 1);
    geometry.add(Sphere{place, 0.5f, &material});
    geometry.add(Rectangle{place + u, u, v, &material});
    geometry.add(Triangle{place - v, u, v, &material});
  }
  geometry.prepare();
  return geometry;
}

Ray random_ray(Random& random) {
  const Vec3 origin = random_position(random, 3);
  const Vec3 direction = random_direction(random);
  return {origin, direction};
}

bool same_bits(const Vec3& a, const Vec3& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}
bool same_hit(const std::optional<Hit>& a, const std::optional<Hit>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->distance == b->distance && same_bits(a->position, b->position) &&
         same_bits(a->normal, b->normal) && a->shape_type == b->shape_type &&
         a->shape_index == b->shape_index;
}

}  // namespace

TEST_CASE("a packet of rays meets what each of its rays meets") {
  // The distance to the last bit; and 11 shapes need two packs.
  const Geometry geometry = mixed_shapes(11);
  Random random(1, 0, 0);
  for (int round = 0; round < 200; ++round) {
    RayPacket packet;
    std::vector<Ray> rays;
    for (int path = 0; path < RayPacket::size; ++path) {
      rays.push_back(random_ray(random));
      put(packet, path, rays.back());
    }
    geometry.meet(packet);
    for (int path = 0; path < RayPacket::size; ++path) {
      const std::optional<Hit> hit =
          geometry.nearest_hit(rays[static_cast<std::size_t>(path)]);
      CAPTURE(path);
      REQUIRE(first(packet, path).distance ==
              (hit ? hit->distance : infinity));
    }
  }
}

TEST_CASE("of two shapes at the same place, the first is met") {
  // Ten planes in one: the first is in lane 0 of pack 0, the ninth in lane 0
  // of pack 1, and there are two spheres around the same center.
  Geometry planes, spheres;
  for (int i = 0; i < 10; ++i) planes.add(Plane{{0, 0, -1}, 1, &material});
  for (int i = 0; i < 10; ++i) spheres.add(Sphere{{0, 0, 3}, 1, &material});
  for (const Geometry* geometry : {&planes, &spheres}) {
    const Ray ray{{0, 0, 0}, {0, 0, 1}};
    CHECK(geometry->nearest_hit(ray)->shape_index == 0);
    RayPacket packet;
    for (int path = 0; path < RayPacket::size; ++path) put(packet, path, ray);
    geometry->meet(packet);
    for (int path = 0; path < RayPacket::size; ++path) {
      CHECK(first(packet, path).place == 0);
    }
  }
}

TEST_CASE("paths that take turns see what a path alone sees") {
  // Each takes rays from the queue, one or more at a time, so that they end
  // at different times.
  for (const int count : {3, 11, 200}) {
    const Geometry geometry = mixed_shapes(count);
    std::vector<Ray> rays;
    Random random(2, 0, 0);
    for (int i = 0; i < 3000; ++i) rays.push_back(random_ray(random));
    std::vector<std::optional<Hit>> hits(rays.size());
    std::vector<char> visible(rays.size());
    const auto ask = [&](std::size_t i) {
      hits[i] = geometry.nearest_hit(rays[i]);
      visible[i] = geometry.visible(rays[i].origin, rays[i].direction);
    };
    std::size_t next = 0;
    const std::uint64_t before = rays_cast;
    geometry.follow_paths([&] {
      while (next < rays.size()) {
        const std::size_t first = next;
        next = std::min(rays.size(), first + 1 + first % 7);
        for (std::size_t i = first, end = next; i < end; ++i) ask(i);
      }
    });
    CHECK(rays_cast - before == 2 * rays.size());

    const std::vector<std::optional<Hit>> hits_in_turns = hits;
    const std::vector<char> visible_in_turns = visible;
    int different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      ask(i);
      different += !same_hit(hits[i], hits_in_turns[i]) ||
                   visible[i] != visible_in_turns[i];
    }
    CAPTURE(count);
    CHECK(different == 0);
  }
}

TEST_CASE("a path may take no rays, or many more than the others") {
  const Geometry geometry = mixed_shapes(3);
  int starts = 0, rays = 0;
  geometry.follow_paths([&] {
    const int path = starts++;
    for (int i = 0; path == 5 && i < 1000; ++i) {
      rays += geometry.nearest_hit({{0, 0, 0}, {0, -1, 0}}).has_value();
    }
  });
  if (starts > 5) CHECK(rays == 1000);
  int again = 0;
  geometry.follow_paths([&] { ++again; });
  CHECK(again == starts);
}

// Path tracers may be written as functions that call themselves.
TEST_CASE("a path has room for deep recursion") {
  const Geometry geometry = mixed_shapes(3);
  struct Recursion {
    const Geometry& geometry;
    float sum(int depth) const {
      volatile float numbers[32] = {};  // what a bounce has to remember
      if (depth == 0) return 0;
      const auto hit = geometry.nearest_hit({{0, 0, 0}, {0, -1, 0}});
      numbers[depth % 32] = hit->distance;
      return sum(depth - 1) + numbers[depth % 32];
    }
  };
  geometry.follow_paths([&] { CHECK(Recursion{geometry}.sum(1000) > 0); });
}
