// Rectangles and triangles: corner + s edge_u + t edge_v.

#include <doctest/doctest.h>

#include "common/geometry/geometry.hpp"
#include "common/scene/material.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

const Material material;

/// Looks at (s, t) of the shape from `away` in front of it.
template <class Shape>
std::optional<Hit> look_at(const Shape& shape, float s, float t,
                           float away = 0.5f) {
  Geometry geometry;
  geometry.add(shape);
  const Vec3 target = shape.corner + s * shape.edge_u + t * shape.edge_v;
  return geometry.nearest_hit({target + away * shape.normal, -shape.normal});
}

/// Edges that are not perpendicular, nor of equal length, nor along axes.
template <class Shape>
Shape slanted() {
  return Shape({3, -1, 2}, {1, 0.5f, 0.25f}, {-0.5f, 2, 1}, &material);
}

}  // namespace

TEST_CASE("a rectangle is hit at its distance, with its own normal") {
  // u x v = (2, 0, 0) x (0, 0, 3) = (0, -6, 0): it faces down.
  const Rectangle ceiling({-1, 4, -1}, {2, 0, 0}, {0, 0, 3}, &material);
  Geometry geometry;
  geometry.add(ceiling);
  const auto below = geometry.nearest_hit({{0.5f, 1, 0}, {0, 1, 0}});
  REQUIRE(below);
  CHECK(below->distance == 3);
  CHECK(below->position == Vec3(0.5f, 4, 0));
  CHECK(below->normal == Vec3(0, -1, 0));
  CHECK(below->shape_type == ShapeType::rectangle);
  CHECK(below->material == &material);

  const auto above = geometry.nearest_hit({{0.5f, 6, 0}, {0, -1, 0}});
  REQUIRE(above);
  CHECK(above->normal == Vec3(0, -1, 0));
}

TEST_CASE("a triangle is hit at its distance, with its own normal") {
  const Triangle triangle({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, &material);
  Geometry geometry;
  geometry.add(triangle);
  const auto hit = geometry.nearest_hit({{0.25f, 0.25f, 3}, {0, 0, -1}});
  REQUIRE(hit);
  CHECK(hit->distance == 2);
  CHECK(hit->position == Vec3(0.25f, 0.25f, 1));
  CHECK(hit->normal == Vec3(0, 0, 1));
  CHECK(hit->shape_type == ShapeType::triangle);
}

TEST_CASE("a rectangle is hit in its corners and on its edges, not beyond") {
  const auto shape = slanted<Rectangle>();
  for (const float s : {0.0f, 0.001f, 0.5f, 0.999f, 1.0f}) {
    for (const float t : {0.0f, 0.001f, 0.5f, 0.999f, 1.0f}) {
      CAPTURE(s);
      CAPTURE(t);
      CHECK(look_at(shape, s, t));
    }
  }
  for (const float across : {0.0f, 0.5f, 1.0f}) {
    for (const float beyond : {-3.0f, -0.001f, 1.001f, 4.0f}) {
      CAPTURE(across);
      CAPTURE(beyond);
      CHECK_FALSE(look_at(shape, beyond, across));
      CHECK_FALSE(look_at(shape, across, beyond));
      CHECK_FALSE(look_at(shape, beyond, beyond));
    }
  }
}

TEST_CASE("a triangle is hit in its corners and on its edges, not beyond") {
  const auto shape = slanted<Triangle>();
  for (const float s : {0.0f, 0.001f, 0.25f, 0.5f, 0.75f, 0.999f, 1.0f}) {
    for (const float share : {0.0f, 0.001f, 0.5f, 0.999f, 1.0f}) {
      CAPTURE(s);
      CAPTURE(share);
      CHECK(look_at(shape, s, share * (1 - s)));
    }
    CAPTURE(s);
    CHECK_FALSE(look_at(shape, s, 1.001f - s));
    CHECK_FALSE(look_at(shape, s, -0.001f));
    CHECK_FALSE(look_at(shape, -0.001f, s));
  }
  CHECK_FALSE(look_at(shape, 0.9f, 0.9f));
  CHECK_FALSE(look_at(shape, 1.001f, 0));
  CHECK_FALSE(look_at(shape, 0, 1.001f));
  CHECK_FALSE(look_at(shape, 2, -1.5f));
}

TEST_CASE("a position's coordinates are the s and t that it was made from") {
  const auto shape = slanted<Rectangle>();
  for (const float s : {-1.0f, 0.0f, 0.3f, 1.0f}) {
    for (const float t : {-1.0f, 0.0f, 0.7f, 1.0f}) {
      const Vec2 found = shape.coordinates(shape.corner + s * shape.edge_u +
                                           t * shape.edge_v);
      CAPTURE(s);
      CAPTURE(t);
      CHECK(std::abs(found.x - s) <= 2e-6f);
      CHECK(std::abs(found.y - t) <= 2e-6f);
    }
  }
}

TEST_CASE("rays behind, beside and within a flat shape do not hit it") {
  Geometry geometry;
  geometry.add(Rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, &material));
  geometry.add(Triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, &material));
  CHECK_FALSE(geometry.nearest_hit({{0.2f, 0.2f, 1}, {0, 0, 1}}));
  CHECK_FALSE(geometry.nearest_hit({{0.2f, 0.2f, -1}, {0, 0, -1}}));
  CHECK_FALSE(geometry.nearest_hit({{-1, 0.2f, 1}, {1, 0, 0}}));
  CHECK_FALSE(geometry.nearest_hit({{-1, 0.2f, 0}, {1, 0, 0}}));
  CHECK_FALSE(geometry.nearest_hit({{0.2f, 0.2f, 0}, {0, -1, 0}}));
  CHECK_FALSE(geometry.nearest_hit({{0, 0, 0}, {0.6f, 0.8f, 0}}));
}

