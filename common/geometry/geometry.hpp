#pragma once

// # What a ray meets
//
// All shapes of a scene, each type by itself, and the two questions that a
// path tracer asks of them: which surface does this ray meet first, and does
// it reach that lamp? The second may stop at any shape that is in the way,
// and need not look beyond the lamp. It is asked for every light at every
// hit, so it is worth a function of its own.
//
// Shapes stand in slots, eight to a pack. The slots are counted through all
// types, in the order planes, spheres, rectangles, triangles. A ray that
// leaves a shape carries its slot.

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "common/geometry/bounds.hpp"
#include "common/geometry/inlining.hpp"
#include "common/geometry/plane.hpp"
#include "common/geometry/ray.hpp"
#include "common/geometry/rectangle_and_triangle.hpp"
#include "common/geometry/shape_list.hpp"
#include "common/geometry/sphere.hpp"

namespace lightwalk {

class Geometry {
  using Planes = ShapeList<Plane, PlanePack>;
  using Spheres = ShapeList<Sphere, SpherePack>;
  using Rectangles = ShapeList<Rectangle, FlatPack<Rectangle>>;
  using Triangles = ShapeList<Triangle, FlatPack<Triangle>>;

 public:
  void add(const Plane& plane) { list<Planes>().add(plane); }
  void add(const Sphere& sphere) { list<Spheres>().add(sphere); }
  void add(const Rectangle& one) { list<Rectangles>().add(one); }
  void add(const Triangle& triangle) { list<Triangles>().add(triangle); }

  const std::vector<Plane>& planes() const { return list<Planes>().shapes(); }
  const std::vector<Sphere>& spheres() const {
    return list<Spheres>().shapes();
  }
  const std::vector<Rectangle>& rectangles() const {
    return list<Rectangles>().shapes();
  }
  const std::vector<Triangle>& triangles() const {
    return list<Triangles>().shapes();
  }
  std::size_t size() const {
    return planes().size() + spheres().size() + rectangles().size() +
           triangles().size();
  }

  /// Sorts many shapes into trees. Without trees an answer takes time in
  /// proportion to the number of shapes. The answers are the same, except
  /// where rounding decides: for a ray that grazes a shape, or meets two at
  /// the same distance.
  void prepare() {
    std::apply([](auto&... list) { (list.prepare(), ...); }, lists_);
  }

  /// Calls `use(shape, hit)` for each shape, in the order of the slots.
  /// `hit` has the members that are the same in all hits of the shape.
  template <class Use>
  void for_each_shape(Use use) const {
    Hit hit{};
    std::int32_t first = 0;
    const auto use_all = [&](const auto& list) {
      for (std::size_t slot = 0; slot < list.slot_count(); ++slot) {
        const std::size_t index = list.index(slot);
        if (index >= list.shapes().size())
          continue;  // a lane that is not set
        hit.slot = first + static_cast<std::int32_t>(slot);
        hit.shape_index = static_cast<std::uint32_t>(index);
        hit.material = list.shapes()[index].material;
        hit.light = list.shapes()[index].light;
        use(list.shapes()[index], hit);
      }
      first += static_cast<std::int32_t>(list.slot_count());
      hit.shape_type =
          static_cast<ShapeType>(static_cast<int>(hit.shape_type) + 1);
    };
    std::apply([&](const auto&... list) { (use_all(list), ...); }, lists_);
  }

  /// Whether there are so many shapes of a type that a tree is searched.
  bool has_tree() const {
    return std::apply(
        [](const auto&... list) { return (!list.tree().empty() || ...); },
        lists_);
  }

  /// The first of the shapes that a ray meets.
  struct Closest {
    float distance;     ///< the search's limit if the ray meets nothing
    std::int32_t slot;  ///< meaningless if the ray meets nothing
  };

  /// The shape that the ray meets first, nearer than `limit`. The ray's
  /// direction must be a unit vector, here and below.
  Closest intersect(const Ray& ray, float limit) const {
    Nearest nearest(limit);
    std::apply(
        [&](const auto&... list) { (nearest.consider(list, ray), ...); },
        lists_);
    return nearest.closest();
  }

  /// The first surface that the ray meets, if there is one.
  std::optional<Hit> nearest_hit(const Ray& ray) const {
    const Closest closest = intersect(ray, infinity);
    if (!(closest.distance < infinity)) return std::nullopt;
    return hit_at(ray, closest);
  }

  /// Whether the ray meets any surface before `distance`.
  bool occluded(const Ray& ray, float distance) const {
    return std::apply(
        [&, seen = std::int32_t{0}](const auto&... list) mutable {
          return (occludes(list, ray, distance, seen) || ...);
        },
        lists_);
  }

  /// Whether the ray meets nothing before `distance` but the lamp, which lies
  /// there up to rounding.
  bool reaches(const Ray& ray, float distance, const Light& lamp) const {
    const Closest closest = intersect(ray, distance);
    if (!(closest.distance < distance)) return true;
    return hit_at(ray, closest).light == &lamp;
  }

 private:
  template <class List>
  List& list() {
    return std::get<List>(lists_);
  }
  template <class List>
  const List& list() const {
    return std::get<List>(lists_);
  }

  /// Where the ray meets the shapes of a pack. It meets the shape that it
  /// leaves again at `self_hit_distance`.
  template <class Pack>
  static Float8 distances(const Pack& pack, std::int32_t number,
                          const Ray& ray) {
    Float8 t = pack.intersect(ray);
    if (ray.origin_slot >> 3 == number)
      t[ray.origin_slot & 7] = ray.self_hit_distance;
    return t;
  }
  static_assert(lane_count == 8);

