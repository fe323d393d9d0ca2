// Shapes that share an edge leave no gap. One ray in a million that slips
// between two faces of a glass cube is a white dot in the picture.

#include <doctest/doctest.h>

#include <array>

#include "common/geometry/geometry.hpp"
#include "common/math/basis.hpp"
#include "common/scene/material.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

const Material material;

/// A cube with half its edge along three perpendicular axes.
struct Cube {
  Vec3 center;
  std::array<Vec3, 3> axes;

  Vec3 point(float x, float y, float z) const {
    return center + x * axes[0] + y * axes[1] + z * axes[2];
  }
};

Cube random_cube(Random& random, float half, const Vec3& center) {
  const Basis frame(random_direction(random));
  return {
      center,
      {half * frame.tangent, half * frame.bitangent, half * frame.normal}};
}

/// The four corners of face (axis, side), around it.
std::array<Vec3, 4> face(const Cube& cube, std::size_t axis, float side) {
  const auto corner = [&](float u, float v) {
    std::array<float, 3> at{};
    at[axis] = side;
    at[(axis + 1) % 3] = u;
    at[(axis + 2) % 3] = v;
    return cube.point(at[0], at[1], at[2]);
  };
  return {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
}

template <class AddFace>
Geometry closed(const Cube& cube, AddFace add_face) {
  Geometry geometry;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      add_face(geometry, face(cube, axis, side));
    }
  }
  return geometry;
}

Geometry of_rectangles(const Cube& cube) {
  return closed(cube, [](Geometry& geometry, const std::array<Vec3, 4>& p) {
    geometry.add(Rectangle(p[0], p[1] - p[0], p[3] - p[0], &material));
  });
}

/// Two triangles a face, whose corners are the same floats.
Geometry of_triangles(const Cube& cube) {
  return closed(cube, [](Geometry& geometry, const std::array<Vec3, 4>& p) {
    geometry.add(Triangle(p[0], p[1] - p[0], p[2] - p[0], &material));
    geometry.add(Triangle(p[0], p[2] - p[0], p[3] - p[0], &material));
  });
}

/// Points on the cube's edges and in its corners, where two or three faces
/// meet, and on the diagonals, where two triangles do.
std::vector<Vec3> seams(const Cube& cube) {
  std::vector<Vec3> result;
  for (int i = 0; i <= 64; ++i) {
    const float x = static_cast<float>(i) / 32 - 1;
    for (const float y : {-1.0f, 1.0f}) {
      for (const float z : {-1.0f, 1.0f}) {
        result.push_back(cube.point(x, y, z));
        result.push_back(cube.point(y, x, z));
        result.push_back(cube.point(y, z, x));
      }
      for (const float diagonal : {x, -x}) {
        result.push_back(cube.point(y, x, diagonal));
        result.push_back(cube.point(x, y, diagonal));
        result.push_back(cube.point(x, diagonal, y));
      }
    }
  }
  return result;
}

/// Cubes of several sizes and places, seen from their own inside.
template <class Test>
void for_each_cube(Test test) {
  Random random(1, 0, 0);
  for (const float half : {0.01f, 0.15f, 1.0f, 100.0f}) {
    for (const float away : {0.0f, 1.0f, 30.0f}) {
      for (int i = 0; i < 4; ++i) {
        Cube cube =
            random_cube(random, half, half * away * random_direction(random));
        if (i == 0) {  // along the axes
          cube.axes = {Vec3(half, 0, 0), Vec3(0, half, 0), Vec3(0, 0, half)};
        }
        INFO("half an edge " << half << ", center " << text(cube.center)
                             << ", axis " << text(cube.axes[0]));
        test(cube, of_rectangles(cube), random);
        test(cube, of_triangles(cube), random);
      }
    }
  }
}

}  // namespace

TEST_CASE("no ray in a random direction leaves a closed cube") {
  for_each_cube([](const Cube& cube, const Geometry& geometry,
                   Random& random) {
    int missed = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 at = random_position(random, 0.99f);
      const Ray ray{cube.point(at.x, at.y, at.z), random_direction(random)};
      missed += !geometry.nearest_hit(ray);
    }
    CHECK(missed == 0);
  });
}

TEST_CASE("no ray aimed at an edge or a corner leaves a closed cube") {
  for_each_cube([](const Cube& cube, const Geometry& geometry,
                   Random& random) {
    int missed = 0;
    for (const Vec3& target : seams(cube)) {
      for (const float inside : {0.0f, 0.5f, 0.9f, 0.999f}) {
        const Vec3 at = random_position(random, inside);
        const Vec3 origin = cube.point(at.x, at.y, at.z);
        missed += !geometry.nearest_hit({origin, normalize(target - origin)});
      }
    }
    CHECK(missed == 0);
  });
}

// From outside a gap shows the inside of the far faces. A ray that hits the
// seam of two faces that both face it must hit one of them. Seams with only
// one face that faces the ray are the outline, where a ray may pass.
TEST_CASE("no ray enters a cube between two faces that face the ray") {
  for (const float distance : {4.0f, 20.0f, 100.0f}) {
    Random random(1, 0, 0);
    int slipped = 0, aimed = 0;
    for (int i = 0; i < 1500; ++i) {
      const Cube cube = random_cube(random, 0.5f, random_position(random, 1));
      const Vec3 origin = cube.center + distance * random_direction(random);
      const Geometry geometry =
          i % 2 ? of_triangles(cube) : of_rectangles(cube);
      // The corner that is nearest to the ray's origin has no outline.
      std::array<Vec3, 3> axes = cube.axes;
      for (Vec3& axis : axes) {
        if (dot(axis, origin - cube.center) < 0) axis = -axis;
      }
      const Vec3 corner = cube.center + axes[0] + axes[1] + axes[2];
      for (int j = 0; j < 30; ++j) {
        const float along = 1.8f * random.uniform();
        const Vec3 target =
            corner - along * axes[static_cast<std::size_t>(j % 3)];
        bool looking = true;
        for (const Vec3& axis : axes) {
          looking = looking && dot(axis, origin - corner) > 0.01f * distance;
        }
        if (!looking) continue;
        ++aimed;
        const Ray ray{origin, normalize(target - origin)};
        const auto hit = geometry.nearest_hit(ray);
        slipped += !hit || hit->distance > length(target - origin) + 1e-3f;
      }
    }
    CAPTURE(distance);
    CHECK(aimed > 10000);
    CHECK(slipped == 0);
  }
}

// Most leaks begin in a corner: a hit on one wall is rounded to the far side
// of the next one, which the path then never hits.
TEST_CASE("no path leaves a closed cube") {
  for_each_cube(
      [](const Cube& cube, const Geometry& geometry, Random& random) {
        Ray ray{cube.center, random_direction(random)};
        int missed = 0;
        for (int i = 0; i < 5000; ++i) {
          const auto hit = geometry.nearest_hit(ray);
          missed += !hit;
          if (!hit) {
            ray = {cube.center, random_direction(random)};
            continue;
          }
          const Vec3 inwards = normal_towards(*hit, -ray.direction);
          const Vec3 next = inwards + 0.9999f * random_direction(random);
          ray = spawn_ray(*hit, normalize(next));
        }
        CHECK(missed == 0);
      });
}
