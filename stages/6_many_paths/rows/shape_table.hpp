#pragma once

// # Shapes that many rays meet together
//
// One shape meets the rays of all lanes, then the next shape does, and each
// lane keeps its nearest hit: no ray waits for another. What is needed of the
// shape that was hit stands in a table with a line for each shape, where each
// lane looks up its own.
//
// The lines are in the order of the shapes' slots. So of two that are equally
// near the first one counts, as in geometry/geometry.hpp.

#include <algorithm>
#include <deque>
#include <unordered_map>
#include <variant>
#include <vector>

#include "common/scene/scene.hpp"
#include "stages/6_many_paths/rows/column.hpp"
#include "stages/6_many_paths/rows/hit_row.hpp"

#ifdef LIGHTWALK_ROWS

namespace lightwalk {

class ShapeTable {
 public:
  explicit ShapeTable(const Scene& scene)
      : geometry_(scene.geometry), lights_(scene.lights) {
    std::unordered_map<const Light*, std::int32_t> lights{{nullptr, -1}};
    std::unordered_map<const Material*, std::int32_t> materials;
    for (const Light& light : scene.lights) {
      lights.emplace(&light, static_cast<std::int32_t>(lights.size()) - 1);
    }
    geometry_.for_each_shape([&](const auto& shape, const Hit& hit) {
      const auto number = static_cast<std::int32_t>(materials.size());
      const auto known = materials.emplace(shape.material, number);
      if (known.second) materials_.push_back(shape.material);
      lines_.resize(index(hit.slot) + 1);
      lines_.back() = static_cast<std::int32_t>(hits_.size());
      hits_.push_back(hit);
      slot_.push_back(hit.slot);
      material_.push_back(known.first->second);
      light_.push_back(lights.at(shape.light));
      add(shape);
    });
    if (hits_.empty()) {  // a line for rays that meet nothing
      add_line(Vec3(0), 0, Vec3(0));
      material_.push_back(0);
      light_.push_back(-1);
    }
  }

  /// The materials of the shapes; each shape's is a number of one of these.
  const std::vector<const Material*>& materials() const { return materials_; }
  HWY_INLINE Ints material(const Hits& hits) const {
    return material_.at(hits.line);
  }

  /// Where the shape is a light that can be sampled.
  HWY_INLINE Mask is_light(const Hits& hits) const {
    return light_.at(hits.line) > Ints(-1);
  }

  /// The first surface that each ray meets.
  HWY_INLINE Hits nearest_hits(const Rays& rays, const Mask& wanted) const {
    return complete(rays, search(rays, infinity, wanted));
  }

  /// Whether each ray reaches a light of the scene, by its number: it meets
  /// nothing before `distance` but the light itself. A point light has no
  /// shape that could be met, so the search may stop at any shape.
  HWY_INLINE Mask reach(const Rays& rays, const Floats& distance,
                        std::int32_t light, const Mask& wanted) const {
    const auto& form = lights_[index(light)].form;
    if (geometry_.has_tree() && std::holds_alternative<PointLight>(form)) {
      return !occluded_one_by_one(rays, distance, wanted);
    }
    const First first = search(rays, distance, wanted);
    const Mask is_light = light_.at(first.line) == Ints(light);
    return is_light | !(first.distance < distance);
  }

  // ## One lane by itself

  Hit hit(const Hits& hits, int lane) const {
    Hit hit = hits_[index(hits.line[lane])];
    hit.distance = hits.distance[lane];
    hit.position = hits.position[lane];
    hit.normal = hits.normal[lane];
    hit.rounding = hits.rounding[lane];
    hit.diameter = hits.diameter[lane];
    return hit;
  }
  void set_ray(Rays& rays, int lane, const Ray& ray) const {
    rays.origin.set(lane, ray.origin);
    rays.direction.set(lane, ray.direction);
    rays.origin_slot.set(lane, ray.origin_slot == no_slot
                                   ? no_slot
                                   : lines_[index(ray.origin_slot)]);
    rays.self_hit_distance.set(lane, ray.self_hit_distance);
  }

