// Shapes that are hard for a tree of boxes: around one center, all in one
// place, or each far from all others.

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "common/geometry/geometry.hpp"
#include "common/scene/material.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

const Material material;

Sphere sphere(const Vec3& center, float radius) {
  return {center, radius, &material};
}

/// The levels of a tree in which each node has an eighth of its parent's
/// shapes, and where eight are a pack.
int even_levels(std::size_t shapes) {
  int levels = 1;
  while ((shapes = (shapes + 7) / 8) > 8) ++levels;
  return levels;
}

std::vector<Sphere> random_spheres(int count) {
  Random random(1, 0, 0);
  std::vector<Sphere> spheres;
  for (int i = 0; i < count; ++i) {
    spheres.push_back(sphere(random_position(random, 9), random.uniform()));
  }
  return spheres;
}

}  // namespace

TEST_CASE("a tree that is always cut in halves has the fewest levels") {
  for (const int count : {64, 100, 513, 4096, 5000}) {
    std::vector<std::uint32_t> order;
    const auto spheres = random_spheres(count);
    const BoundingVolumeHierarchy tree(spheres, order, 0);
    CAPTURE(count);
    CHECK(tree.levels() == even_levels(spheres.size()));
  }
}

TEST_CASE("a tree of shapes in one place has the fewest levels") {
  const std::vector<Sphere> same(5000, sphere({1, 2, 3}, 1));
  std::vector<std::uint32_t> order;
  const BoundingVolumeHierarchy tree(same, order);
  CHECK(tree.levels() == even_levels(same.size()));
}

// Each sphere is 17 times as far away as the previous one, so each cut takes
// one away. Those in the middle cannot be cut at all.
TEST_CASE("the most badly cut tree still fits the traversal stack") {
  std::vector<Sphere> spheres(600, sphere(Vec3(0), 1e-9f));
  for (int axis = 0; axis < 3; ++axis) {
    float distance = 1e-8f;
    for (; distance < 1e9f; distance *= 17) {
      for (const float side : {-1.0f, 1.0f}) {
        Vec3 center(0);
        center[axis] = side * distance;
        spheres.push_back(sphere(center, 0.4f * distance));
      }
    }
  }
  std::vector<std::uint32_t> order;
  const BoundingVolumeHierarchy tree(spheres, order);
  const int lowest = even_levels(spheres.size());
  CHECK(tree.levels() > 2 * lowest);
  CHECK(tree.levels() <= BoundingVolumeHierarchy::max_levels);

  Geometry plain, prepared;
  for (const Sphere& one : spheres) {
    plain.add(one);
    prepared.add(one);
  }
  prepared.prepare();
  Random random(3, 0, 0);
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const float far = std::pow(10.0f, 16 * random.uniform() - 7);
    const Vec3 from = random_position(random, far);
    const Ray ray{from,
                  normalize(random_position(random, 0.3f * far) - from)};
    const auto a = plain.nearest_hit(ray), b = prepared.nearest_hit(ray);
    REQUIRE(a.has_value() == b.has_value());
    if (a) CHECK(a->distance == b->distance);
    hits += a.has_value();
  }
  CHECK(hits > 100);
}

// From outside, a ray hits the outermost shell first, at 3. Only boxes that it
// enters before may hold a nearer hit; the boxes of spheres smaller than
// 1 / sqrt(3) of the outermost lie within it. With careless cuts, all boxes
// would hold large spheres.
TEST_CASE("of concentric shells the inner ones are not tested") {
  std::vector<Sphere> shells;
  for (int i = 0; i < 8000; ++i) {
    shells.push_back(
        sphere(Vec3(0), static_cast<float>(1 + i * 3001 % 8000) / 8000));
  }
  std::vector<std::uint32_t> order;
  const BoundingVolumeHierarchy tree(shells, order);
  const std::size_t packs = order.size() / lane_count;
  Random random(5, 0, 0);
  for (int i = 0; i < 100; ++i) {
    const Vec3 out = normalize(random_position(random, 1));
    std::size_t tried = 0;
    tree.walk({4.0f * out, -out}, 3, [&](std::uint32_t) {
      ++tried;
      return 3.0f;
    });
    CHECK(tried > 0);
    CHECK(tried < packs / 2);
  }
}
