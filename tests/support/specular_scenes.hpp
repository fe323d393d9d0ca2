#pragma once

// Scenes of mirrors and glass in a uniform white surround, whose radiance is
// known exactly: what is lossless cannot be seen in it (testing is that
// simple, and finds nearly every mistake with glass).

#include <string>

#include "support/renders.hpp"

namespace lightwalk::tests {

/// A closed white room that emits 1 inwards on all sides. Rectangles are
/// lamps that can be asked, and planes are not: it is made of planes.
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

/// A ray towards the thing from anywhere around it.
inline Ray ray_at_thing(Random& random) {
  const auto point_on_sphere = [&] {
    const Vec2 u = random.uniform_2d();
    const float z = 2 * u.x - 1;
    const float r = std::sqrt(std::max(0.0f, 1 - z * z));
    return Vec3(r * std::cos(two_pi * u.y), r * std::sin(two_pi * u.y), z);
  };
  const Vec3 origin = 5.0f * point_on_sphere();
  const Vec3 target = 0.9f * point_on_sphere();
  return {origin, normalize(target - origin)};
}

}  // namespace lightwalk::tests