 private:
  static std::size_t index(std::int32_t line) {
    return static_cast<std::size_t>(line);
  }

  // ## The table

  void add(const Plane& plane) {
    planes_.push_back(intersector_of(plane));
    add_line(plane.normal, plane.distance, Vec3(0));
    ++first_sphere_, ++first_flat_;
  }
  void add(const Sphere& sphere) {
    spheres_.push_back(intersector_of(sphere));
    add_line(sphere.center, sphere.radius, Vec3(0));
    ++first_flat_;
  }
  void add(const Rectangle& rectangle) {
    rectangles_.push_back(intersector_of(rectangle));
    add_line(rectangle.normal, 0, rectangle.corner);
  }
  void add(const Triangle& triangle) {
    triangles_.push_back(intersector_of(triangle));
    add_line(triangle.normal, 0, triangle.corner);
  }
  void add_line(const Vec3& vector, float size, const Vec3& corner) {
    vector_.push_back(vector);
    size_.push_back(size);
    corner_.push_back(corner);
  }

  // ## The search

  /// What the ray of each lane meets first before a limit.
  struct First {
    Floats distance;  ///< the limit where it meets nothing
    Ints line{0};
  };

  /// Rays through trees of boxes take different ways, so there each of them
  /// goes alone.
  HWY_INLINE First search(const Rays& rays, const Floats& limit,
                          const Mask& wanted) const {
    return geometry_.has_tree() ? search_one_by_one(rays, limit, wanted)
                                : search_together(rays, limit);
  }

  /// Where the rays meet the shape of a line. The one that a ray leaves is
  /// met again at a distance that the ray knows.
  template <class Form>
  static HWY_INLINE Floats distances(const Form& shape, std::int32_t line,
                                     const Rays& rays) {
    const Mask is_left = rays.origin_slot == line;
    return select(is_left, rays.self_hit_distance, shape.intersect(rays));
  }

  // #region together
  HWY_INLINE First search_together(const Rays& rays,
                                   const Floats& limit) const {
    First first{limit};
    std::int32_t line = 0;
    const auto consider = [&](const auto& shapes) HWY_ATTR {
      for (const auto& shape : shapes) {
        const Floats t = distances(shape, line, rays);
        const Mask nearer = (t > 0.0f) & (t < first.distance);
        first.distance = select(nearer, t, first.distance);
        first.line = select(nearer, Ints(line), first.line);
        ++line;
      }
    };
    consider(planes_);
    consider(spheres_);
    consider(rectangles_);
    consider(triangles_);
    return first;
  }
  // #endregion together

  LIGHTWALK_NOINLINE LIGHTWALK_FLATTEN First search_one_by_one(
      const Rays& rays, const Floats& limit, const Mask& wanted) const {
    First first{limit};
    for_each_ray(rays, wanted, [&](int lane, const Ray& ray) {
      const float end = limit[lane];
      const auto closest = geometry_.intersect(ray, end);
      if (!(closest.distance < end)) return;
      first.distance.set(lane, closest.distance);
      first.line.set(lane, lines_[index(closest.slot)]);
    });
    return first;
  }

  /// Whether each ray meets any shape before `distance`.
  LIGHTWALK_NOINLINE LIGHTWALK_FLATTEN Mask occluded_one_by_one(
      const Rays& rays, const Floats& distance, const Mask& wanted) const {
    unsigned occluded = 0;
    for_each_ray(rays, wanted, [&](int lane, const Ray& ray) {
      if (geometry_.occluded(ray, distance[lane])) occluded |= 1u << lane;
    });
    return mask_of(occluded);
  }

