#pragma once

// # Shapes in one place
//
// Where two surfaces are in the same place, one of them must be first.
// Rectangles and triangles that shine, and those of glass, are set apart when
// a scene is made (common/scene/scene.hpp). So space has layers there: what
// only reflects in the middle, on each side of it a lamp that shines to that
// side, and beyond the lamp glass that is on that side. Two surfaces in the
// same layer are left to rounding, and a warning says so.
//
// Two flat shapes overlap unless one of them has an edge with all of the
// other beyond it. Those whose boxes meet are tried, which a tree finds.
// Spheres are in the same place if center and radius are equal.

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "common/scene_file/loaded_scene.hpp"

namespace lightwalk {

/// Finds the shapes of a scene that are in the same place and layer.
class CoincidentShapes {
 public:
  explicit CoincidentShapes(const LoadedScene& loaded) : loaded_(loaded) {
    const Geometry& geometry = loaded.scene.geometry;
    add_faces(geometry.rectangles(), ShapeType::rectangle);
    add_faces(geometry.triangles(), ShapeType::triangle);
    // Enough but for scenes that are made to take long.
    tests_left_ += 100 * static_cast<long>(faces_.size());
    compare_spheres(geometry.spheres());
    compare_planes(geometry.planes());
    compare_faces();
  }

  /// A warning of the first pair, from its line on.
  std::optional<std::string> warning() const {
    if (found_.empty()) return std::nullopt;
    const auto& [place, pair] = *found_.begin();
    std::string text =
        std::to_string(place.line) + ':' + std::to_string(place.column) +
        ": warning: the " + name(pair.type) +
        " is in the same place as the " + name(pair.other_type) +
        " in line " + std::to_string(pair.other.line) +
        (pair.shine_as_one
             ? ": they shine as one, not as two"
             : ": which of them a ray meets is left to rounding") +
        "; move one of them";
    const std::size_t more = found_.size() - 1;
    if (more > 0) text += " (and " + std::to_string(more) + " more)";
    return text;
  }

 private:
  /// What is asked of a shape of any type.
  struct Surface {
    ShapeType type{};
    std::size_t index = 0;
    const Material* material = nullptr;
    Vec3 normal{0};
    int layer = 0;                  ///< in front of its place
    std::array<Vec3, 3> corners{};  ///< where they are equal, so are all uv
  };
  /// A rectangle or a triangle, where the file has it.
  struct Face : Surface {
    std::array<Vec3, 4> vertices{};  ///< a triangle has its third one twice
    Vec3 size{0};
    float height = 0,
          way = 0;  ///< what its rounding depends on, as in step_apart
  };
  struct Pair {
    ShapeType type, other_type;
    LineAndColumn other;
    bool shine_as_one;
  };

  static std::string name(ShapeType type) {
    const char* names[] = {"plane", "sphere", "rectangle", "triangle"};
    return names[static_cast<std::size_t>(type)];
  }

  template <class Shape>
  void add_faces(const std::vector<Shape>& shapes, ShapeType type) {
    const Vec3 eye = loaded_.scene.camera.origin;
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const Shape& shape = shapes[i];
      const Material& material = *shape.material;
      const Vec3 a = shape.corner - step_apart(shape, eye);
      const Vec3 b = a + shape.edge_u, c = a + shape.edge_v;
      const Vec3 edges = glm::abs(shape.edge_u) + glm::abs(shape.edge_v);
      Face& face = faces_.emplace_back();
      face.type = type;
      face.index = i;
      face.material = &material;
      face.normal = shape.normal;
      face.vertices = {a, b, c, c};
      face.layer = material.emits() ? 1 : material.refracts() ? -2 : 0;
      face.corners = {a, b, c};
      if (type == ShapeType::rectangle) face.vertices[2] += shape.edge_u;
      face.size = glm::abs(a) + edges;
      face.height = dot(glm::abs(shape.normal), face.size);
      face.way = max_component(edges + glm::abs(a - eye));
    }
  }
  friend Bounds bounds(const Face& face) {
    Bounds box;
    for (const Vec3& vertex : face.vertices) box.include(vertex);
    return widened(box);
  }

  // ## Where they are

