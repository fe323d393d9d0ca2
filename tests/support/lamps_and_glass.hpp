#pragma once

// # What lamps and glass look like, and that paths in glass end

#include "support/exact_radiance.hpp"
#include "support/specular_scenes.hpp"

namespace lightwalk::tests {

/// A lamp is ke from the front, at any angle, and black from the back; beside
/// it there is nothing.
template <class PathTracer>
void check_lamp_as_the_camera_sees_it() {
  const Scene scene =
      scene_text("[materials]\nlamp = { ke = [1, 2, 3] }\n" +
                 text::rectangle("-1, -1, 0", "2, 0, 0", "0, 2, 0", "lamp"));
  const DoubleVec3 ke(1, 2, 3), black(0);
  for (const int n : {0, 3}) {
    const RenderSettings settings = with_bounces(n);
    check_radiance<PathTracer>("a lamp from the front", scene,
                               {{0, 0, 5}, {0, 0, -1}}, settings, ke);
    check_radiance<PathTracer>("a lamp from the side", scene,
                               {{5, 0, 0.5f}, normalize(Vec3(-5, 0, -0.5f))},
                               settings, ke);
    check_radiance<PathTracer>("a lamp from the back", scene,
                               {{0, 0, -5}, {0, 0, 1}}, settings, black);
    check_radiance<PathTracer>("nothing at all", scene,
                               {{0, 0, 5}, {0, 0, 1}}, settings, black);
  }
}

/// A floor under the backs of emitters, of which only the rectangle can be
/// sampled.
template <class PathTracer>
void check_back_of_a_lamp_is_black() {
  const std::string floor =
      "[materials]\nfloor = { kd = 0.5 }\nlamp = { ke = 4 }\n" +
      text::plane("0, 1, 0", "0", "floor");
  const std::string shapes[] = {
      text::rectangle("-1, 1, -1", "0, 0, 2", "2, 0, 0", "lamp"),
      text::plane("0, 1, 0", "-1", "lamp"),
      "[[shapes]]\ntype = \"triangle\"\nmaterial = \"lamp\"\n"
      "vertices = [[-3, 1, -3], [0, 1, 3], [3, 1, -3]]\n"};
  for (const std::string& shape : shapes) {
    const Scene scene = scene_text(floor + shape);
    check_radiance<PathTracer>("a floor under the back of\n" + shape, scene,
                               {{0, 0.5f, 0}, {0, -1, 0}}, with_bounces(1),
                               DoubleVec3(0));
    check_radiance<PathTracer>("the back of\n" + shape, scene,
                               {{0, 0.5f, 0}, {0, 1, 0}}, with_bounces(1),
                               DoubleVec3(0));
  }
}

/// Each lobe of a colored floor in a white room. Only the refracted one is
/// weighted by eta: kd + ks + kt / 1.5^2.
template <class PathTracer>
void check_colored_lobes() {
  const Scene scene = in_white_room(
      "{ kd = [0.6, 0, 0.1], ks = [0.1, 0.8, 0], "
      "kt = [0, 0.1, 0.8], eta = 1.5 }",
      text::plane("0, 1, 0", "0", "thing"));
  check_radiance<PathTracer>(
      "a floor with three lobes", scene, {{0, 1, 0}, {0, -1, 0}},
      with_bounces(1), DoubleVec3(0.7, 0.8 + 0.1 / 2.25, 0.1 + 0.8 / 2.25));
}

/// Radiance 1 outside is eta^2 inside: more in glass, less in a bubble of air
/// under water, whose eta is 0.75.
template <class PathTracer>
void check_room_seen_from_inside_glass() {
  for (const char* eta : {"0.75", "1.33", "1.5", "2.42"}) {
    const double index = std::strtod(eta, nullptr);
    check_radiance<PathTracer>(
        std::string("a white room seen from inside glass of ") + eta,
        in_white_room(std::string("{ kt = 1, eta = ") + eta + " }",
                      ball("thing")),
        {{0.1f, 0.2f, 0}, normalize(Vec3(1, -2, 3))}, with_bounces(8),
        DoubleVec3(index * index));
  }
}

/// From the floor to the mirror to the lamp: the floor sampled the lamp, whose
/// back it sees, and the mirror samples no lights.
template <class PathTracer>
void check_lamp_in_a_mirror_lights_the_floor() {
  check_radiance<PathTracer>("a floor under a mirror and a lamp's back",
                             mirrored_lamp(), {{0, 0.5f, 0}, {0, -1, 0}},
                             with_bounces(2),
                             DoubleVec3(mirrored_lamp_radiance()), 100'000);
}

/// From the floor through two surfaces of glass to a lamp that the floor has
/// sampled, though glass hides it: glass samples no lights, so the lamp counts
/// when it is hit.
///
/// A ball of radius r within two balls of glass around the same center looks
/// eta^2 times as large from outside, since each surface bends a ray that
/// passes the center at the distance b to one at b / eta. Its radiance is
/// kt^2 ke / eta^4, so the floor gets kd kt^2 ke (r/d)^2, and eta cancels.
/// That holds while the images of the ball are smaller than the balls of
/// glass: 0.6 < 1 and 0.9 < 1.5. Glass of eta = 1 bends nothing, and the square
/// gives kd kt^2 ke 4 F.
template <class PathTracer>
void check_lamp_behind_glass_lights_the_floor() {
  const std::string floor =
      "[materials]\nfloor = { kd = 0.5 }\nlamp = { ke = 25 }\n"
      "glass = { kt = 0.9, eta = 1.5 }\nclear = { kt = 0.9, eta = 1 }\n" +
      text::plane("0, 1, 0", "0", "floor");
  const Ray down{{0, 0.1f, 0}, {0, -1, 0}};
  check_radiance<PathTracer>(
      "a floor under a ball that shines within two balls of glass",
      scene_text(floor + text::sphere("0, 2, 0", "1.5", "glass") +
                 text::sphere("0, 2, 0", "1", "glass") +
                 text::sphere("0, 2, 0", "0.4", "lamp")),
      down, with_bounces(3), DoubleVec3(0.5 * 0.81 * 25 * 0.2 * 0.2));
  check_radiance<PathTracer>(
      "a floor under a rectangle that shines behind a pane of eta = 1",
      scene_text(floor + text::plane("0, -1, 0", "0.5", "clear") +
                 text::plane("0, 1, 0", "-0.7", "clear") +
                 text::rectangle("-1, 1, -1", "2, 0, 0", "0, 0, 2", "lamp")),
      down, with_bounces(3),
      DoubleVec3(0.5 * 0.81 * 25 * 4 * rectangle_form_factor(1, 1, 1)));
}

/// Shadow rays do not go through glass: glass bends light, so a straight line
/// through it would be wrong.
template <class PathTracer>
void check_glass_casts_a_shadow() {
  const Scene scene =
      scene_text("[materials]\nfloor = { kd = 0.5 }\nglass = { kt = 1 }\n" +
                 text::plane("0, 1, 0", "0", "floor") +
                 text::sphere("0, 0.6, 0", "0.2", "glass") +
                 text::point_light("0, 1, 0", "5"));
  check_radiance<PathTracer>("a floor behind a glass ball", scene,
                             {{0, 0.01f, 0}, {0, -1, 0}}, with_bounces(1),
                             DoubleVec3(0));
}

/// Rays of one path, on average over `count` paths.
template <class PathTracer>
double rays_of_a_path(const Scene& scene, const Ray& ray, int count) {
  const PathTracer tracer(scene, {});
  const std::uint64_t before = rays_cast;
  estimate(tracer, ray, count);
  return static_cast<double>(rays_cast - before) / count;
}

/// Light that glass reflects totally forever: from bounce 16 on each path
/// survives with 0.95 at most, so it has about 17 + 20 rays. A program may
/// follow two such paths from the first surface.
template <class PathTracer>
void check_endless_path_ends() {
  const Scene scene = in_white_room("{ kt = 1 }", ball("thing"));
  const Ray grazing{{0.99f, 0, 0}, normalize(Vec3(0.01f, 1, 0))};
  check_radiance<PathTracer>("light that never leaves a ball", scene, grazing,
                             {}, DoubleVec3(0));
  const double rays = rays_of_a_path<PathTracer>(scene, grazing, 1000);
  INFO("a sample in the ball has ", rays, " rays, expected about ", 17 + 20,
       ", or twice as many if it is of two paths");
  CHECK(rays < 2.2 * (17 + 20));
}

/// Roulette starts at bounce 16 at the latest, and then lets at most half of
/// the paths live: 16 + 2 rays on average.
template <class PathTracer>
void check_path_on_a_dark_wall_is_short() {
  const Scene scene = scene_text("[materials]\nwall = { kd = 0.5 }\n" +
                                 text::sphere("0, 0, 0", "1", "wall"));
  const double rays = rays_of_a_path<PathTracer>(
      scene, {{0.2f, 0.1f, -0.3f}, {0, 0, 1}}, 1000);
  INFO("rays of a path between walls of kd = 0.5: ", rays,
       ", expected at most 18");
  CHECK(rays < 18);
}

}  // namespace lightwalk::tests
