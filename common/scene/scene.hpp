#pragma once

// # The scene
//
// A camera, materials, shapes and lights. Shapes point to their materials and
// lights, and materials to their varying coefficients. So these must stay
// where they are in memory: a scene is moved, never copied.

#include <cassert>
#include <deque>
#include <optional>
#include <variant>
#include <vector>

#include "common/geometry/geometry.hpp"
#include "common/scene/camera.hpp"
#include "common/scene/light.hpp"
#include "common/scene/material.hpp"
#include "common/scene/path_log.hpp"
#include "common/scene/ray_count.hpp"

namespace lightwalk {

// ## Two surfaces in one place
//
// A lamp may be flush with the ceiling, and one slab of glass may lie on
// another. Which of the two a ray meets first then depends on rounding, and
// differs from ray to ray. So rectangles and triangles that emit light are
// moved a little forward, and those of glass a little backward: by two ulps
// (units in the last place) of their largest coordinate. A pane must be
// thicker than the steps of its two faces. The point where a ray meets a lamp
// is also rounded in proportion to the ray's length, and most rays come from
// about as far as the camera is. So a lamp is moved by eight more ulps of its
// distance to the camera.

// #region set-apart
/// The vector by which a shape is moved, in a scene seen from `eye`.
inline Vec3 step_apart(const FlatShape& flat, const Vec3& eye) {
  const Vec3 half = 0.5f * (absolute(flat.edge_u) + absolute(flat.edge_v));
  const Vec3 middle = flat.corner + 0.5f * (flat.edge_u + flat.edge_v);
  const float largest = max_component(absolute(middle) + half);
  const float way = max_component(absolute(middle - eye) + half);
  const Vec3 unit = flat_rounding * flat.normal;
  if (flat.material->emits()) return (2 * largest + 8 * way) * unit;
  if (flat.material->refracts()) return -2 * largest * unit;
  return Vec3(0);
}

template <class Flat>
Flat set_apart(Flat flat, const Vec3& eye) {
  flat.corner += step_apart(flat, eye);
  return flat;
}
// #endregion set-apart

struct Scene {
  Camera camera;
  std::deque<Material> materials;
  std::deque<VaryingCoefficient> varying_coefficients;
  std::deque<Texture> textures;
  Geometry geometry;
  std::deque<Light> lights;  ///< those that can be sampled

  Scene() = default;
  Scene(Scene&&) = default;
  Scene& operator=(Scene&&) = default;

  /// Keeps a material; the pointer is valid as long as the scene lives.
  const Material* add(const Material& material) {
    return &materials.emplace_back(material);
  }

  /// A shape or a point light. Rays meet it after prepare().
  using Addition =
      std::variant<PointLight, Plane, Sphere, Rectangle, Triangle>;
  void add(const Addition& one) { added_.push_back(one); }

  /// Adds to `geometry` and `lights` what was added since the last call, as
  /// seen from where the camera is now. paint() calls it.
  void prepare() {
    for (const Addition& one : added_) {
      std::visit([this](const auto& thing) { place(thing); }, one);
    }
    added_ = {};
    geometry.prepare();
  }

  /// The first surface that the ray meets, if there is one. The ray's
  /// direction must be a unit vector, and prepare() must have been called
  /// after the last add().
  ///
  /// In a render it may throw `Stopped` (common/render/render_progress.hpp):
  /// one sample of a tree of paths can take longer than anybody waits, so
  /// every 256 rays it checks whether the render is over. Do not catch it.
  std::optional<Hit> nearest_hit(const Ray& ray) const {
    assert(added_.empty() && "a scene is prepared before rays meet it");
    count_ray();
    note_ray(ray);
    return geometry.nearest_hit(ray);
  }

  /// Whether the ray reaches the light: it meets nothing before `distance`,
  /// in the scene's unit of length, but the light itself. Its conditions are
  /// those of nearest_hit(), and it may throw `Stopped`, too.
  bool reaches(const Ray& ray, float distance, const Light& light) const {
    count_ray();
    const bool has_surface = !std::holds_alternative<PointLight>(light.form);
    const bool reached = has_surface ? geometry.reaches(ray, distance, light)
                                     : !geometry.occluded(ray, distance);
    note_shadow_ray(ray, distance, reached);
    return reached;
  }

 private:
  void place(const PointLight& light) { lights.push_back({light}); }
  void place(const Plane& plane) { geometry.add(plane); }
  void place(const Triangle& triangle) {
    geometry.add(set_apart(triangle, camera.origin));
  }
  void place(Sphere sphere) {
    if (sphere.material->emits()) {
      sphere.light = &lights.emplace_back(Light{
          SphereLight{sphere.center, sphere.radius, sphere.material->ke}});
    }
    geometry.add(sphere);
  }
  void place(const Rectangle& rectangle) {
    Rectangle r = set_apart(rectangle, camera.origin);
    if (r.material->emits()) {
      r.light = &lights.emplace_back(Light{
          RectangleLight{r.corner, r.edge_u, r.edge_v, r.material->ke}});
    }
    geometry.add(r);
  }

  std::vector<Addition> added_;
};

}  // namespace lightwalk