  // #region nearest
  /// For each of the eight lanes, the nearest hit so far and its pack,
  /// counted through all types in the order in which they are considered.
  struct Nearest {
    Float8 distance;
    Int8 nearest_pack = broadcast(std::int32_t{-1});
    std::int32_t packs_seen = 0;

    explicit Nearest(float limit) : distance(broadcast(limit)) {}

    template <class Shape, class Pack>
    void consider(const ShapeList<Shape, Pack>& list, const Ray& ray) {
      if (!list.tree().empty()) return consider_tree(list, ray);
      for (const Pack& pack : list.packs()) {
        consider(distances(pack, packs_seen, ray), packs_seen);
        ++packs_seen;
      }
    }

    /// The nearest of the lanes; of equally near ones the first shape.
    Closest closest() const {
      Closest found{smallest(distance), packs_seen * lane_count};
      unsigned lanes = lanes_of(distance == found.distance);
      for (; lanes != 0; lanes &= lanes - 1) {
        const int lane = std::countr_zero(lanes);
        const std::int32_t slot = nearest_pack[lane] * lane_count + lane;
        found.slot = std::min(found.slot, slot);
      }
      return found;
    }

    void consider(const Float8& t, std::int32_t this_pack) {
      const Int8 nearer = (t > 0.0f) & (t < distance);
      distance = select(nearer, t, distance);
      nearest_pack = select(nearer, broadcast(this_pack), nearest_pack);
    }

    template <class Shape, class Pack>
    LIGHTWALK_NOINLINE LIGHTWALK_FLATTEN void consider_tree(
        const ShapeList<Shape, Pack>& list, const Ray& ray) {
      float end = smallest(distance);
      list.tree().walk(ray, end, [&](std::uint32_t i) {
        const std::int32_t number = packs_seen + static_cast<std::int32_t>(i);
        const Float8 t = distances(list.packs()[i], number, ray);
        if (any((t > 0.0f) & (t < end))) {
          consider(t, number);
          end = smallest(distance);
        }
        return end;
      });
      packs_seen += static_cast<std::int32_t>(list.packs().size());
    }
  };
  // #endregion nearest

  template <class Shape, class Pack>
  static bool occludes(const ShapeList<Shape, Pack>& list, const Ray& ray,
                       float distance, std::int32_t& packs_seen) {
    const std::int32_t first = packs_seen;
    packs_seen += static_cast<std::int32_t>(list.packs().size());
    if (!list.tree().empty()) {
      return tree_occludes(list, ray, distance, first);
    }
    for (std::int32_t i = first; i < packs_seen; ++i) {
      const Pack& pack = list.packs()[static_cast<std::size_t>(i - first)];
      const Float8 t = distances(pack, i, ray);
      if (any((t > 0.0f) & (t < distance))) return true;
    }
    return false;
  }

  template <class Shape, class Pack>
  LIGHTWALK_NOINLINE LIGHTWALK_FLATTEN static bool tree_occludes(
      const ShapeList<Shape, Pack>& list, const Ray& ray, float distance,
      std::int32_t first) {
    bool occluded = false;
    list.tree().walk(ray, distance, [&](std::uint32_t i) {
      const std::int32_t number = first + static_cast<std::int32_t>(i);
      const Float8 t = distances(list.packs()[i], number, ray);
      occluded = any((t > 0.0f) & (t < distance));
      return occluded ? -1 : distance;  // nothing matters any more
    });
    return occluded;
  }

  /// The shape that the ray meets, as a hit.
  Hit hit_at(const Ray& ray, const Closest& closest) const {
    Hit hit;
    hit.distance = closest.distance;
    hit.slot = closest.slot;
    hit.position = ray.origin + closest.distance * ray.direction;
    hit.rounding = flat_rounding * max_abs_component(hit.position);
    // A step back, longer than rounding may have moved it past a surface.
    const float step = std::min(2 * hit.rounding, 0.5f * closest.distance);
    const Vec3 back = step * ray.direction;
    auto slot = static_cast<std::size_t>(closest.slot);
    [[maybe_unused]] const bool found =
        complete<Planes>(ShapeType::plane, slot, back, hit) ||
        complete<Spheres>(ShapeType::sphere, slot, back, hit) ||
        complete<Rectangles>(ShapeType::rectangle, slot, back, hit) ||
        complete<Triangles>(ShapeType::triangle, slot, back, hit);
    assert(found);
    return hit;
  }

  /// Completes the hit if it is in one of this list's slots; otherwise makes
  /// `slot` count from the next list's first.
  template <class List>
  bool complete(ShapeType type, std::size_t& slot, const Vec3& back,
                Hit& hit) const {
    if (slot >= list<List>().slot_count()) {
      slot -= list<List>().slot_count();
      return false;
    }
    const std::size_t index = list<List>().index(slot);
    const auto& shape = list<List>().shapes()[index];
    hit.shape_type = type;
    hit.shape_index = static_cast<std::uint32_t>(index);
    hit.material = shape.material;
    hit.light = shape.light;
    snap_to_surface(shape, back, hit);
    return true;
  }

  std::tuple<Planes, Spheres, Rectangles, Triangles> lists_;
};

}  // namespace lightwalk
