// Planes and spheres, one at a time.

#include <doctest/doctest.h>

#include "common/geometry/geometry.hpp"
#include "common/scene/material.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

const Material material;

template <class Shape>
std::optional<Hit> meet(const Shape& shape, const Vec3& origin,
                        const Vec3& direction) {
  Geometry geometry;
  geometry.add(shape);
  return geometry.nearest_hit({origin, normalize(direction)});
}

}  // namespace

// n = (1, 0, 0) with d = 1 is the wall at x = -1: n . x + d = 0.
TEST_CASE("a plane lies at minus its distance along its normal") {
  const Plane wall{{1, 0, 0}, 1, &material};
  const auto hit = meet(wall, {2, 5, 7}, {-1, 0, 0});
  REQUIRE(hit);
  CHECK(hit->distance == 3);
  CHECK(hit->position == Vec3(-1, 5, 7));
  CHECK(hit->normal == Vec3(1, 0, 0));
  CHECK(hit->material == &material);
  CHECK(hit->shape_type == ShapeType::plane);
  CHECK(hit->shape_index == 0);
}

TEST_CASE("a plane's normal is its own, from whichever side it is hit") {
  const Plane wall{{1, 0, 0}, 1, &material};
  const auto hit = meet(wall, {-5, 0, 0}, {1, 0, 0});
  REQUIRE(hit);
  CHECK(hit->distance == 4);
  CHECK(hit->normal == Vec3(1, 0, 0));
}

// From height 3 at 45 degrees the distance is 3 sqrt(2), and 3 sideways.
TEST_CASE("a plane is hit at an angle where it should be") {
  const Plane floor{{0, 1, 0}, -2, &material};  // at y = 2
  const auto hit = meet(floor, {1, 5, -1}, {1, -1, 0});
  REQUIRE(hit);
  CHECK(hit->distance == doctest::Approx(3 * std::sqrt(2.0)));
  CHECK(hit->position == Near{{4, 2, -1}, 2e-6f});
  CHECK(hit->position.y == 2);
}

TEST_CASE("a plane behind the ray, beside it or around it is not hit") {
  const Plane floor{{0, 1, 0}, 1, &material};  // at y = -1
  CHECK_FALSE(meet(floor, {0, 0, 0}, {0, 1, 0}));
  CHECK_FALSE(meet(floor, {0, 0, 0}, {1, 1e-6f, 0}));
  CHECK_FALSE(meet(floor, {0, 0, 0}, {1, 0, 0}));
  CHECK_FALSE(meet(floor, {0, -1, 0}, {1, 0, 0}));
  CHECK_FALSE(meet(floor, {0, -1, 0}, {-0.6f, 0, 0.8f}));
  CHECK_FALSE(meet(floor, {0, -1, 0}, {0, -1, 0}));
}

TEST_CASE("hits of a slanted plane lie on it") {
  Random random(1, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const Plane plane{random_direction(random), 3 * random.uniform(),
                      &material};
    const Vec3 origin = random_position(random, 10);
    const auto hit = meet(plane, origin, random_direction(random));
    if (!hit) continue;
    const float off = dot(plane.normal, hit->position) + plane.distance;
    INFO("plane " << text(plane.normal) << " " << plane.distance);
    CHECK(std::abs(off) <= 4 * hit->rounding);
  }
}

TEST_CASE("hits of a plane at the origin, where floats are fine, lie on it") {
  Random random(1, 0, 0);
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    const Plane plane{random_direction(random), 0, &material};
    const Vec3 origin = random_position(random, 100);
    const auto hit = meet(plane, origin, normalize(-origin));
    if (!hit) continue;
    ++hits;
    const double off =
        dot(DoubleVec3(plane.normal), DoubleVec3(hit->position));
    INFO("normal " << text(plane.normal) << ", ray from " << text(origin)
                   << ", hit at " << text(hit->position));
    CHECK(std::abs(off) <= static_cast<double>(hit->rounding));
  }
  CHECK(hits > 900);
}

TEST_CASE("a sphere is hit on its near side from outside") {
  const Sphere ball{{1, 2, 3}, 2, &material};
  const auto hit = meet(ball, {1, 2, -7}, {0, 0, 1});
  REQUIRE(hit);
  CHECK(hit->distance == 8);
  CHECK(hit->position == Vec3(1, 2, 1));
  CHECK(hit->normal == Vec3(0, 0, -1));
  CHECK(hit->shape_type == ShapeType::sphere);
}

