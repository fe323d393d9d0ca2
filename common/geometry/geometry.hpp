#pragma once

// # What a ray meets
//
// All shapes of a scene, each type by itself, and the two questions that a
// path tracer asks of them: which surface does this ray meet first, and is
// there anything between these two points? The second is easier, since any
// shape that is in the way will do, and it is asked for every light at every
// hit, so it is worth a function of its own.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "common/geometry/inlining.hpp"
#include "common/geometry/path_group.hpp"
#include "common/geometry/plane.hpp"
#include "common/geometry/ray.hpp"
#include "common/geometry/ray_count.hpp"
#include "common/geometry/rectangle_and_triangle.hpp"
#include "common/geometry/shape_list.hpp"
#include "common/geometry/sphere.hpp"

namespace lightwalk {

class Geometry {
 public:
  void add(const Plane& plane) { planes_.add(plane); }
  void add(const Sphere& sphere) { spheres_.add(sphere); }
  void add(const Rectangle& rectangle) { rectangles_.add(rectangle); }
  void add(const Triangle& triangle) { triangles_.add(triangle); }

  const std::vector<Plane>& planes() const { return planes_.shapes(); }
  const std::vector<Sphere>& spheres() const { return spheres_.shapes(); }
  const std::vector<Rectangle>& rectangles() const {
    return rectangles_.shapes();
  }
  const std::vector<Triangle>& triangles() const {
    return triangles_.shapes();
  }
  std::size_t size() const {
    return planes().size() + spheres().size() + rectangles().size() +
           triangles().size();
  }

  /// Sorts many shapes into boxes. Without it every answer is the same, and
  /// takes time in proportion to the number of shapes.
  void prepare() {
    spheres_.prepare();
    rectangles_.prepare();
    triangles_.prepare();
  }

  /// The first surface that the ray meets, if there is one.
  std::optional<Hit> nearest_hit(const Ray& ray) const {
    ++rays_cast;
    return hit_at(ray, path_group ? path_group->meet(ray) : meet(ray));
  }

  /// Whether nothing lies between two points, neither of them on a surface.
  bool visible(const Vec3& from, const Vec3& to) const {
    ++rays_cast;
    const Vec3 way = to - from;
    const float distance = length(way);
    const Ray ray{from, normalize(way)};
    if (path_group) return !(path_group->meet(ray).distance < distance);
    return !blocked(ray, distance);
  }

  /// Runs `work`, which follows paths until none is left. Where the shapes
  /// are so few that every ray meets every shape, it is run sixteen times, in
  /// turns; otherwise once.
  void follow_paths(const std::function<void()>& work) const {
    if (!spheres_.tree().empty() || !rectangles_.tree().empty() ||
        !triangles_.tree().empty()) {
      return work();
    }
    run_in_turns(work, [this](RayPacket& packet) { meet(packet); });
  }

  // #region meet-packet
  /// What each of a packet's rays meets: the same, to the bit, as one ray by
  /// itself.
  LIGHTWALK_APART void meet(RayPacket& packet) const {
    for (RayPacket::Row& row : packet.rows) {
      row.distance = broadcast(infinity);
    }
    std::int32_t first = 0;
    meet(planes_, first, packet);
    meet(spheres_, first, packet);
    meet(rectangles_, first, packet);
    meet(triangles_, first, packet);
  }

 private:
  template <class Shape, class Pack>
  static void meet(const ShapeList<Shape, Pack>& list, std::int32_t& first,
                   RayPacket& packet) {
    const auto count = static_cast<std::int32_t>(list.shapes().size());
    const Pack* const packs = list.packs().data();
    for (std::int32_t i = 0; i < count; ++i) {
      const auto shape = packs[i / lane_count].one(i % lane_count);
      for (RayPacket::Row& row : packet.rows) {
        const Float8 t = shape.intersect(row.rays);
        const Int8 nearer = (t > 0.0f) & (t < row.distance);
        row.distance = select(nearer, t, row.distance);
        row.place = select(nearer, broadcast(first + i), row.place);
      }
    }
    first += static_cast<std::int32_t>(list.place_count());
  }
  // #endregion meet-packet

  /// For each of the eight lanes, the nearest hit so far and its pack,
  /// counted through all types in the order in which they are considered.
  struct Nearest {
    Float8 distance = broadcast(infinity);
    Int8 pack = broadcast(std::int32_t{-1});
    std::int32_t packs_seen = 0;

    template <class Shape, class Pack>
    void consider(const ShapeList<Shape, Pack>& list, const Ray& ray) {
      if (!list.tree().empty()) return consider_tree(list, ray);
      for (const Pack& shapes : list.packs()) {
        consider(shapes.intersect(ray), packs_seen);
        ++packs_seen;
      }
    }