  void compare_spheres(const std::vector<Sphere>& spheres) {
    std::vector<Surface> sorted;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
      sorted.push_back({ShapeType::sphere, i, spheres[i].material});
    }
    const auto key = [&](const Surface& surface) {
      const Sphere& s = spheres[surface.index];
      return std::tuple(s.center.x, s.center.y, s.center.z, s.radius,
                        surface.index);
    };
    std::sort(sorted.begin(), sorted.end(),
              [&](const auto& a, const auto& b) { return key(a) < key(b); });
    const Surface* first = nullptr;  // of those in the same place
    for (const Surface& next : sorted) {
      if (first &&
          spheres[first->index].center == spheres[next.index].center &&
          spheres[first->index].radius == spheres[next.index].radius) {
        if (matters(*first, next)) note(*first, next);
      } else {
        first = &next;
      }
    }
  }

  void compare_planes(const std::vector<Plane>& planes) {
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const Plane& plane = planes[i];
      const auto surface = [&](std::size_t index) {
        const Plane& p = planes[index];
        return Surface{ShapeType::plane, index, p.material,
                       p.normal,         0,     {p.normal}};
      };
      for (std::size_t j = 0; j < i && tests_left_-- > 0; ++j) {
        const Plane& other = planes[j];
        const float side = dot(plane.normal, other.normal) < 0 ? -1.0f : 1.0f;
        const float most = 2 * flat_rounding * std::abs(plane.distance);
        if (max_abs_component(plane.normal - side * other.normal) <=
                2 * flat_rounding &&
            std::abs(plane.distance - side * other.distance) <= most) {
          if (matters(surface(i), surface(j))) note(surface(i), surface(j));
        }
      }
      for (const Face& face : faces_) {
        if (tests_left_-- <= 0) return;
        const float most = flat_rounding * (std::abs(plane.distance) +
                                            face.height + face.way);
        if (within(plane.normal, -plane.distance, face, most) &&
            matters(surface(i), face)) {
          note(surface(i), face);
        }
      }
    }
  }

  void compare_faces() {
    if (faces_.empty()) return;
    std::vector<std::uint32_t> order;
    const BoundingVolumeHierarchy tree(faces_, order);
    std::vector<Face> sorted(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (order[i] < faces_.size()) sorted[i] = faces_[order[i]];
    }
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      const Face& face = sorted[i];
      if (!face.material || tests_left_ <= 0) continue;
      bool found = false;
      tree.visit_near(bounds(face), [&](std::size_t pack) {
        const std::size_t end = std::min(i, (pack + 1) * lane_count);
        for (std::size_t j = pack * lane_count; j < end && !found; ++j) {
          const Face& other = sorted[j];
          if (!other.material || tests_left_-- <= 0) continue;
          found = parallel(face, other) && matters(face, other) &&
                  in_one_plane(face, other) && !beyond_an_edge(face, other) &&
                  !beyond_an_edge(other, face);
          if (found) note(face, other);
        }
        return !found && tests_left_ > 0;
      });
    }
  }

  /// Whether all of the face is so close to where normal . x = height.
  static bool within(const Vec3& normal, float height, const Face& face,
                     float most) {
    return std::all_of(face.vertices.begin(), face.vertices.end(),
                       [&](const Vec3& x) {
                         return std::abs(dot(normal, x) - height) <= most;
                       });
  }

  static bool parallel(const Face& a, const Face& b) {
    return std::abs(dot(a.normal, b.normal)) > 0.99f;
  }

  static bool in_one_plane(const Face& a, const Face& b) {
    const float most =
        flat_rounding * (a.height + b.height + std::min(a.way, b.way));
    return within(a.normal, dot(a.normal, a.vertices[0]), b, most) ||
           within(b.normal, dot(b.normal, b.vertices[0]), a, most);
  }

  /// Whether an edge of `a` has all of `b` beyond it, but for rounding.
  static bool beyond_an_edge(const Face& a, const Face& b) {
    const float over =
        2 * flat_rounding * max_component(glm::max(a.size, b.size));
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3& from = a.vertices[i];
      const Vec3 edge = a.vertices[(i + 1) % 4] - from;
      if (edge == Vec3(0)) continue;
      const Vec3 out = normalize(cross(edge, a.normal));
      if (std::all_of(
              b.vertices.begin(), b.vertices.end(),
              [&](const Vec3& x) { return dot(out, x - from) >= -over; })) {
        return true;
      }
    }
    return false;
  }

  // ## What they are

  /// Whether it matters which of the two is first, and is not said.
  static bool matters(const Surface& a, const Surface& b) {
    const bool same_side = dot(a.normal, b.normal) >= 0;
    if (same_side && a.material->refracts() && b.material->refracts()) {
      return true;  // twice into glass, or twice out of it
    }
    return a.layer == (same_side ? b.layer : -b.layer) && !look_alike(a, b);
  }

  void note(const Surface& a, const Surface& b) {
    const auto place = [&](const Surface& s) {
      return loaded_.shape_places.at(s.type)[s.index];
    };
    const bool in_order = place(b) < place(a);
    const Surface &later = in_order ? a : b, &earlier = in_order ? b : a;
    const bool shine_as_one = a.material->emits() &&
                              a.material->ke == b.material->ke &&
                              dot(a.normal, b.normal) >= 0;
    const Pair pair{later.type, earlier.type, place(earlier), shine_as_one};
    Pair& kept = found_.emplace(place(later), pair).first->second;
    if (pair.other < kept.other) kept = pair;
  }

  /// Whether a ray sees the same, whichever of the two it meets.
  static bool look_alike(const Surface& a, const Surface& b) {
    const Material &m = *a.material, &n = *b.material;
    if (m.emits() || n.emits() || m.refracts() || n.refracts()) return false;
    bool over_uv = false, varies = false;
    for (const auto* pattern :
         {m.varying_kd, m.varying_ks, n.varying_kd, n.varying_ks}) {
      if (!pattern) continue;
      varies = true;
      over_uv |= pattern->type == VaryingType::image ||
                 pattern->type == VaryingType::checker;
    }
    if (&m == &n) return !over_uv || a.corners == b.corners;
    return !varies && m.kd == n.kd && m.ks == n.ks && m.fresnel == n.fresnel;
  }

  const LoadedScene& loaded_;
  std::vector<Face> faces_;
  std::map<LineAndColumn, Pair> found_;  ///< by the place of the later one
  long tests_left_ = 1'000'000;
};

/// A warning if shapes of the scene are in the same place and it is not said
/// which of them is first; it begins with a line and a column.
inline std::optional<std::string> coincident_shapes(
    const LoadedScene& loaded) {
  return CoincidentShapes(loaded).warning();
}

}  // namespace lightwalk
