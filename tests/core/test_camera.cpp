#include <doctest/doctest.h>

#include "common/scene/camera.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

constexpr float rounding = 1e-6f;

/// Where a ray meets the image plane z = z_plane.
Vec3 on_plane(const Ray& ray, float z_plane) {
  const float t = (z_plane - ray.origin.z) / ray.direction.z;
  return ray.origin + t * ray.direction;
}

}  // namespace

// The slides' camera: O = (0, 0, -3.5), L = (-1, 0, 0), U = (0, 1, 0) and
// F = (0, 0, 3). Its upper left corner is F + L + U = (-1, 1, 3) from O.
TEST_CASE("the slides' camera looks at the corners of a square 2 wide") {
  const Camera camera;
  const int last = 255;
  CHECK(camera.ray(0, 0, {0, 0}).origin == Vec3(0, 0, -3.5f));
  CHECK(camera.ray(0, 0, {0, 0}).direction ==
        Near{normalize(Vec3(-1, 1, 3)), rounding});
  CHECK(camera.ray(last, 0, {1, 0}).direction ==
        Near{normalize(Vec3(1, 1, 3)), rounding});
  CHECK(camera.ray(0, last, {0, 1}).direction ==
        Near{normalize(Vec3(-1, -1, 3)), rounding});
  CHECK(camera.ray(last, last, {1, 1}).direction ==
        Near{normalize(Vec3(1, -1, 3)), rounding});
  CHECK(camera.ray(128, 128, {0, 0}).direction == Near{{0, 0, 1}, rounding});
}

TEST_CASE("column 0 is at the left, row 0 at the top") {
  const Camera camera;
  const Vec2 middle{0.5f, 0.5f};
  CHECK(dot(camera.ray(0, 128, middle).direction, camera.left) > 0);
  CHECK(dot(camera.ray(255, 128, middle).direction, camera.left) < 0);
  CHECK(dot(camera.ray(128, 0, middle).direction, camera.up) > 0);
  CHECK(dot(camera.ray(128, 255, middle).direction, camera.up) < 0);
}

// Four columns of three rows over 2 x 2: a pixel is 1/2 wide and 2/3 high,
// and the middle of column 1, row 0 is at x = -1/4, y = 2/3.
TEST_CASE("an image that is not square spans the same left and up") {
  Camera camera;
  camera.width = 4;
  camera.height = 3;
  const auto at = [&](int column, int row, Vec2 u) {
    return on_plane(camera.ray(column, row, u), -0.5f);
  };
  CHECK(at(0, 0, {0, 0}) == Near{{-1, 1, -0.5f}, rounding});
  CHECK(at(3, 2, {1, 1}) == Near{{1, -1, -0.5f}, rounding});
  CHECK(at(1, 0, {0.5f, 0.5f}) == Near{{-0.25f, 2.0f / 3, -0.5f}, rounding});
  CHECK(at(2, 1, {0.5f, 0.5f}) == Near{{0.25f, 0, -0.5f}, rounding});
}

TEST_CASE("the camera's vectors may be of any length and at any angle") {
  Camera camera;
  camera.origin = {1, 2, 3};
  camera.left = {-2, 0.5f, 0};
  camera.up = {0.25f, 1, 0.5f};
  camera.forward = {0.5f, -0.25f, 4};
  camera.width = camera.height = 10;
  CHECK(camera.ray(0, 0, {0, 0}).direction ==
        Near{normalize(camera.forward + camera.left + camera.up), rounding});
  CHECK(camera.ray(9, 9, {1, 1}).direction ==
        Near{normalize(camera.forward - camera.left - camera.up), rounding});
  CHECK(camera.ray(5, 5, {0, 0}).direction ==
        Near{normalize(camera.forward), rounding});
  CHECK(camera.ray(5, 5, {0, 0}).origin == camera.origin);
}

// u = (0, 0) is the pixel's upper left corner, (1, 1) the next pixel's.
TEST_CASE("the two random numbers reach every point of a pixel, no further") {
  const Camera camera;
  for (const int column : {0, 100, 254}) {
    for (const int row : {0, 77, 254}) {
      CAPTURE(column);
      CAPTURE(row);
      CHECK(
          camera.ray(column, row, {1, 1}).direction ==
          Near{camera.ray(column + 1, row + 1, {0, 0}).direction, rounding});
      const Vec3 corner = on_plane(camera.ray(column, row, {0, 0}), -0.5f);
      const Vec3 across = on_plane(camera.ray(column, row, {1, 0}), -0.5f);
      const Vec3 down = on_plane(camera.ray(column, row, {0, 1}), -0.5f);
      const Vec3 inside =
          on_plane(camera.ray(column, row, {0.25f, 0.75f}), -0.5f);
      CHECK(across - corner == Near{{2.0f / 256, 0, 0}, rounding});
      CHECK(down - corner == Near{{0, -2.0f / 256, 0}, rounding});
      CHECK(inside - corner == Near{{0.5f / 256, -1.5f / 256, 0}, rounding});
    }
  }
}

TEST_CASE("every camera ray has unit length") {
  Camera camera;
  camera.forward = {0, 0, 0.1f};
  for (int column = 0; column < 256; column += 15) {
    for (int row = 0; row < 256; row += 15) {
      const Ray ray = camera.ray(column, row, {0.5f, 0.5f});
      CHECK(std::abs(length(ray.direction) - 1) <= rounding);
    }
  }
}
