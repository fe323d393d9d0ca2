#pragma once

// # The scene
//
// A camera, materials, shapes and lights. Shapes point to their materials,
// and materials to their patterns, which therefore stay where they are: a
// scene is moved, never copied.

#include <deque>
#include <optional>
#include <vector>

#include "common/geometry/geometry.hpp"
#include "common/scene/camera.hpp"
#include "common/scene/light.hpp"
#include "common/scene/material.hpp"
#include "common/scene/path_log.hpp"

namespace lightwalk {

struct Scene {
  Camera camera;
  std::deque<Material> materials;
  std::deque<VaryingCoefficient> varying_coefficients;
  std::deque<Texture> textures;
  Geometry geometry;
  std::vector<PointLight> point_lights;
  std::vector<RectangleLight> rectangle_lights;
  std::vector<SphereLight> sphere_lights;

  Scene() = default;
  Scene(Scene&&) = default;
  Scene& operator=(Scene&&) = default;

  /// Keeps a material; the pointer is good as long as the scene.
  const Material* add(const Material& material) {
    return &materials.emplace_back(material);
  }

  void add(const PointLight& light) { point_lights.push_back(light); }
  void add(const Plane& plane) { geometry.add(plane); }
  void add(const Triangle& triangle) { geometry.add(triangle); }
  void add(const Sphere& sphere) {
    geometry.add(sphere);
    if (sphere.material->emits()) {
      sphere_lights.push_back(
          {sphere.center, sphere.radius, sphere.material->ke});
    }
  }
  void add(const Rectangle& r) {
    geometry.add(r);
    if (r.material->emits()) {
      rectangle_lights.push_back(
          {r.corner, r.edge_u, r.edge_v, r.material->ke});
    }
  }

  /// The first surface that the ray meets, if there is one.
  std::optional<Hit> nearest_hit(const Ray& ray) const {
    note_ray(ray);
    return geometry.nearest_hit(ray);
  }

  /// Whether nothing lies between two points, neither of them on a surface.
  bool visible(const Vec3& from, const Vec3& to) const {
    const bool reached = geometry.visible(from, to);
    note_shadow_ray({from, normalize(to - from)}, length(to - from), reached);
    return reached;
  }
};

}  // namespace lightwalk
