// Compares eight lanes at once with one shape after another in double
// precision.

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "common/geometry/geometry.hpp"
#include "common/scene/material.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

const Material material;
constexpr double no_hit = std::numeric_limits<double>::infinity();

using Double3 = std::array<double, 3>;

Double3 exact(const Vec3& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y),
          static_cast<double>(v.z)};
}
double dot(const Double3& a, const Double3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Double3 cross(const Double3& a, const Double3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
          a[0] * b[1] - a[1] * b[0]};
}
Double3 operator-(const Double3& a, const Double3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

struct Meeting {
  double distance = no_hit;
  double cosine = 1;    ///< |cos| between ray and normal
  bool certain = true;  ///< not so near an edge that rounding decides
  ShapeType type = ShapeType::plane;
  std::uint32_t index = 0;
};

/// A hit closer than this to an edge, a rim or the ray's start is uncertain.
constexpr double doubt = 1e-4;

Meeting meet(const Plane& plane, const Double3& o, const Double3& w) {
  Meeting result;
  const Double3 n = exact(plane.normal);
  const double t =
      -(dot(n, o) + static_cast<double>(plane.distance)) / dot(n, w);
  result.certain = std::abs(t) > doubt;
  result.cosine = std::abs(dot(n, w));
  if (t > 0) result.distance = t;
  return result;
}

Meeting meet(const Sphere& sphere, const Double3& o, const Double3& w) {
  Meeting result;
  const Double3 f = o - exact(sphere.center);
  const double r = static_cast<double>(sphere.radius), b = dot(f, w);
  const double a = dot(w, w);  // 1, to a float's rounding
  const double discriminant = b * b - a * (dot(f, f) - r * r);
  result.certain = std::abs(discriminant) > doubt;
  if (discriminant < 0) return result;
  const double root = std::sqrt(discriminant);
  for (const double t : {(-b - root) / a, (-b + root) / a}) {
    result.certain = result.certain && std::abs(t) > doubt;
    if (t > 0 && result.distance == no_hit) result.distance = t;
  }
  result.cosine = root / r;
  return result;
}

/// Cramer's rule for o + t w = c + s u + q v.
Meeting meet(const FlatShape& flat, bool triangle, const Double3& o,
             const Double3& w) {
  Meeting result;
  const Double3 u = exact(flat.edge_u), v = exact(flat.edge_v);
  const Double3 f = o - exact(flat.corner), n = cross(u, v);
  const double determinant = -dot(n, w);
  const double t = dot(n, f) / determinant;
  const double s = -dot(cross(f, v), w) / determinant;
  const double q = -dot(cross(u, f), w) / determinant;
  const double third = triangle ? 1 - s - q : std::min(1 - s, 1 - q);
  const double inside = std::min(std::min(s, q), third);
  result.cosine = std::abs(determinant) / std::sqrt(dot(n, n));
  result.certain = std::abs(t) > doubt && std::abs(inside) > doubt;
  if (inside > 0 && t > 0) result.distance = t;
  return result;
}

struct Reference {
  Meeting nearest;
  std::vector<Meeting> all;
  bool certain = true;

  void consider(Meeting meeting, ShapeType type, std::size_t index) {
    meeting.type = type;
    meeting.index = static_cast<std::uint32_t>(index);
    certain = certain && meeting.certain;
    if (meeting.distance == no_hit) return;
    all.push_back(meeting);
    if (meeting.distance < nearest.distance) nearest = meeting;
  }
};

Reference one_by_one(const Geometry& geometry, const Ray& ray) {
  Reference result;
  const Double3 o = exact(ray.origin), w = exact(ray.direction);
  for (std::size_t i = 0; i < geometry.planes().size(); ++i) {
    result.consider(meet(geometry.planes()[i], o, w), ShapeType::plane, i);
  }
  for (std::size_t i = 0; i < geometry.spheres().size(); ++i) {
    result.consider(meet(geometry.spheres()[i], o, w), ShapeType::sphere, i);
  }
  for (std::size_t i = 0; i < geometry.rectangles().size(); ++i) {
    result.consider(meet(geometry.rectangles()[i], false, o, w),
                    ShapeType::rectangle, i);
  }
  for (std::size_t i = 0; i < geometry.triangles().size(); ++i) {
    result.consider(meet(geometry.triangles()[i], true, o, w),
                    ShapeType::triangle, i);
  }
  return result;
}

/// Adds a shape of a random type within some ten units of the origin.
void add_random_shape(Geometry& geometry, Random& random) {
  const float type = random.uniform();
  const Vec3 position = random_position(random, 5);
  if (type < 0.1f) {
    geometry.add(
        Plane{random_direction(random), 5 + 3 * random.uniform(), &material});
  } else if (type < 0.4f) {
    geometry.add(Sphere{position, 0.2f + random.uniform(), &material});
  } else if (type < 0.7f) {
    geometry.add(Rectangle{position, random_position(random, 3),
                           random_position(random, 3), &material});
  } else {
    geometry.add(Triangle{position, random_position(random, 4),
                          random_position(random, 4), &material});
  }
}

// Distances come from sums of a few products of numbers up to about 20, each
// rounded to 24 bits, divided by the cosine: within 2^-24 * 20 * 10 / cos.
// Two surfaces closer together than that may be hit in either order.
void check_ray(const Geometry& geometry, const Reference& reference,
               const Ray& ray) {
  const std::optional<Hit> hit = geometry.nearest_hit(ray);
  const Meeting& nearest = reference.nearest;
  INFO("ray " << text(ray.origin) << " " << text(ray.direction)
              << ", reference type " << static_cast<int>(nearest.type)
              << " number " << nearest.index << " of " << geometry.size());
  REQUIRE(hit.has_value() == (nearest.distance < no_hit));
  if (!hit) return;
  const double error =
      std::abs(static_cast<double>(hit->distance) - nearest.distance);
  const double tolerance = 200 * 0x1p-24 / std::max(nearest.cosine, 1e-3);
  CHECK(error <= tolerance * std::max(1.0, nearest.distance / 20));
  bool same_or_as_near = false;
  for (const Meeting& meeting : reference.all) {
    same_or_as_near |= meeting.type == hit->shape_type &&
                       meeting.index == hit->shape_index &&
                       meeting.distance - nearest.distance <= 2 * tolerance;
  }
  CAPTURE(static_cast<int>(hit->shape_type));
  CAPTURE(hit->shape_index);
  CHECK(same_or_as_near);
}

}  // namespace

