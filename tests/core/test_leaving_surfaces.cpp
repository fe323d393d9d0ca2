// A ray that leaves a surface must not hit it again at once, wherever the
// surface is and however large, and must not start so far off that it misses
// what touches the surface.
//
// A shape of 1 mm at 10 km cannot be described by floats. So shapes are
// tested where 2^-16 of their distance is at most a tenth of their size.

#include <doctest/doctest.h>

#include <cmath>

#include "common/geometry/geometry.hpp"
#include "common/math/basis.hpp"
#include "common/scene/material.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

const Material material;

template <class Test>
void for_each_size_and_place(Test test) {
  Random random(1, 0, 0);
  for (float size = 1e-3f; size < 2e4f; size *= 10) {
    for (const float away : {0.0f, 0.1f, 1.0f, 10.0f, 100.0f, 1e3f, 1e4f}) {
      if (0x1p-16f * away > 0.1f * size) continue;
      INFO("size " << size << ", at a distance of " << away);
      test(size, away * random_direction(random), random);
    }
  }
}

/// Above the surface with this normal; a third of them nearly within it.
Vec3 direction_above(const Vec3& normal, Random& random) {
  for (;;) {
    Vec3 direction = random_direction(random);
    if (random.uniform() < 0.33f) {
      const float height = std::pow(10.0f, -7 * random.uniform());
      direction -= dot(direction, normal) * normal;
      direction = normalize(normalize(direction) + height * normal);
    }
    if (dot(direction, normal) < 0) direction = -direction;
    if (dot(direction, normal) > 0) return direction;
  }
}

/// How many of some rays that leave the hit come back to the geometry.
int returning(const Geometry& geometry, const Hit& hit, const Vec3& side,
              Random& random) {
  int count = 0;
  for (int i = 0; i < 20; ++i) {
    const Vec3 direction = direction_above(side, random);
    count += geometry.nearest_hit(spawn_ray(hit, direction)).has_value();
  }
  return count;
}

/// Hits the only, flat shape from both sides at random points.
void check_flat(const Geometry& geometry, const FlatShape& flat, float size,
                bool triangle, Random& random) {
  int hits = 0, again = 0;
  for (int i = 0; i < 100; ++i) {
    Vec2 u = random.uniform_2d();
    if (triangle && u.x + u.y > 1) u = 1.0f - u;
    const Vec3 target = flat.corner + u.x * flat.edge_u + u.y * flat.edge_v;
    const Vec3 origin = target + 3 * size * random_direction(random);
    const auto hit =
        geometry.nearest_hit({origin, normalize(target - origin)});
    if (!hit) continue;
    ++hits;
    again += returning(geometry, *hit, hit->normal, random);
    again += returning(geometry, *hit, -hit->normal, random);
  }
  CHECK(hits > 90);
  CHECK(again == 0);
}

}  // namespace

TEST_CASE("no ray that leaves a plane meets it again") {
  for_each_size_and_place([](float size, const Vec3& place, Random& random) {
    const Vec3 normal = random_direction(random);
    Geometry geometry;
    geometry.add(Plane{normal, -dot(normal, place), &material});
    int hits = 0, again = 0;
    for (int i = 0; i < 100; ++i) {
      const Vec3 origin = place + random_position(random, size);
      const auto hit =
          geometry.nearest_hit({origin, random_direction(random)});
      if (!hit) continue;
      ++hits;
      again += returning(geometry, *hit, hit->normal, random);
      again += returning(geometry, *hit, -hit->normal, random);
    }
    CHECK(hits > 20);
    CHECK(again == 0);
  });
}

TEST_CASE("no ray that leaves a rectangle meets it again") {
  for_each_size_and_place([](float size, const Vec3& place, Random& random) {
    const Rectangle shape{place, size * random_direction(random),
                          size * random_direction(random), &material};
    Geometry geometry;
    geometry.add(shape);
    check_flat(geometry, shape, size, false, random);
  });
}

TEST_CASE("no ray that leaves a triangle meets it again") {
  for_each_size_and_place([](float size, const Vec3& place, Random& random) {
    const Triangle shape{place, size * random_direction(random),
                         size * random_direction(random), &material};
    Geometry geometry;
    geometry.add(shape);
    check_flat(geometry, shape, size, true, random);
  });
}

TEST_CASE("no ray that leaves a sphere outwards meets it again") {
  for_each_size_and_place([](float size, const Vec3& place, Random& random) {
    Geometry geometry;
    geometry.add(Sphere{place, size, &material});
    int hits = 0, again = 0;
    for (int i = 0; i < 100; ++i) {
      const Vec3 origin = place + 4 * size * random_direction(random);
      const Vec3 target = place + 0.7f * size * random_direction(random);
      const auto hit =
          geometry.nearest_hit({origin, normalize(target - origin)});
      if (!hit) continue;
      ++hits;
      again += returning(geometry, *hit, hit->normal, random);
    }
    CHECK(hits > 90);
    CHECK(again == 0);
  });
}