// Beside the center by 1.2 of 2, the ray enters sqrt(4 - 1.44) = 1.6 before
// it is level with the center.
TEST_CASE("a sphere is hit beside its center where Pythagoras says") {
  const Sphere ball{{0, 0, 0}, 2, &material};
  const auto hit = meet(ball, {1.2f, 0, -5}, {0, 0, 1});
  REQUIRE(hit);
  CHECK(hit->distance == doctest::Approx(5 - 1.6));
  CHECK(hit->position == Near{{1.2f, 0, -1.6f}, 1e-6f});
  CHECK(hit->normal == Near{{0.6f, 0, -0.8f}, 1e-6f});
}

TEST_CASE("a sphere is hit on its far side from inside, normal outwards") {
  const Sphere ball{{0, 0, 0}, 2, &material};
  for (const Vec3 origin : {Vec3(0), Vec3(0, 0, 1.5f), Vec3(0, 0, -1.5f)}) {
    const auto hit = meet(ball, origin, {0, 0, 1});
    INFO("from " << text(origin));
    REQUIRE(hit);
    CHECK(hit->distance == doctest::Approx(2 - origin.z));
    CHECK(hit->position == Near{{0, 0, 2}, 1e-6f});
    CHECK(hit->normal == Near{{0, 0, 1}, 1e-6f});
  }
}

TEST_CASE("a sphere behind the ray or beside it is not hit") {
  const Sphere ball{{0, 0, 0}, 1, &material};
  CHECK_FALSE(meet(ball, {0, 0, 2}, {0, 0, 1}));
  CHECK_FALSE(meet(ball, {0, 0, -5}, {0, 1, 0}));
  CHECK_FALSE(meet(ball, {0, 1.001f, -5}, {0, 0, 1}));
  CHECK_FALSE(meet(ball, {0, -1.001f, -5}, {0, 0, 1}));
}

// A thousandth of the radius from the rim, sqrt(1 - .999^2) = .0447.
TEST_CASE("a sphere is still hit close to its rim") {
  const Sphere ball{{0, 0, 0}, 1, &material};
  for (const float y : {0.999f, -0.999f}) {
    const auto hit = meet(ball, {0, y, -5}, {0, 0, 1});
    REQUIRE(hit);
    CHECK(hit->distance == doctest::Approx(5 - 0.0447102).epsilon(1e-5));
  }
}

// b^2 - c would lose 10^8 of the sphere's 1 at this distance: all digits.
TEST_CASE("a small sphere far away is hit where it is") {
  const Sphere ball{{0, 0, 0}, 1, &material};
  const auto hit = meet(ball, {0.6f, 0, -10000}, {0, 0, 1});
  REQUIRE(hit);
  CHECK(hit->distance == doctest::Approx(9999.2).epsilon(1e-6));
  CHECK(std::abs(length(hit->position) - 1) <= 1e-6f);
}

TEST_CASE("a sphere too small to be told from its center has a unit normal") {
  for (const float radius : {1e-6f, 1e-9f, 1e-20f, 1e-30f, 1e-40f}) {
    const auto hit =
        meet(Sphere{{0, 0, 0}, radius, &material}, {0, 0, -1}, {0, 0, 1});
    if (!hit) continue;
    CAPTURE(radius);
    CHECK(std::abs(length(hit->normal) - 1) <= 1e-6f);
    CHECK(hit->position == Near{{0, 0, 0}, 1.001e-6f});
  }
}

TEST_CASE("the nearest shape is hit, in whatever order they were added") {
  const Sphere near{{0, 0, 3}, 1, &material}, far{{0, 0, 9}, 1, &material};
  const Plane between{{0, 0, -1}, 6, &material};  // at z = 6
  const Rectangle nearest({-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, &material);
  Geometry geometry;
  CHECK_FALSE(geometry.nearest_hit({{0, 0, 0}, {0, 0, 1}}));
  const auto distance = [&](const Vec3& origin) {
    return geometry.nearest_hit({origin, {0, 0, 1}})->distance;
  };
  geometry.add(far);
  CHECK(distance({0, 0, 0}) == 8);
  geometry.add(between);
  CHECK(distance({0, 0, 0}) == 6);
  geometry.add(near);
  CHECK(distance({0, 0, 0}) == 2);
  geometry.add(nearest);
  CHECK(distance({0, 0, 0}) == 1);
  CHECK(distance({0, 0, 1.5f}) == 0.5f);
  CHECK(distance({0, 0, 2.5f}) == 1.5f);
  CHECK(distance({0, 0, 5}) == 1);
  CHECK(distance({0, 0, 7}) == 1);
  CHECK_FALSE(geometry.nearest_hit({{0, 0, 11}, {0, 0, 1}}));
  CHECK(geometry.size() == 4);
}
