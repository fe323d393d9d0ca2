#pragma once

// # Radiance has no largest value and no smallest
//
// Scenes a million times as bright, and as dim, as others: clamped samples
// lose light, and so do paths that are cut off because their throughput is
// small. The contribution of a path is only known at its end.

#include "support/exact_radiance.hpp"
#include "support/specular_scenes.hpp"

namespace lightwalk::tests {

inline const char* const bright_and_dim[] = {"1e-6", "1", "1e6"};

inline double number(const char* text) {
  return std::strtod(text, nullptr);
}

/// kd ke of a sky, which the path hits, and the sky itself.
template <class PathTracer>
void check_bright_and_dim_sky() {
  for (const char* ke : bright_and_dim) {
    const Scene scene = scene_text(
        std::string("[materials]\nfloor = { kd = [0.5, 0.25, 0.75] }\n"
                    "sky = { ke = ") +
        ke + " }\n" + text::plane("0, 1, 0", "1", "floor") +
        text::plane("0, -1, 0", "1", "sky"));
    const std::string what = std::string("a sky of radiance ") + ke;
    check_radiance<PathTracer>(what, scene, {{0, 0, 0}, {0.6f, 0.8f, 0}},
                               with_bounces(4), DoubleVec3(number(ke)));
    check_radiance<PathTracer>("a floor under " + what, scene,
                               {{0, 0, 0}, {0.6f, -0.8f, 0}}, with_bounces(4),
                               number(ke) * DoubleVec3(0.5, 0.25, 0.75));
  }
}

/// Direct light: kd / pi I / h^2 of a point, and kd ke / 4 of a ball.
template <class PathTracer>
void check_bright_and_dim_lamps() {
  for (const char* power : bright_and_dim) {
    const std::string floor =
        std::string("[materials]\nfloor = { kd = 0.5 }\nlamp = { ke = ") +
        power + " }\n" + text::plane("0, 1, 0", "0", "floor");
    const Ray down{{0, 0.005f, 0}, {0, -1, 0}};
    check_radiance<PathTracer>(
        std::string("a floor under a point light of ") + power,
        scene_text(floor + text::point_light("0, 2, 0", power)), down,
        with_bounces(4),
        DoubleVec3(0.5 / std::acos(-1.0) * number(power) / 4));
    check_radiance<PathTracer>(
        std::string("a floor under a ball of radiance ") + power,
        scene_text(floor + text::sphere("0, 2, 0", "1", "lamp")), down,
        with_bounces(1), DoubleVec3(0.5 * number(power) / 4));
  }
}

/// A room of each radiance behind a mirror, behind glass, and around plastic.
template <class PathTracer>
void check_bright_and_dim_in_mirrors_and_glass() {
  struct Case {
    const char* material;
    double shows;
  };
  const Case cases[] = {{"{ ks = 0.5 }", 0.5},
                        {"{ kt = 0.9 }", 0.81},
                        {"{ kd = 0.4, ks = 0.3 }", 0.7}};
  for (const Case& one : cases) {
    for (const char* ke : bright_and_dim) {
      const Scene scene =
          scene_text(std::string("[materials]\nsurround = { ke = ") + ke +
                     " }\nthing = " + one.material + "\n" + white_room() +
                     ball("thing"));
      check_radiance<PathTracer>(std::string("a ball with ") + one.material +
                                     " in a room of radiance " + ke,
                                 scene, {{0.3f, 0.2f, -5}, {0, 0, 1}},
                                 with_bounces(4),
                                 DoubleVec3(one.shows * number(ke)));
    }
  }
}

/// kd is 1 in 2000 and the sky 2000: the throughput is small until the path
/// hits the sky. Roulette that lets 1 path in 2000 live needs many samples.
template <class PathTracer>
void check_dark_floor_under_a_bright_sky(const std::string& rest = "") {
  const Scene scene = scene_text("[materials]\nfloor = { kd = 5e-4" + rest +
                                 " }\nsky = { ke = 2000 }\n" +
                                 text::plane("0, 1, 0", "1", "floor") +
                                 text::plane("0, -1, 0", "1", "sky"));
  check_radiance<PathTracer>("a dark floor under a bright sky", scene,
                             {{0, 0, 0}, {0.6f, -0.8f, 0}}, with_bounces(4),
                             DoubleVec3(1), 400'000);
}

/// A lamp within four balls of diamond, seen from outside: radiance falls by
/// 2.42^2 at each surface, so the throughput is 1/1200.
template <class PathTracer>
void check_lamp_in_diamond() {
  const Scene scene = scene_text(
      "[materials]\ndiamond = { kt = 1, eta = 2.42 }\nlamp = { ke = 2000 "
      "}\n" +
      text::sphere("0, 0, 0", "4", "diamond") +
      text::sphere("0, 0, 0", "3", "diamond") +
      text::sphere("0, 0, 0", "2", "diamond") +
      text::sphere("0, 0, 0", "1", "diamond") +
      text::sphere("0, 0, 0", "0.5", "lamp"));
  check_radiance<PathTracer>("a bright lamp in four balls of diamond", scene,
                             {{0, 0, -9}, {0, 0, 1}}, with_bounces(8),
                             DoubleVec3(2000 / std::pow(2.42, 8)), 400'000);
}

/// After n bounces between plastic walls each path has the throughput 0.5^n or
/// less, and all paths together bring 0.5 (1 + 0.9 + 0.9^2 + ...).
template <class PathTracer>
void check_many_bounces_on_plastic(int max_bounces) {
  const Scene scene =
      scene_text("[materials]\nwall = { kd = 0.5, ks = 0.4 }\n" +
                 text::sphere("0, 0, 0", "1", "wall") +
                 text::point_light("0, 0, 0", "3.14159265"));
  double expected = 0;
  for (int i = 0; i < std::min(max_bounces, 1000); ++i) {
    expected = 0.5 + 0.9 * expected;
  }
  check_radiance<PathTracer>("plastic walls around a light", scene,
                             {{0.2f, 0.1f, -0.3f}, {0, 0.6f, 0.8f}},
                             with_bounces(max_bounces), DoubleVec3(expected));
}

}  // namespace lightwalk::tests
