#pragma once

// A scene that is moved, or scaled with all that is in it, gives the same
// picture. With the same random numbers its paths are the same up to
// rounding, so most of the noise cancels, and small differences show.

#include <doctest/doctest.h>

#include <array>

#include "compare/comparison.hpp"
#include "support/expectations.hpp"
#include "support/renders.hpp"

namespace lightwalk::tests {

/// Every position is multiplied by `scale`, and `move` is added.
struct Motion {
  float scale = 1;
  Vec3 move{0, 0, 0};

  Vec3 position(const Vec3& p) const { return scale * p + move; }
};

/// Coordinates that a float can hold at 10 km as well: multiples of 1/512.
inline Vec3 on_grid(const Vec3& p) {
  return glm::round(512.0f * p) / 512.0f;
}

/// The file's scene, which must have no triangles, after a motion. With
/// `wall_radius`, the planes that do not shine become spheres.
inline Scene moved(const Scene& scene, const Motion& motion,
                   float wall_radius = 0) {
  Scene result;
  result.camera = scene.camera;
  result.camera.origin = motion.position(scene.camera.origin);
  result.camera.left *= motion.scale;
  result.camera.up *= motion.scale;
  result.camera.forward *= motion.scale;
  REQUIRE(scene.geometry.triangles().empty());
  for (const Plane& plane : scene.geometry.planes()) {
    const Material* material = result.add(*plane.material);
    if (wall_radius > 0 && !material->emits()) {
      result.add(Sphere{-(wall_radius + plane.distance) * plane.normal,
                        wall_radius, material});
      continue;
    }
    const double distance =
        static_cast<double>(motion.scale * plane.distance) -
        glm::dot(DoubleVec3(plane.normal), DoubleVec3(motion.move));
    result.add(Plane{plane.normal, static_cast<float>(distance), material});
  }
  for (const Sphere& sphere : scene.geometry.spheres()) {
    const float radius = std::round(512 * sphere.radius) / 512;
    result.add(Sphere{motion.position(on_grid(sphere.center)),
                      motion.scale * radius, result.add(*sphere.material)});
  }
  for (const Rectangle& one : scene.geometry.rectangles()) {
    result.add(Rectangle{motion.position(on_grid(one.corner)),
                         motion.scale * on_grid(one.edge_u),
                         motion.scale * on_grid(one.edge_v),
                         result.add(*one.material)});
  }
  for (const auto& light : scene.lights) {
    const auto* point = std::get_if<PointLight>(&light.form);
    if (!point) continue;  // a shape's light, which was added with it
    result.add(PointLight{motion.position(on_grid(point->center)),
                          motion.scale * motion.scale * point->intensity});
  }
  result.prepare();
  return result;
}

/// The means must agree to 0.3 %, and each tile of 8x8 pixels to 2 % of its
/// own mean and 1e-4 of the image's, beyond the noise of the difference.
/// `what` says how the scene was moved.
inline void check_same_noise(const std::string& what, const Image& test,
                             const Image& reference) {
  for (const Region& region :
       regions_of(reference.width, reference.height, 1)) {
    const bool whole = region.width == reference.width;
    if (!whole && region.width < 8) continue;
    for (int channel = 0; channel < 3; ++channel) {
      const double a = mean_over(test, region, channel);
      const double b = mean_over(reference, region, channel);
      double squares = 0;
      for (int y = region.top; y < region.top + region.height; ++y) {
        for (int x = region.left; x < region.left + region.width; ++x) {
          const double d = static_cast<double>(test.at(x, y)[channel]) -
                           static_cast<double>(reference.at(x, y)[channel]) -
                           (a - b);
          squares += d * d;
        }
      }
      const double sigma =
          std::sqrt(squares) / (region.width * region.height);
      const double image = mean_over(
          reference, {0, 0, reference.width, reference.height}, channel);
      const double band = whole ? 0.003 * b : 0.02 * b + 1e-4 * image;
      if (std::abs(a - b) <= band + Bands{}.z_critical * sigma) continue;
      FAIL_CHECK(what << (whole ? ", the whole picture"
                                : ", the tile from column " +
                                      std::to_string(region.left) + ", row " +
                                      std::to_string(region.top) + " on")
                      << ": mean "
                      << std::string(
                             channel_names[static_cast<std::size_t>(channel)])
                      << " " << a << " +- " << sigma << ", expected " << b
                      << " as unmoved, " << a / b << " times it");
      return;  // one report is enough
    }
  }
}

/// Moves and scales the scene of a file.
template <class PathTracer>
void check_moved(const std::string& name, int samples, int max_bounces) {
  const Scene scene = scene_file(name, 32, 32);
  RenderSettings settings;
  settings.samples_per_pixel = samples;
  settings.max_bounces = max_bounces;
  const auto picture = [&](const Motion& motion, float wall_radius = 0) {
    Scene there = moved(scene, motion, wall_radius);
    return paint<PathTracer>(there, settings).radiance;
  };
  const Image unmoved = picture({});
  const std::array<Motion, 7> motions = {{{1e-4f, {0, 0, 0}},
                                          {1e4f, {0, 0, 0}},
                                          {1, {100, 0, 0}},
                                          {1, {-60, 62, 50}},
                                          {1, {0, -1e4f, 0}},
                                          {1, {0, 0, 1e4f}},
                                          {1, {5770, 5770, 5770}}}};
  for (const Motion& motion : motions) {
    check_same_noise(name + " scaled by " +
                         text_of(static_cast<double>(motion.scale)) +
                         " and moved by " + text_of(motion.move),
                     picture(motion), unmoved);
  }
  check_same_noise(name + " with spheres of radius 1e5 for walls",
                   picture({}, 1e5f), unmoved);
}

}  // namespace lightwalk::tests