  /// Calls `use(lane, ray)` for each lane that is wanted, with its ray as the
  /// geometry knows it. The slots are looked up for all lanes at once.
  template <class Use>
  HWY_INLINE void for_each_ray(const Rays& rays, const Mask& wanted,
                               Use use) const {
    const Ints& line = rays.origin_slot;
    const Ints slot = select(line > Ints(no_slot),
                             slot_.at(max(line, Ints(0))), Ints(no_slot));
    for_each_lane(wanted, [&](int lane) {
      use(lane, Ray{rays.origin[lane], rays.direction[lane], slot[lane],
                    rays.self_hit_distance[lane]});
    });
  }

  // ## The hit
  //
  // Its place is worked out in double precision, as for one ray: see
  // `snap_to_surface` of each shape. A sphere's line has its center for a
  // vector.

  // #region complete
  HWY_INLINE Hits complete(const Rays& rays, const First& first) const {
    const Vec3s position = rays.origin + first.distance * rays.direction;
    const Vec3s vector = vector_.at(first.line);
    const Floats size = size_.at(first.line);
    Hits hits{.found = first.distance < infinity,
              .distance = first.distance,
              .position = position,
              .normal = vector,
              .rounding = flat_rounding * max_abs_component(position),
              .diameter = 0.0f,
              .line = first.line};
    const Floats step = min(2.0f * hits.rounding, 0.5f * first.distance);
    const Vec3s back = step * rays.direction;
    const Mask is_sphere = (first.line > Ints(first_sphere_ - 1)) &
                           (first.line < Ints(first_flat_));
    if (any(!is_sphere)) place_on_flat(size, back, hits);
    if (any(is_sphere)) {
      Hits round = hits;
      round.position = position;
      place_on_sphere(vector, size, back, round);
      hits.position = select(is_sphere, round.position, hits.position);
      hits.normal = select(is_sphere, round.normal, hits.normal);
      hits.rounding = select(is_sphere, 0.0f, hits.rounding);
      hits.diameter = select(is_sphere, 2.0f * size, 0.0f);
    }
    return hits;
  }
  // #endregion complete

  HWY_INLINE void place_on_flat(const Floats& size, const Vec3s& back,
                                Hits& hits) const {
    const DoubleVec3s normal = to_double(hits.normal);
    const DoubleVec3s x = to_double(hits.position - back);
    DoubleVec3s from_corner = x;
    if (!rectangles_.empty() || !triangles_.empty()) {
      from_corner = x - to_double(corner_.at(hits.line));
    }
    const Doubles height = dot(normal, from_corner) + to_double(size);
    hits.position = to_float(project_onto_plane(x, height, normal));
  }

  HWY_INLINE void place_on_sphere(const Vec3s& center, const Floats& radius,
                                  const Vec3s& back, Hits& hits) const {
    const DoubleVec3s c = to_double(center);
    const DoubleVec3s out = to_double(hits.position) - c;
    const DoubleVec3s normal =
        select(dot(out, out) > 0.0, normalize(out), DoubleVec3(0, 0, 1));
    hits.normal = to_float(normal);
    const Vec3s along = back - dot(back, hits.normal) * hits.normal;
    hits.position =
        to_float(c + to_double(radius) * normal - to_double(along));
  }

  const Geometry& geometry_;
  const std::deque<Light>& lights_;
  std::vector<PlaneIntersector<Vec3, float>> planes_;
  std::vector<SphereIntersector<Vec3, float>> spheres_;
  std::vector<FlatForm<Rectangle, Vec3, float>> rectangles_;
  std::vector<FlatForm<Triangle, Vec3, float>> triangles_;
  std::int32_t first_sphere_ = 0, first_flat_ = 0;

  Vec3Column vector_;   ///< a normal, or a sphere's center
  Column<float> size_;  ///< a plane's distance, a sphere's radius
  Vec3Column corner_;
  Column<std::int32_t> slot_, material_, light_;
  std::vector<Hit> hits_;            ///< what is the same in all of a line's
  std::vector<std::int32_t> lines_;  ///< the line of each slot
  std::vector<const Material*> materials_;
};

}  // namespace lightwalk

#endif
