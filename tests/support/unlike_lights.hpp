#pragma once

// # Two lights of a type, and no two alike
//
// They differ in place, size and color, so no light can replace another. Their
// contributions add up, in any order of the scene.

#include <array>

#include "support/exact_radiance.hpp"
#include "support/specular_scenes.hpp"

namespace lightwalk::tests {

/// One light, and the irradiance over pi that it gives to the floor's origin.
struct UnlikeLight {
  const char* what;
  std::string shape;
  DoubleVec3 gives;
};

/// Two points, two balls and two rectangles. None hides another.
/// I cos / (pi d^2); ke cos (r / d)^2; ke F.
inline std::array<UnlikeLight, 6> unlike_lights() {
  const double pi_ = std::acos(-1.0);
  return {{
      {"a point light", text::point_light("-1, 2, 2", "[30, 10, 0]"),
       DoubleVec3(30, 10, 0) * 2.0 / 27.0 / pi_},
      {"another point light", text::point_light("1, 1, -1", "[0, 5, 9]"),
       DoubleVec3(0, 5, 9) / std::pow(3.0, 1.5) / pi_},
      {"a ball", text::sphere("6, 3, -2", "1", "red"),
       DoubleVec3(9, 1, 0) * 3.0 / 7.0 / 49.0},
      {"another ball", text::sphere("-4, 4, -7", "3", "blue"),
       DoubleVec3(0, 1, 4) * 4.0 / 9.0 * 9.0 / 81.0},
      {"a rectangle",
       text::rectangle("0, 0.8, 0", "1.5, 0, 0", "0, 0, 0.7", "red"),
       DoubleVec3(9, 1, 0) * rectangle_form_factor(1.5, 0.7, 0.8)},
      {"another rectangle",
       text::rectangle("-1, 3, -2", "1, 0, 0", "0, 0, 2", "blue"),
       DoubleVec3(0, 1, 4) * rectangle_form_factor(1, 2, 3)},
  }};
}

/// Lights of the same types that bring nothing to it: below the floor, turned
/// away from it, or behind a black ball, which is part of them.
inline std::array<UnlikeLight, 6> useless_lights() {
  const std::string screen = text::sphere("2, 0.8, 2", "0.4", "black");
  const DoubleVec3 nothing(0);
  return {{
      {"a point light below", text::point_light("1, -2, 1", "[40, 0, 9]"),
       nothing},
      {"a point light behind something",
       screen + text::point_light("5, 2, 5", "[40, 0, 9]"), nothing},
      {"a ball below", text::sphere("2, -4, 1", "1", "blue"), nothing},
      {"a ball behind something",
       screen + text::sphere("5, 2, 5", "0.4", "blue"), nothing},
      {"a rectangle that is turned away",
       text::rectangle("2, 2, -3", "0, 0, 1", "1, 0, 0", "red"), nothing},
      {"a rectangle behind something",
       screen + text::rectangle("5, 2, 5", "0.3, 0, 0", "0, 0, 0.3", "red"),
       nothing},
  }};
}

/// Sends a ray to the origin of a diffuse floor, with these shapes about it
/// and one bounce.
template <class PathTracer>
void check_floor_among(const std::string& what, const std::string& shapes,
                       const DoubleVec3& gives) {
  const std::string floor =
      "[materials]\nfloor = { kd = [0.5, 0.25, 0.75] }\nblack = { kd = 0 }\n"
      "red = { ke = [9, 1, 0] }\nblue = { ke = [0, 1, 4] }\n" +
      text::plane("0, 1, 0", "0", "floor");
  const Ray down{{0, 0.005f, 0}, {0, -1, 0}};
  check_radiance<PathTracer>(what, scene_text(floor + shapes), down,
                             with_bounces(1),
                             DoubleVec3(0.5, 0.25, 0.75) * gives, 20'000);
}

/// A light that brings nothing does not affect the lights after it.
template <class PathTracer>
void check_useless_lights() {
  const auto lights = unlike_lights();
  const auto useless = useless_lights();
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const UnlikeLight& one = lights[i];
    for (const UnlikeLight& other : {useless[i], useless[i ^ 1]}) {
      check_floor_among<PathTracer>(
          other.what + std::string(", then ") + one.what,
          other.shape + one.shape, one.gives);
    }
  }
}

/// A diffuse floor under two of them, in both orders, and under all six.
template <class PathTracer>
void check_unlike_lights() {
  const auto lights = unlike_lights();
  const auto check = check_floor_among<PathTracer>;
  std::string all;
  DoubleVec3 sum(0);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const UnlikeLight& one = lights[i];
    const UnlikeLight& other = lights[i ^ 1];
    check(one.what, one.shape, one.gives);
    check(one.what + std::string(" and then ") + other.what,
          one.shape + other.shape, one.gives + other.gives);
    all += one.shape;
    sum += one.gives;
  }
  check("six lights", all, sum);
}

/// A hundred point lights at heights from 1 to 2, straight overhead. Each has
/// the intensity h^2, and gives I / (pi h^2) = 1 / pi.
template <class PathTracer>
void check_many_lights() {
  std::string lights;
  for (int i = 0; i < 100; ++i) {
    const double h = 1 + i / 100.0;
    lights += text::point_light("0, " + std::to_string(h) + ", 0",
                                std::to_string(h * h));
  }
  check_floor_among<PathTracer>("a floor under a hundred lights", lights,
                                DoubleVec3(100 / std::acos(-1.0)));
}

}  // namespace lightwalk::tests
