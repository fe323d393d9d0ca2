#pragma once

// The [[shapes]] of a scene file.

#include <algorithm>
#include <iterator>
#include <string>

#include "common/scene_file/loaded_scene.hpp"
#include "common/scene_file/material_reader.hpp"
#include "common/scene_file/toml_reader.hpp"

namespace lightwalk {

/// Lengths from 1e-12 to 1e12 can be squared in a float.
inline constexpr float least_length = 1e-12f;

/// A vector's direction. The vector is scaled first, so no digit is lost.
inline Vec3 unit(const TomlTable& table, const char* key) {
  const Vec3 v = table.vector(key);
  const float size = max_abs_component(v);
  if (size == 0) {
    fail_at(table.at(key), table.label(key) + " must not be zero");
  }
  if (size < least_length) {
    fail_at(table.at(key), table.label(key) + " is shorter than 1e-12");
  }
  return normalize(v / size);
}

/// Adds shapes to a scene, and keeps their places in the file.
class ShapeReader {
 public:
  ShapeReader(const MaterialReader& materials, LoadedScene& loaded)
      : materials_(materials), loaded_(loaded) {}

  void read(const toml::node& node) {
    if (!node.is_table()) {
      fail_at(node, "a shape must be a table, not " + kind_of(node));
    }
    const toml::node* type = node.as_table()->get("type");
    if (!type) fail_at(node, "a shape needs 'type'");
    const std::string name = read_string(*type, "'type' of a shape");
    const auto found = std::ranges::find(shape_names, name);
    if (found == shape_names.end()) {
      fail_at(*type, "'type' of a shape: " + none_of(name, shape_names));
    }
    switch (static_cast<ShapeType>(found - shape_names.begin())) {
      case ShapeType::plane:
        return read_plane(node);
      case ShapeType::sphere:
        return read_sphere(node);
      case ShapeType::rectangle:
        return read_rectangle(node);
      case ShapeType::triangle:
        return read_triangle(node);
    }
  }

 private:
  void read_plane(const toml::node& node) {
    const TomlTable table(node, "a plane",
                          {"type", "normal", "distance", "material"});
    const glm::dvec3 normal = table.vector("normal");
    const Vec3 direction = unit(table, "normal");
    const double distance =
        static_cast<double>(table.number("distance")) / length(normal);
    if (!(std::abs(distance) <= 1e12)) {
      fail_at(node, "the plane is more than 1e12 away from the origin");
    }
    add(node, ShapeType::plane,
        Plane{direction, static_cast<float>(distance),
              materials_.named_by(table)});
  }

  void read_sphere(const toml::node& node) {
    const TomlTable table(node, "a sphere",
                          {"type", "center", "radius", "material"});
    const Vec3 center = table.vector("center");
    const float radius = table.number("radius");
    if (!(radius > 0)) {
      fail_at(table.at("radius"),
              table.label("radius") + " must be greater than 0");
    }
    if (radius < least_length) {
      fail_at(table.at("radius"),
              table.label("radius") + " is smaller than 1e-12");
    }
    add(node, ShapeType::sphere,
        Sphere{center, radius, materials_.named_by(table)});
  }

  void read_rectangle(const toml::node& node) {
    const TomlTable table(node, "a rectangle",
                          {"type", "corner", "edge_u", "edge_v", "material"});
    const Vec3 corner = table.vector("corner");
    unit(table, "edge_u");
    unit(table, "edge_v");
    const std::string what = "the rectangle's edges";
    const glm::dvec3 u = table.vector("edge_u"), v = table.vector("edge_v");
    if (!(length(glm::cross(u, v)) > 1e-6 * length(u) * length(v))) {
      fail_at(node, what + " lie on one line: they span no area");
    }
    const Rectangle rectangle(corner, table.vector("edge_u"),
                              table.vector("edge_v"),
                              materials_.named_by(table));
    check_area(node, what, rectangle);
    add(node, ShapeType::rectangle, rectangle);
  }

  void read_triangle(const toml::node& node) {
    const TomlTable table(node, "a triangle",
                          {"type", "vertices", "material"});
    const toml::node& list = table.at("vertices");
    const toml::array* array = list.as_array();
    if (!array || array->size() != 3) {
      fail_at(list, table.label("vertices") +
                        " must be three points, like [[0, 0, 0], [1, 0, 0], "
                        "[0, 1, 0]]");
    }
    Vec3 vertex[3];
    for (std::size_t i = 0; i < 3; ++i) {
      vertex[i] = read_vector(*array->get(i), "a vertex of a triangle");
    }
    const Material* material = materials_.named_by(table);
    const std::string what = "the triangle's vertices";
    const std::size_t first = first_corner(list, what, vertex, *material);
    const Vec3& corner = vertex[first];
    const Triangle triangle(corner, vertex[(first + 1) % 3] - corner,
                            vertex[(first + 2) % 3] - corner, material);
    check_area(list, what, triangle);
    add(node, ShapeType::triangle, triangle);
  }

  /// The vertex at which the edges start: the file's first, except for a
  /// needle. From a needle's tip the two edges are parallel but for rounding,
  /// so they start opposite its longest edge, whichever vertex is the first.
  /// A patterned needle keeps its first vertex: the pattern may follow edges.
  static std::size_t first_corner(const toml::node& node,
                                  const std::string& what,
                                  const Vec3 (&vertex)[3],
                                  const Material& material) {
    // In double precision, where neither squares nor rounding matter.
    const glm::dvec3 a = vertex[0], b = vertex[1], c = vertex[2];
    const double opposite[] = {length(c - b), length(a - c), length(b - a)};
    const auto longest =
        std::max_element(std::begin(opposite), std::end(opposite));
    const auto corner =
        static_cast<std::size_t>(longest - std::begin(opposite));
    const glm::dvec3 from = vertex[corner];
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(vertex[(corner + 1) % 3]) - from,
                   glm::dvec3(vertex[(corner + 2) % 3]) - from);
    const double height = length(normal) / *longest;
    if (!(height > 1e-7 * *longest)) {
      fail_at(node, what + " lie on one line: they span no area");
    }
    const bool patterned =
        material.varying_kd || material.varying_ks || material.varying_kt;
    return height > 1e-3 * *longest || patterned ? 0 : corner;
  }

  template <class Shape>
  void add(const toml::node& node, ShapeType type, const Shape& shape) {
    loaded_.scene.add(shape);
    const toml::source_position place = node.source().begin;
    loaded_.shape_places[type].push_back({place.line, place.column});
  }

  static void check_area(const toml::node& node, const std::string& what,
                         const FlatShape& flat) {
    if (!is_finite(flat.normal) || !is_finite(flat.dual_u()) ||
        !is_finite(flat.dual_v())) {
      fail_at(node, what + " span an area that is too small or too large");
    }
  }

  const MaterialReader& materials_;
  LoadedScene& loaded_;
};

}  // namespace lightwalk