    /// The nearest of the lanes; of equally near ones the first shape.
    FirstShape first() const {
      FirstShape found{smallest(distance), packs_seen * lane_count};
      unsigned lanes = lanes_of(distance == found.distance);
      for (; lanes != 0; lanes &= lanes - 1) {
        const int lane = std::countr_zero(lanes);
        found.place = std::min(found.place, pack[lane] * lane_count + lane);
      }
      return found;
    }

    void consider(const Float8& t, std::int32_t this_pack) {
      const Int8 nearer = (t > 0.0f) & (t < distance);
      distance = select(nearer, t, distance);
      pack = select(nearer, broadcast(this_pack), pack);
    }

    template <class Shape, class Pack>
    LIGHTWALK_APART void consider_tree(const ShapeList<Shape, Pack>& list,
                                       const Ray& ray) {
      float end = smallest(distance);
      list.tree().walk(ray, end, [&](std::uint32_t i) {
        const Float8 t = list.packs()[i].intersect(ray);
        if (any((t > 0.0f) & (t < end))) {
          consider(t, packs_seen + static_cast<std::int32_t>(i));
          end = smallest(distance);
        }
        return end;
      });
      packs_seen += static_cast<std::int32_t>(list.packs().size());
    }
  };

  template <class Shape, class Pack>
  static bool blocks(const ShapeList<Shape, Pack>& list, const Ray& ray,
                     float distance) {
    if (!list.tree().empty()) return tree_blocks(list, ray, distance);
    for (const Pack& shapes : list.packs()) {
      const Float8 t = shapes.intersect(ray);
      if (any((t > 0.0f) & (t < distance))) return true;
    }
    return false;
  }

  template <class Shape, class Pack>
  LIGHTWALK_APART static bool tree_blocks(const ShapeList<Shape, Pack>& list,
                                          const Ray& ray, float distance) {
    bool blocked = false;
    list.tree().walk(ray, distance, [&](std::uint32_t i) {
      const Float8 t = list.packs()[i].intersect(ray);
      blocked = any((t > 0.0f) & (t < distance));
      return blocked ? -1 : distance;  // nothing matters any more
    });
    return blocked;
  }

  /// What one ray meets, and what it needs no packet for: it meets a whole
  /// pack of shapes at once.
  LIGHTWALK_APART FirstShape meet(const Ray ray) const {
    Nearest nearest;
    nearest.consider(planes_, ray);
    nearest.consider(spheres_, ray);
    nearest.consider(rectangles_, ray);
    nearest.consider(triangles_, ray);
    return nearest.first();
  }

  /// Whether the ray meets anything before `distance`.
  LIGHTWALK_APART bool blocked(const Ray ray, float distance) const {
    return blocks(planes_, ray, distance) ||
           blocks(spheres_, ray, distance) ||
           blocks(rectangles_, ray, distance) ||
           blocks(triangles_, ray, distance);
  }

  /// The shape that the ray meets, as a hit.
  std::optional<Hit> hit_at(const Ray& ray, const FirstShape& first) const {
    if (!(first.distance < infinity)) return std::nullopt;
    Hit hit;
    hit.distance = first.distance;
    hit.position = ray.origin + first.distance * ray.direction;
    auto place = static_cast<std::size_t>(first.place);
    if (complete(planes_, ShapeType::plane, place, hit) ||
        complete(spheres_, ShapeType::sphere, place, hit) ||
        complete(rectangles_, ShapeType::rectangle, place, hit)) {
      return hit;
    }
    complete(triangles_, ShapeType::triangle, place, hit);
    return hit;
  }

  /// Completes the hit if it is at one of this list's places; otherwise makes
  /// `place` count from the next list's first.
  template <class Shape, class Pack>
  static bool complete(const ShapeList<Shape, Pack>& list, ShapeType type,
                       std::size_t& place, Hit& hit) {
    if (place >= list.place_count()) {
      place -= list.place_count();
      return false;
    }
    const std::size_t index = list.index(place);
    const Shape& shape = list.shapes()[index];
    hit.shape_type = type;
    hit.shape_index = static_cast<std::uint32_t>(index);
    hit.material = shape.material;
    place_hit(shape, hit);
    return true;
  }

  ShapeList<Plane, PlanePack> planes_;
  ShapeList<Sphere, SpherePack> spheres_;
  ShapeList<Rectangle, FlatPack<Rectangle>> rectangles_;
  ShapeList<Triangle, FlatPack<Triangle>> triangles_;
};

}  // namespace lightwalk
