#pragma once

// # What a ray meets
//
// All shapes of a scene, each type by itself, and the two questions that a
// path tracer asks of them: which surface does this ray meet first, and is
// there anything between these two points? The second is easier, since any
// shape that is in the way will do, and it is asked for every light at every
// hit, so it is worth a function of its own.

#include <cstddef>
#include <optional>
#include <vector>

#include "common/flat.hpp"
#include "common/plane.hpp"
#include "common/ray.hpp"
#include "common/ray_count.hpp"
#include "common/sphere.hpp"

namespace lightwalk {

/// The shapes of one type, as they are and in packs of eight.
template <class Shape, class Pack>
class ShapeList {
 public:
  void add(const Shape& shape) {
    const int lane = static_cast<int>(shapes_.size() % lane_count);
    if (lane == 0) packs_.emplace_back();
    packs_.back().set(lane, shape);
    shapes_.push_back(shape);
  }

  const std::vector<Shape>& shapes() const { return shapes_; }
  const std::vector<Pack>& packs() const { return packs_; }

 private:
  std::vector<Shape> shapes_;
  std::vector<Pack> packs_;
};

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

  /// The first surface that the ray meets, if there is one.
  std::optional<Hit> nearest_hit(const Ray& ray) const {
    ++rays_cast;
    Nearest nearest;
    nearest.consider(planes_.packs(), ray);
    nearest.consider(spheres_.packs(), ray);
    nearest.consider(rectangles_.packs(), ray);
    nearest.consider(triangles_.packs(), ray);
    return hit_at(ray, nearest);
  }

  /// Whether nothing lies between two points, neither of them on a surface.
  bool visible(const Vec3& from, const Vec3& to) const {
    ++rays_cast;
    const Vec3 way = to - from;
    const float distance = length(way);
    const Ray ray{from, way / distance};
    return !(blocks(planes_.packs(), ray, distance) ||
             blocks(spheres_.packs(), ray, distance) ||
             blocks(rectangles_.packs(), ray, distance) ||
             blocks(triangles_.packs(), ray, distance));
  }

 private:
  /// For each of the eight lanes, the nearest hit so far and its pack,
  /// counted through all types in the order in which they are considered.
  struct Nearest {
    Float8 distance = broadcast(infinity);
    Int8 pack = broadcast(std::int32_t{-1});
    std::int32_t packs_seen = 0;

    template <class Pack>
    void consider(const std::vector<Pack>& packs, const Ray& ray) {
      for (const Pack& shapes : packs) {
        const Float8 t = shapes.intersect(ray);
        const Int8 nearer = (t > 0.0f) & (t < distance);
        distance = select(nearer, t, distance);
        pack = select(nearer, broadcast(packs_seen), pack);
        ++packs_seen;
      }
    }
  };

  template <class Pack>
  static bool blocks(const std::vector<Pack>& packs, const Ray& ray,
                     float distance) {
    for (const Pack& shapes : packs) {
      const Float8 t = shapes.intersect(ray);
      if (any((t > 0.0f) & (t < distance))) return true;
    }
    return false;
  }

  /// The nearest of the eight lanes, as a hit.
  std::optional<Hit> hit_at(const Ray& ray, const Nearest& nearest) const {
    const float distance = smallest(nearest.distance);
    if (!(distance < infinity)) return std::nullopt;
    const int lane = first_lane(nearest.distance == distance);
    Hit hit;
    hit.distance = distance;
    hit.position = ray.origin + distance * ray.direction;
    auto pack = static_cast<std::size_t>(nearest.pack[lane]);
    if (place(planes_, ShapeType::plane, pack, lane, hit) ||
        place(spheres_, ShapeType::sphere, pack, lane, hit) ||
        place(rectangles_, ShapeType::rectangle, pack, lane, hit)) {
      return hit;
    }
    place(triangles_, ShapeType::triangle, pack, lane, hit);
    return hit;
  }

  /// Completes the hit if the pack is one of this list's; otherwise makes
  /// `pack` count from the next list's first.
  template <class Shape, class Pack>
  static bool place(const ShapeList<Shape, Pack>& list, ShapeType type,
                    std::size_t& pack, int lane, Hit& hit) {
    if (pack >= list.packs().size()) {
      pack -= list.packs().size();
      return false;
    }
    const std::size_t index =
        pack * lane_count + static_cast<std::size_t>(lane);
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
