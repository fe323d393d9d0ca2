#include <doctest/doctest.h>

#include "common/math/basis.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

// Each entry is a sum of three products of numbers up to 1, each rounded to
// 24 bits, from a normal that is itself a unit vector only to rounding.
constexpr float rounding = 1e-6f;

// Three unit axes at right angles are right-handed when t x b = n.
void check_frame(const Vec3& n) {
  const Basis frame(n);
  INFO("normal " << text(n) << ", tangent " << text(frame.tangent)
                 << ", bitangent " << text(frame.bitangent));
  CHECK(frame.normal == n);
  CHECK(std::abs(length(frame.tangent) - 1) <= rounding);
  CHECK(std::abs(length(frame.bitangent) - 1) <= rounding);
  CHECK(std::abs(dot(frame.tangent, frame.bitangent)) <= rounding);
  CHECK(std::abs(dot(frame.tangent, n)) <= rounding);
  CHECK(std::abs(dot(frame.bitangent, n)) <= rounding);
  CHECK(cross(frame.tangent, frame.bitangent) == Near{n, rounding});
}

}  // namespace

TEST_CASE("a frame exists for normals along every axis, both ways") {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {1.0f, -1.0f}) {
      for (const float zero : {0.0f, -0.0f}) {
        Vec3 n(zero);
        n[axis] = sign;
        check_frame(n);
      }
    }
  }
}

TEST_CASE("a frame exists for 1000 random normals") {
  Random random(1, 0, 0);
  for (int i = 0; i < 1000; ++i) check_frame(random_direction(random));
}

TEST_CASE("a frame is as good beside the poles and across z = 0") {
  for (float tiny = 0.1f; tiny > 1e-40f; tiny /= 10) {
    for (const float sign : {1.0f, -1.0f}) {
      for (const float side : {1.0f, -1.0f}) {
        check_frame(normalize(Vec3(side * tiny, 0, sign)));
        check_frame(normalize(Vec3(0, side * tiny, sign)));
        check_frame(normalize(Vec3(side * tiny, -tiny, sign)));
        check_frame(normalize(Vec3(0.6f, 0.8f * side, sign * tiny)));
      }
    }
  }
}

TEST_CASE("the frame's z axis is the normal, its x axis the tangent") {
  const Basis frame(normalize(Vec3(1, -2, 0.5f)));
  CHECK(frame.to_world({0, 0, 1}) == frame.normal);
  CHECK(frame.to_world({1, 0, 0}) == frame.tangent);
  CHECK(frame.to_world({0, 1, 0}) == frame.bitangent);
}

TEST_CASE("to_local undoes to_world") {
  Random random(2, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const Basis frame(random_direction(random));
    const Vec3 v = random_position(random, 1);
    INFO("normal " << text(frame.normal));
    CHECK(frame.to_local(frame.to_world(v)) == Near{v, 2 * rounding});
    CHECK(frame.to_world(frame.to_local(v)) == Near{v, 2 * rounding});
  }
}
