#pragma once

// # What a ray meets
//
// All shapes of a scene, each type by itself, and the two questions that a
// path tracer asks of them: which surface does this ray meet first, and is
// there anything between these two points? The second is easier, since any
// shape that is in the way will do, and it is asked for every light at every
// hit, so it is worth a function of its own.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "common/bounding_volume_hierarchy.hpp"
#include "common/compiler.hpp"
#include "common/flat.hpp"
#include "common/plane.hpp"
#include "common/ray.hpp"
#include "common/ray_count.hpp"
#include "common/sphere.hpp"

namespace lightwalk {

/// From this many shapes of a type on, they are kept in a tree of boxes.
inline constexpr std::size_t many_shapes = 64;

/// The shapes of one type, as they are and in packs of eight.
template <class Shape, class Pack>
class ShapeList {
 public:
  void add(const Shape& shape) {
    if (!tree_.empty()) forget_tree();
    shapes_.push_back(shape);
    add_to_packs(shapes_.size() - 1, shapes_.size() - 1);
  }

  /// Arranges the packs for fast search, if there are many shapes. Shapes
  /// that are added later undo it.
  void prepare() {
    if constexpr (!std::is_same_v<Shape, Plane>) {  // has no box
      if (shapes_.size() < many_shapes || !tree_.empty()) return;
      tree_ = BoundingVolumeHierarchy(shapes_, order_);
      packs_ = {};
      packs_.reserve(order_.size() / lane_count);
      for (std::size_t place = 0; place < order_.size(); ++place) {
        add_to_packs(place, order_[place]);
      }
    }
  }

  const std::vector<Shape>& shapes() const { return shapes_; }
  const std::vector<Pack>& packs() const { return packs_; }
  const BoundingVolumeHierarchy& tree() const { return tree_; }

  /// The index of the shape in a lane of a pack.
  std::size_t index(std::size_t pack, int lane) const {
    const std::size_t place =
        pack * lane_count + static_cast<std::size_t>(lane);
    return order_.empty() ? place : order_[place];
  }

 private:
  void add_to_packs(std::size_t place, std::size_t index) {
    const int lane = static_cast<int>(place % lane_count);
    if (lane == 0) packs_.emplace_back();
    if (index < shapes_.size()) packs_.back().set(lane, shapes_[index]);
  }

  void forget_tree() {
    tree_ = {};
    order_.clear();
    packs_.clear();
    for (std::size_t i = 0; i < shapes_.size(); ++i) add_to_packs(i, i);
  }

  std::vector<Shape> shapes_;
  std::vector<Pack> packs_;
  BoundingVolumeHierarchy tree_;
  std::vector<std::uint32_t> order_;  ///< of the shapes in the packs
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
    Nearest nearest;
    nearest.consider(planes_, ray);
    nearest.consider(spheres_, ray);
    nearest.consider(rectangles_, ray);
    nearest.consider(triangles_, ray);
    return hit_at(ray, nearest);
  }

  /// Whether nothing lies between two points, neither of them on a surface.
  bool visible(const Vec3& from, const Vec3& to) const {
    ++rays_cast;
    const Vec3 way = to - from;
    const float distance = length(way);
    const Ray ray{from, way / distance};
    return !(blocks(planes_, ray, distance) ||
             blocks(spheres_, ray, distance) ||
             blocks(rectangles_, ray, distance) ||
             blocks(triangles_, ray, distance));
  }

 private:
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
    const std::size_t index = list.index(pack, lane);
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