// From one shape to five packs of eight, of mixed types.
TEST_CASE("the nearest hit is that of testing shapes one by one") {
  int certain = 0, hits = 0;
  for (int count = 1; count <= 40; ++count) {
    Random random(1, 0, static_cast<std::uint64_t>(count));
    Geometry geometry;
    for (int i = 0; i < count; ++i) add_random_shape(geometry, random);
    REQUIRE(geometry.size() == static_cast<std::size_t>(count));
    for (int i = 0; i < 250; ++i) {
      const Ray ray{random_position(random, 5), random_direction(random)};
      const Reference reference = one_by_one(geometry, ray);
      if (!reference.certain) continue;
      ++certain;
      hits += reference.nearest.distance < no_hit;
      check_ray(geometry, reference, ray);
    }
  }
  CHECK(certain > 9700);  // of 10000
  CHECK(hits > 6000);
}

// A row of balls along x, each seen from straight above: lanes 0 to 7 of each
// pack in turn, and the last pack partly empty.
TEST_CASE("every lane of every pack is hit, and reported under its number") {
  for (const std::uint32_t count : {1u, 7u, 8u, 9u, 16u, 17u, 23u}) {
    Geometry geometry;
    std::vector<Material> materials(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      geometry.add(
          Sphere{{static_cast<float>(i), 0, 0}, 0.25f, &materials[i]});
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto hit =
          geometry.nearest_hit({{static_cast<float>(i), 2, 0}, {0, -1, 0}});
      CAPTURE(count);
      CAPTURE(i);
      REQUIRE(hit);
      CHECK(hit->shape_index == i);
      CHECK(hit->material == &materials[i]);
      CHECK(hit->distance == 1.75f);
    }
  }
}

// One shape of each type leaves seven lanes empty in each pack, which hold
// zeros: at the origin, where a ray might find them.
TEST_CASE("lanes without a shape are hit by no ray") {
  Geometry geometry;
  geometry.add(Plane{{0, 1, 0}, 1000, &material});
  geometry.add(Sphere{{0, -900, 0}, 1, &material});
  geometry.add(Rectangle({0, -900, 0}, {1, 0, 0}, {0, 0, 1}, &material));
  geometry.add(Triangle({0, -900, 0}, {1, 0, 0}, {0, 0, 1}, &material));
  Random random(1, 0, 0);
  for (int i = 0; i < 2000; ++i) {
    Vec3 direction = random_direction(random);
    direction.y = std::abs(direction.y);
    const Vec3 origin = i % 2 ? random_position(random, 2) : Vec3(0);
    const Vec3 target = i % 4 < 2 ? direction : origin + direction;
    INFO("from " << text(origin) << " to " << text(target));
    CHECK_FALSE(geometry.nearest_hit({origin, direction}));
    CHECK(visible(geometry, origin, target));
    if (i % 2) {
      const Vec3 up{0, 1, 0};
      CHECK_FALSE(geometry.nearest_hit({{origin.x, 0, origin.z}, up}));
      CHECK(visible(geometry, origin, Vec3(0)));  // through the zeros
    }
  }
}
