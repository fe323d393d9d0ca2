#include <doctest/doctest.h>

#include "common/geometry/geometry.hpp"
#include "common/scene/material.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

const Material material;

/// One blocker of each type, all at z = 0 and across the z axis.
std::vector<Geometry> blockers() {
  std::vector<Geometry> result(4);
  result[0].add(Plane{{0, 0, 1}, 0, &material});
  result[1].add(Sphere{{0, 0, 0}, 0.5f, &material});
  result[2].add(Rectangle({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, &material));
  result[3].add(Triangle({-1, -1, 0}, {4, 0, 0}, {0, 4, 0}, &material));
  return result;
}

}  // namespace

TEST_CASE("in an empty scene everything sees everything") {
  CHECK(visible(Geometry(), {0, 0, 0}, {1, 2, 3}));
}

TEST_CASE("what lies between two points hides them from each other") {
  for (const Geometry& geometry : blockers()) {
    CHECK_FALSE(visible(geometry, {0, 0, -2}, {0, 0, 2}));
    CHECK_FALSE(visible(geometry, {0, 0, 2}, {0, 0, -2}));
    CHECK_FALSE(visible(geometry, {0.2f, 0.1f, 3}, {-0.1f, 0.1f, -1}));
  }
}

// Without the bound, the wall behind a lamp would darken the room.
TEST_CASE("what lies beyond the end does not hide it") {
  for (const Geometry& geometry : blockers()) {
    CHECK(visible(geometry, {0, 0, -5}, {0, 0, -1}));
    CHECK(visible(geometry, {0, 0, 5}, {0, 0, 1}));
    CHECK(visible(geometry, {0, 0, -5}, {0, 0, -0.51f}));
  }
}

TEST_CASE("what lies before the start does not hide the end") {
  for (const Geometry& geometry : blockers()) {
    CHECK(visible(geometry, {0, 0, 1}, {0, 0, 5}));
    CHECK(visible(geometry, {0, 0, -1}, {0, 0, -5}));
  }
}

TEST_CASE("what lies beside the ray does not hide the end") {
  const auto geometries = blockers();
  for (std::size_t i = 1; i < geometries.size(); ++i) {  // not the plane
    CAPTURE(i);
    CHECK(visible(geometries[i], {-3, 0, -2}, {-3, 0, 2}));
    CHECK(visible(geometries[i], {0, -1.1f, -2}, {0, -1.1f, 2}));
  }
  CHECK(visible(geometries[2], {1.1f, 1.1f, -2}, {1.1f, 1.1f, 2}));
  CHECK(visible(geometries[3], {2, 2, -2}, {2, 2, 2}));
}

TEST_CASE("a sphere hides what is inside it from outside, not from inside") {
  Geometry geometry;
  geometry.add(Sphere{{0, 0, 0}, 1, &material});
  CHECK_FALSE(visible(geometry, {0, 0, 0}, {0, 0, 2}));
  CHECK_FALSE(visible(geometry, {0, 0, 2}, {0, 0, 0}));
  CHECK(visible(geometry, {0, 0, -0.9f}, {0, 0.9f, 0}));
}

TEST_CASE("the last blocker of many counts as much as the first") {
  for (int count = 1; count <= 20; ++count) {
    Geometry geometry;
    for (int i = 1; i < count; ++i) {
      const float height = 3 * static_cast<float>(i);
      geometry.add(Sphere{{0, height, 0}, 1, &material});
    }
    CAPTURE(count);
    CHECK(visible(geometry, {0, 0, -2}, {0, 0, 2}));
    geometry.add(Sphere{{0, 0, 0}, 1, &material});
    CHECK_FALSE(visible(geometry, {0, 0, -2}, {0, 0, 2}));
  }
}

// Both answers come from the same packs: a point is visible when the nearest
// hit toward it lies beyond it. Where they are within rounding, either is
// right.
TEST_CASE("visible agrees with the nearest hit, in both directions") {
  Random random(1, 0, 0);
  Geometry geometry;
  for (int i = 0; i < 12; ++i) {
    geometry.add(Sphere{random_position(random, 2), 0.5f, &material});
    geometry.add(Rectangle{random_position(random, 2),
                           random_position(random, 1),
                           random_position(random, 1), &material});
    geometry.add(Triangle{random_position(random, 2),
                          random_position(random, 1),
                          random_position(random, 1), &material});
  }
  geometry.add(Plane{normalize(Vec3(1, 2, -3)), 1.5f, &material});
  geometry.add(Sphere{{0, -1e5f - 2, 0}, 1e5f, &material});
  int hidden = 0, one_way = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 from = random_position(random, 3);
    const Vec3 to = random_position(random, 3);
    const float distance = length(to - from);
    const bool seen = visible(geometry, from, to);
    hidden += !seen;
    one_way += seen != visible(geometry, to, from);
    const auto hit = geometry.nearest_hit({from, (to - from) / distance});
    if (hit && std::abs(hit->distance - distance) < 1e-5f) continue;
    INFO("from " << text(from) << " to " << text(to));
    CHECK(seen == !(hit && hit->distance < distance));
  }
  CHECK(hidden > 1000);
  CHECK(hidden < 4500);
  CHECK(one_way <= 2);  // of 5000: rays through an edge, to rounding
}