// The chord from a point of the sphere at an angle whose cosine to the inward
// normal is c is 2 r c long.
TEST_CASE("a ray that leaves a sphere inwards meets its far side") {
  for_each_size_and_place([](float size, const Vec3& place, Random& random) {
    Geometry geometry;
    geometry.add(Sphere{place, size, &material});
    const double r = static_cast<double>(size);
    int missed = 0, wrong = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 origin = place + random_position(random, 0.5f * size);
      const auto hit =
          geometry.nearest_hit({origin, random_direction(random)});
      REQUIRE(hit);
      const Vec3 direction = direction_above(-hit->normal, random);
      const auto far = geometry.nearest_hit(spawn_ray(*hit, direction));
      missed += !far;
      if (!far) continue;
      const double c = -static_cast<double>(dot(hit->normal, direction));
      const double expected = 2 * r * c;
      const double error =
          std::abs(static_cast<double>(far->distance) - expected);
      wrong += !(error < 0x1p-20 * r);
    }
    CHECK(missed == 0);
    CHECK(wrong == 0);
  });
}

// Rounding may move a hit by a few units in the last of its 24 bits.
TEST_CASE("a ray starts within a few roundings of its surface") {
  for_each_size_and_place([](float size, const Vec3& place, Random& random) {
    Geometry shapes;
    shapes.add(Sphere{place, size, &material});
    shapes.add(Plane{{0, 1, 0}, 3 * size - place.y, &material});
    shapes.add(Rectangle{place + 2 * size, Vec3(size, 0, 0), Vec3(0, 0, size),
                         &material});
    for (int i = 0; i < 100; ++i) {
      const Vec3 origin = place + 5 * size * random_direction(random);
      const Vec3 target = place + random_position(random, 2 * size);
      const auto hit =
          shapes.nearest_hit({origin, normalize(target - origin)});
      if (!hit) continue;
      const float offset = length(leave(*hit, hit->normal) - hit->position);
      const float far = length(hit->position) + length(place);
      REQUIRE(offset <= 0x1p-20f * (10 * size + far));
    }
  });
}

// A ball of radius r on the floor is d^2 / 2r above it at a distance d from
// the point where it stands: at r/1000 that is r/2,000,000. A floor that is a
// ball itself, of the size of a hill or of a moon, is practically flat.
TEST_CASE("no light leaks under a ball that stands on the floor") {
  constexpr float r = 0.3f;
  for (const float floor_radius : {0.0f, 1e3f, 1e5f}) {
    const auto add_floor = [&](Geometry& geometry) {
      if (floor_radius == 0) {
        geometry.add(Plane{{0, 1, 0}, 1, &material});
      } else {
        geometry.add(Sphere{
            {-0.5f, -1 - floor_radius, 0.25f}, floor_radius, &material});
      }
    };
    // Each by itself gives the hit; then the other must block the ray.
    const Sphere standing{{-0.5f, -1 + r, 0.25f}, r, &material};
    Geometry floor, ball, both;
    add_floor(floor);
    ball.add(standing);
    add_floor(both);
    both.add(standing);
    // Each geometry has its own slots.
    const auto on_top = both.nearest_hit({{-0.5f, 1, 0.25f}, {0, -1, 0}});
    REQUIRE(on_top);
    const std::int32_t ball_slot = on_top->slot;
    for (const float share : {0.001f, 0.01f, 0.02f, 0.05f, 0.2f, 0.9f}) {
      for (int i = 0; i < 16; ++i) {
        const float phi = two_pi * static_cast<float>(i) / 16;
        const Vec3 point = Vec3(-0.5f, -1, 0.25f) +
                           share * r * Vec3(std::cos(phi), 0, std::sin(phi));
        const Vec3 above = point + Vec3(0, 0.5f, 0);
        CAPTURE(floor_radius);
        CAPTURE(share);
        CAPTURE(phi);
        const auto hit = floor.nearest_hit({above, {0, -1, 0}});
        REQUIRE(hit);
        CHECK(both.occluded(spawn_ray(*hit, {0, 1, 0}), 5));

        // And in reverse: from the ball down to the floor.
        auto under = ball.nearest_hit({point - Vec3(0, 0.5f, 0), {0, 1, 0}});
        REQUIRE(under);
        under->slot = ball_slot;
        CHECK(both.occluded(spawn_ray(*under, {0, -1, 0}), 0.5f));
      }
    }
  }
}

// The ray goes 1 to the side and 1 down; the exact answer is in doubles.
TEST_CASE("a huge ball is hit where it is, not where its center rounds to") {
  Random random(1, 0, 0);
  for (const float radius : {1e2f, 1e3f, 1e4f, 1e5f}) {
    Geometry geometry;
    const Sphere ball{{0, -radius - 1, 0}, radius, &material};
    geometry.add(ball);
    double worst = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vec3 origin = random_position(random, 0.5f);
      const Vec3 direction =
          normalize(Vec3(random_position(random, 1)) - Vec3(0, 2, 0));
      const auto hit = geometry.nearest_hit({origin, direction});
      REQUIRE(hit);
      const DoubleVec3 f = DoubleVec3(origin) - DoubleVec3(ball.center);
      const DoubleVec3 d = glm::normalize(DoubleVec3(direction));
      const double b = -glm::dot(f, d), r = static_cast<double>(radius);
      const double exact = (glm::dot(f, f) - r * r) /
                           (b + std::sqrt(r * r - (glm::dot(f, f) - b * b)));
      worst = std::max(worst,
                       std::abs(static_cast<double>(hit->distance) - exact));
    }
    CAPTURE(radius);
    CHECK(worst < 1e-6);
  }
}

TEST_CASE("the normal toward a direction is on the direction's side") {
  Hit hit{};
  hit.normal = {0, 1, 0};
  CHECK(normal_towards(hit, {0.6f, 0.8f, 0}) == Vec3(0, 1, 0));
  CHECK(normal_towards(hit, {0.6f, -0.8f, 0}) == Vec3(0, -1, 0));
}