// The tolerance at the edges is proportional to them and to the ray's length,
// so a needle of 1e-4 beside an edge of 1e4 keeps its shape.
TEST_CASE("long, thin and tiny flat shapes have sharp edges too") {
  struct Size {
    float u, v;
  };
  for (const Size size : {Size{1e4f, 1e-4f},
                          {1e-4f, 1e4f},
                          {1e-4f, 1e-4f},
                          {1e4f, 1e4f},
                          {1e-9f, 1e-9f}}) {
    CAPTURE(size.u);
    CAPTURE(size.v);
    const Rectangle shape({0, 0, 0}, {size.u, 0, 0}, {0, size.v, 0},
                          &material);
    const float away = std::min(size.u, size.v);
    CHECK(look_at(shape, 0.999f, 0.001f, away));
    CHECK_FALSE(look_at(shape, 1.001f, 0.5f, away));
    CHECK_FALSE(look_at(shape, 0.5f, 1.001f, away));
    const Triangle half({0, 0, 0}, {size.u, 0, 0}, {0, size.v, 0}, &material);
    CHECK(look_at(half, 0.5f, 0.499f, away));
    CHECK_FALSE(look_at(half, 0.5f, 0.501f, away));
  }
}

TEST_CASE("hits of a slanted flat shape lie on it") {
  Random random(1, 0, 0);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Rectangle shape{random_position(random, 10),
                          random_position(random, 2),
                          random_position(random, 2), &material};
    const Vec3 target = shape.corner + random.uniform() * shape.edge_u +
                        random.uniform() * shape.edge_v;
    const Vec3 origin = random_position(random, 10);
    Geometry geometry;
    geometry.add(shape);
    const auto hit =
        geometry.nearest_hit({origin, normalize(target - origin)});
    if (!hit) continue;
    ++hits;
    INFO("corner " << text(shape.corner) << ", u " << text(shape.edge_u)
                   << ", v " << text(shape.edge_v));
    CHECK(std::abs(dot(shape.normal, hit->position - shape.corner)) <=
          4 * hit->rounding);
  }
  CHECK(hits > 1990);
}
