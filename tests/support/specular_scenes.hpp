#pragma once

// Scenes of mirrors and glass in a uniform white room. Their radiance is
// known exactly: what loses no light is invisible there. This simple test
// finds nearly every mistake with glass.

#include <string>

#include "support/renders.hpp"

namespace lightwalk::tests {

/// A closed white room that emits 1 inwards on all sides. It is made of
/// planes, because rectangles would be lamps that can be sampled.
inline std::string white_room() {
  std::string text;
  for (const char* normal : {"[1, 0, 0]", "[-1, 0, 0]", "[0, 1, 0]",
                             "[0, -1, 0]", "[0, 0, 1]", "[0, 0, -1]"}) {
    text += std::string("[[shapes]]\ntype = \"plane\"\nnormal = ") + normal +
            "\ndistance = 10\nmaterial = \"surround\"\n";
  }
  return text;
}

/// The six faces of the cube [-1, 1]^3, normals outwards.
inline std::string cube(const std::string& material) {
  const char* faces[6] = {
      "corner = [-1, -1, 1]\nedge_u = [2, 0, 0]\nedge_v = [0, 2, 0]",
      "corner = [-1, -1, -1]\nedge_u = [0, 2, 0]\nedge_v = [2, 0, 0]",
      "corner = [1, -1, -1]\nedge_u = [0, 2, 0]\nedge_v = [0, 0, 2]",
      "corner = [-1, -1, -1]\nedge_u = [0, 0, 2]\nedge_v = [0, 2, 0]",
      "corner = [-1, 1, -1]\nedge_u = [0, 0, 2]\nedge_v = [2, 0, 0]",
      "corner = [-1, -1, -1]\nedge_u = [2, 0, 0]\nedge_v = [0, 0, 2]"};
  std::string text;
  for (const char* face : faces) {
    text += std::string("[[shapes]]\ntype = \"rectangle\"\n") + face +
            "\nmaterial = \"" + material + "\"\n";
  }
  return text;
}

inline std::string ball(const std::string& material) {
  return "[[shapes]]\ntype = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\n"
         "material = \"" +
         material + "\"\n";
}

/// The room with one thing in it. `material` is its line in [materials].
inline Scene in_white_room(const std::string& material,
                           const std::string& shape) {
  return scene_text("[materials]\nsurround = { ke = 1 }\nthing = " +
                    material + "\n" + white_room() + shape);
}

/// A floor (y = 0, kd = 0.5), a mirror above it (y = 2, ks = 0.8, looking
/// down), and between them a lamp (y = 1, ke = 4) that shines upwards. The
/// floor is lit only through the mirror.
inline Scene mirrored_lamp() {
  return scene_text(R"([materials]
floor  = { kd = 0.5 }
mirror = { ks = 0.8 }
lamp   = { ke = 4 }
[[shapes]]
type = "plane"
normal = [0, 1, 0]
distance = 0
material = "floor"
[[shapes]]
type = "plane"
normal = [0, -1, 0]
distance = 2
material = "mirror"
[[shapes]]
type = "rectangle"
corner = [3, 1, -3]
edge_u = [0, 0, 6]
edge_v = [6, 0, 0]
material = "lamp"
)");
}

/// The share of the cosine-weighted hemisphere that a parallel rectangle
/// a x b fills, seen from below one corner at distance h (Howell, A Catalog of
/// Radiation Heat Transfer Configuration Factors, B-3).
inline double rectangle_form_factor(double a, double b, double h) {
  const double x = a / h, y = b / h;
  const double big_x = std::sqrt(1 + x * x), big_y = std::sqrt(1 + y * y);
  return (x / big_x * std::atan(y / big_x) +
          y / big_y * std::atan(x / big_y)) /
         (2 * std::acos(-1.0));
}

/// The radiance of `mirrored_lamp`'s floor at the origin: kd ks ke F,
/// where F is that of the lamp's image in the mirror, at y = 3, x from 3 to 9
/// and z from -3 to 3. The lamp itself blocks no ray: it starts at x = 3, and
/// at its height the rays to the image's far edge have reached x = 3.
inline double mirrored_lamp_radiance() {
  return 0.5 * 0.8 * 4 * 2 *
         (rectangle_form_factor(9, 3, 3) - rectangle_form_factor(3, 3, 3));
}

/// A ray toward the thing from anywhere around it.
inline Ray ray_at_thing(Random& random) {
  const auto point_on_sphere = [&] {
    const Vec2 u(random.uniform_2d());
    const float z = 2 * u.x - 1;
    const float r = std::sqrt(std::max(0.0f, 1 - z * z));
    return Vec3(r * std::cos(two_pi * u.y), r * std::sin(two_pi * u.y), z);
  };
  const Vec3 origin = 5.0f * point_on_sphere();
  const Vec3 target = 0.9f * point_on_sphere();
  return {origin, normalize(target - origin)};
}

/// The statistics of `samples` samples, each along another ray to the thing.
template <class PathTracer>
Pixel estimate_of_thing(const PathTracer& tracer, int samples,
                        std::uint64_t seed) {
  Pixel pixel;
  for (int i = 0; i < samples; ++i) {
    Random random(seed, 0, static_cast<std::uint64_t>(i));
    const Ray ray = ray_at_thing(random);
    pixel.add(tracer.radiance(ray, random));
  }
  return pixel;
}

}  // namespace lightwalk::tests
