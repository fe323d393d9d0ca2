// A tree of boxes finds the same hits as testing every shape.

#include <doctest/doctest.h>

#include "common/geometry/geometry.hpp"
#include "common/scene/material.hpp"
#include "tests/core/twins.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

const Material material;

/// 10,000 random rays must get the same answers, to the bit. Where two shapes
/// are hit at the same distance either may be the answer.
void check_same_answers(Twins& twins, float reach, std::uint64_t seed) {
  twins.prepared.prepare();
  Random random(seed, 0, 0);
  int hits = 0, blocked = 0, differences = 0;
  for (int i = 0; i < 10000; ++i) {
    const Vec3 from = random_position(random, reach);
    const Vec3 to = random_position(random, reach);
    if (from == to) continue;
    const Ray ray{from, normalize(to - from)};
    const auto a = twins.plain.nearest_hit(ray);
    const auto b = twins.prepared.nearest_hit(ray);
    hits += a.has_value();
    if (a.has_value() != b.has_value()) {
      ++differences;
    } else if (a && a->distance != b->distance) {
      ++differences;
    }
    const bool seen = visible(twins.plain, from, to);
    blocked += !seen;
    differences += seen != visible(twins.prepared, from, to);
  }
  CHECK(differences == 0);
  // Both answers occurred.
  CHECK(hits > 100);
  CHECK(hits < 10000);
  CHECK(blocked > 100);
  CHECK(blocked < 10000);
}

void add_random_shapes(Twins& twins, int count, float reach, float size,
                       std::uint64_t seed) {
  Random random(seed, 1, 0);
  for (int i = 0; i < count; ++i) {
    const Vec3 place = random_position(random, reach);
    const Vec3 u = random_position(random, size);
    const Vec3 v = random_position(random, size);
    const float radius = size * (0.1f + random.uniform());
    twins.add(Sphere{place, radius, &material});
    if (length(cross(u, v)) < 1e-3f * size * size) continue;
    twins.add(Rectangle{random_position(random, reach), u, v, &material});
    twins.add(Triangle{random_position(random, reach), u, v, &material});
  }
}

}  // namespace

TEST_CASE("a tree of boxes gives the hits of a search one by one") {
  for (const int count : {64, 300, 2000}) {
    CAPTURE(count);
    Twins twins;
    const float size = 2 / std::cbrt(static_cast<float>(count));
    add_random_shapes(twins, count, 5, size, 7);
    twins.add(Plane{{0, 1, 0}, 6, &material});
    check_same_answers(twins, 6, 8);
  }
}

TEST_CASE("a tree of boxes holds the huge and the tiny") {
  Twins twins;
  for (const float size : {1e-3f, 1.0f, 1e3f}) {
    add_random_shapes(twins, 100, 10 * size, size, 9);
  }
  check_same_answers(twins, 20, 10);
}

TEST_CASE("a tree of boxes holds shapes that are all in one place") {
  Twins twins;
  for (int i = 0; i < 500; ++i) {
    twins.add(Sphere{{1, 2, 3}, 1, &material});
    twins.add(Rectangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, &material});
  }
  check_same_answers(twins, 4, 11);
}

TEST_CASE("a tree of boxes holds shapes in one plane") {
  Twins twins;
  for (int i = 0; i < 30; ++i) {
    for (int j = 0; j < 30; ++j) {
      const Vec3 corner(static_cast<float>(i - 15), -1,
                        static_cast<float>(j - 15));
      twins.add(Rectangle{corner, {0, 0, 1}, {1, 0, 0}, &material});
      twins.add(
          Triangle{corner - Vec3(0, 1, 0), {0, 0, 1}, {1, 0, 0}, &material});
    }
  }
  check_same_answers(twins, 15, 12);
}

TEST_CASE("a tree of boxes is right for rays along the axes") {
  Twins twins;
  add_random_shapes(twins, 500, 5, 0.5f, 13);
  twins.prepared.prepare();
  Random random(14, 0, 0);
  for (int i = 0; i < 3000; ++i) {
    // Zeros of both signs.
    Ray ray{random_position(random, 6), Vec3(i % 4 < 2 ? 0.0f : -0.0f)};
    ray.direction[i % 3] = i % 2 == 0 ? 1.0f : -1.0f;
    const auto a = twins.plain.nearest_hit(ray);
    const auto b = twins.prepared.nearest_hit(ray);
    REQUIRE(a.has_value() == b.has_value());
    if (a) REQUIRE(a->distance == b->distance);
  }
}

TEST_CASE("shapes that are added to a tree of boxes are hit too") {
  Twins twins;
  add_random_shapes(twins, 200, 5, 0.5f, 15);
  twins.prepared.prepare();
  add_random_shapes(twins, 100, 5, 0.5f, 16);
  const Ray ray{{0, 0, -50}, {0, 0, 1}};
  twins.add(Sphere{{0, 0, -40}, 1, &material});
  CHECK(twins.prepared.nearest_hit(ray)->distance == 9);
  check_same_answers(twins, 6, 17);
}
