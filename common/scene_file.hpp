#pragma once

// Scene files: TOML in, a Scene out, or a SceneError that says what is wrong,
// in which line and column, and what was expected. The format is described in
// scenes/README.md and, for editors, in scenes/scene.schema.json.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <string>

#include "common/loaded_scene.hpp"
#include "common/render_settings.hpp"
#include "common/scene.hpp"
#include "common/sha256.hpp"
#include "common/srgb.hpp"
#include "common/syllabus.hpp"
#include "common/texture_file.hpp"
#include "common/toml_reader.hpp"

namespace lightwalk {

class SceneReader {
 public:
  /// Textures are looked for from `folder` on, that of the scene file.
  SceneReader(const Syllabus& syllabus, std::string folder)
      : syllabus_(syllabus), folder_(std::move(folder)) {}

  LoadedScene read(const toml::table& root) {
    const TomlTable file(
        root, "the scene",
        {"camera", "render", "materials", "shapes", "lights"});
    read_camera(file.at("camera"));
    if (const auto* render = file.find("render")) read_render(*render);
    if (const auto* node = file.find("materials")) read_materials(*node);
    for_each(file, "shapes", "shape",
             [&](const toml::node& node) { read_shape(node); });
    for_each(file, "lights", "light",
             [&](const toml::node& node) { read_light(node); });
    if (loaded_.scene.geometry.size() == 0) {
      fail_at(root, "the scene has no [[shapes]]");
    }
    loaded_.scene.geometry.prepare();
    return std::move(loaded_);
  }

 private:
  /// Refuses what a later stage introduces.
  void require(std::string_view word, const toml::source_region& place,
               const std::string& message) const {
    if (const auto stage = syllabus_.still_to_come(word)) {
      fail_at(place, message + ", which stage " + std::to_string(*stage) +
                         " introduces");
    }
  }

  template <class Read>
  static void for_each(const TomlTable& file, const char* key,
                       const std::string& one, Read read) {
    const toml::node* node = file.find(key);
    if (!node) return;
    const toml::array* array = node->as_array();
    if (!array) {
      fail_at(*node, "'" + std::string(key) + "' must be written [[" + key +
                         "]], once for each " + one);
    }
    for (const toml::node& element : *array) read(element);
  }

  void read_camera(const toml::node& node) {
    const TomlTable table(node, "[camera]",
                          {"origin", "left", "up", "forward", "size"});
    Camera& camera = loaded_.scene.camera;
    camera.origin = table.vector("origin");
    camera.left = table.vector("left");
    camera.up = table.vector("up");
    camera.forward = table.vector("forward");
    const Vec3 across = cross(unit(table, "left"), unit(table, "up"));
    if (std::abs(dot(across, unit(table, "forward"))) < 1e-6f) {
      fail_at(node,
              "'left', 'up' and 'forward' of [camera] must not lie in "
              "one plane");
    }
    if (const toml::node* size = table.find("size")) {
      const toml::array* array = size->as_array();
      if (!array || array->size() != 2) {
        fail_at(*size, table.label("size") +
                           " must be [columns, rows], like [256, 256]");
      }
      camera.width =
          read_integer(*array->get(0), "the number of columns", 1, 65536);
      camera.height =
          read_integer(*array->get(1), "the number of rows", 1, 65536);
    }
  }

  void read_render(const toml::node& node) {
    const TomlTable table(node, "[render]",
                          {"samples_per_pixel", "max_bounces"});
    if (table.find("samples_per_pixel")) {
      loaded_.samples_per_pixel =
          table.integer("samples_per_pixel", 1, 1'000'000'000);
    }
    if (table.find("max_bounces")) {
      loaded_.max_bounces = table.integer("max_bounces", 0, bounce_cap);
    }
  }

  void read_materials(const toml::node& node) {
    if (!node.is_table()) {
      fail_at(node, "[materials] must be a table of materials, not " +
                        kind_of(node));
    }
    for (const auto& [key, value] : *node.as_table()) {
      const std::string name(key.str());
      const TomlTable table(value, "material " + in_quotes(name),
                            {"kd", "ks", "kt", "ke", "eta", "fresnel"});
      materials_[name] = loaded_.scene.add(read_material(table));
      loaded_.material_names[materials_[name]] = name;
    }
  }

  Material read_material(const TomlTable& table) {
    for (const auto& [key, value] : table.table()) {
      require(key.str(), key.source(),
              table.name() + " has " + std::string(key.str()));
    }
    Material material;
    Material brightest;  // each coefficient where it is largest
    brightest.kd =
        read_coefficient(table, "kd", material.kd, material.kd_pattern);
    brightest.ks =
        read_coefficient(table, "ks", material.ks, material.ks_pattern);
    brightest.kt =
        read_coefficient(table, "kt", material.kt, material.kt_pattern);
    if (table.find("ke")) material.ke = table.colour("ke");
    if (const toml::node* eta = table.find("eta")) {
      material.eta = table.number("eta");
      if (material.eta < 0.1f || material.eta > 10) {
        fail_at(*eta, table.label("eta") + " must lie between 0.1 and 10");
      }
    }
    if (const toml::node* fresnel = table.find("fresnel")) {
      material.fresnel = read_boolean(*fresnel, table.label("fresnel"));
    }
    brightest.ke = material.ke;
    brightest.fresnel = material.fresnel;
    check_energy(table, brightest);
    return material;
  }

  /// Reads a coefficient: a colour into `value`, or a pattern. Returns the
  /// largest value that it has anywhere; 0 where the file has none.
  Vec3 read_coefficient(const TomlTable& table, const char* key, Vec3& value,
                        const Pattern*& pattern) {
    const toml::node* node = table.find(key);
    if (!node) return Vec3(0);
    if (!node->is_table()) return value = table.colour(key);
    const std::string name = table.label(key);
    const TomlTable options(*node, name,
                            {"image", "checker", "schlick", "scale", "over"});
    std::string type;
    for (const char* one : {"image", "checker", "schlick"}) {
      const toml::node* found = options.find(one);
      if (!found) continue;
      if (!type.empty()) {
        fail_at(*found,
                name + " cannot be both '" + type + "' and '" + one + "'");
      }
      type = one;
      require(type, found->source(), name + " is of type '" + type + "'");
    }
    if (type.empty()) {
      fail_at(*node, name + " needs one of 'image', 'checker', 'schlick'");
    }
    if (type != "checker") {
      for (const char* one : {"scale", "over"}) {
        if (options.find(one)) {
          fail_at(*options.find(one), options.label(one) +
                                          " goes with "
                                          "'checker' only");
        }
      }
    }
    Pattern& result = loaded_.scene.patterns.emplace_back();
    pattern = &result;
    if (type == "image") return read_image_pattern(options, result);
    result.type =
        type == "schlick" ? PatternType::schlick : PatternType::checker;
    read_two_colours(options, type.c_str(), result);
    if (options.find("scale")) {
      result.scale = options.number("scale");
      if (!(result.scale > 0) || result.scale > 1e6f) {
        fail_at(options.at("scale"),
                options.label("scale") + " must lie between 0 and 1e6");
      }
    }
    if (options.find("over")) {
      const std::string over = options.string("over");
      if (over != "uv" && over != "position") {
        fail_at(options.at("over"),
                options.label("over") + " must be \"uv\" or \"position\"");
      }
      if (over == "position") result.type = PatternType::position_checker;
    }
    return glm::max(result.first, result.second);
  }

  static void read_two_colours(const TomlTable& options, const char* key,
                               Pattern& pattern) {
    const toml::node& node = options.at(key);
    const toml::array* array = node.as_array();
    if (!array || array->size() != 2) {
      fail_at(node, options.label(key) +
                        " must be two colours, like "
                        "[[0.8, 0.8, 0.8], [0.1, 0.1, 0.1]]");
    }
    pattern.first = read_colour(*array->get(0), options.label(key));
    pattern.second = read_colour(*array->get(1), options.label(key));
  }

  Vec3 read_image_pattern(const TomlTable& options, Pattern& pattern) {
    const std::string path = options.string("image");
    auto known = textures_.find(path);
    if (known == textures_.end()) {
      try {
        Texture& texture =
            loaded_.scene.textures.emplace_back(load_texture(folder_, path));
        known = textures_.emplace(path, &texture).first;
      } catch (const std::exception& error) {
        fail_at(options.at("image"), "texture " + in_quotes(path) +
                                         " cannot be used: " + error.what());
      }
    }
    pattern.type = PatternType::image;
    pattern.texture = known->second;
    Vec3 largest(0);
    for (const auto& texel : pattern.texture->texels) {
      for (int c = 0; c < 3; ++c) {
        largest[c] = std::max(
            largest[c], srgb_to_linear(texel[static_cast<std::size_t>(c)]));
      }
    }
    return largest;
  }

  /// No surface may give back more light than it gets.
  static void check_energy(const TomlTable& table, const Material& material) {
    const Vec3 delta = material.fresnel ? glm::max(material.ks, material.kt)
                                        : material.ks + material.kt;
    const Vec3 sum = material.kd + delta;
    const char* formula =
        material.fresnel ? "kd + max(ks, kt)" : "kd + ks + kt";
    const char* channels[] = {"red", "green", "blue"};
    for (int c = 0; c < 3; ++c) {
      if (sum[c] > 1 + 1e-6f) {
        fail_at(table.table(), table.name() +
                                   " reflects more light than it "
                                   "gets: " +
                                   formula + " is " + std::to_string(sum[c]) +
                                   " in the " + channels[c] +
                                   " channel, and at most 1 is "
                                   "possible");
      }
    }
    if (material.emits() && max_component(sum) > 0) {
      fail_at(table.table(), table.name() +
                                 " emits (ke), so it must not "
                                 "reflect or refract (kd, ks, kt)");
    }
  }

  void read_shape(const toml::node& node) {
    if (!node.is_table()) {
      fail_at(node, "a shape must be a table, not " + kind_of(node));
    }
    const toml::node* type = node.as_table()->get("type");
    if (!type) fail_at(node, "a shape needs 'type'");
    const std::string name = read_string(*type, "'type' of a shape");
    if (name == "plane") return read_plane(node);
    if (name == "sphere") return read_sphere(node);
    if (name == "rectangle") return read_rectangle(node);
    if (name == "triangle") return read_triangle(node);
    const char* types[] = {"plane", "sphere", "rectangle", "triangle"};
    fail_at(*type, "unknown shape " + in_quotes(name) +
                       suggestion(name, types) +
                       " (plane, sphere, rectangle, triangle)");
  }

  const Material* material_of(const TomlTable& table) const {
    const toml::node& node = table.at("material");
    const std::string name = read_string(node, table.label("material"));
    const auto found = materials_.find(name);
    if (found != materials_.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [known, material] : materials_) names.push_back(known);
    fail_at(node, "there is no material " + in_quotes(name) +
                      suggestion(name, names));
  }

  /// Lengths from 1e-12 to 1e12 can be squared in a float.
  static constexpr float least_length = 1e-12f;

  /// A vector's direction. Scaled first, so that no digit of it is lost.
  static Vec3 unit(const TomlTable& table, const char* key) {
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
    loaded_.scene.add(
        Plane{direction, static_cast<float>(distance), material_of(table)});
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
    loaded_.scene.add(Sphere{center, radius, material_of(table)});
  }

  void read_rectangle(const toml::node& node) {
    const TomlTable table(node, "a rectangle",
                          {"type", "corner", "edge_u", "edge_v", "material"});
    const Vec3 corner = table.vector("corner");
    unit(table, "edge_u");
    unit(table, "edge_v");
    add_flat(node, "the rectangle's edges",
             Rectangle(corner, table.vector("edge_u"), table.vector("edge_v"),
                       material_of(table)));
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
    add_flat(list, "the triangle's vertices",
             Triangle(vertex[0], vertex[1] - vertex[0], vertex[2] - vertex[0],
                      material_of(table)));
  }

  template <class Shape>
  void add_flat(const toml::node& node, const std::string& what,
                const Shape& flat) {
    // In double precision, where neither squares nor rounding matter.
    const glm::dvec3 u = flat.edge_u, v = flat.edge_v;
    if (!(length(glm::cross(u, v)) > 1e-6 * length(u) * length(v))) {
      fail_at(node, what + " lie on one line: they span no area");
    }
    if (!is_finite(flat.normal) || !is_finite(flat.dual_u()) ||
        !is_finite(flat.dual_v())) {
      fail_at(node, what + " span an area that is too small or too large");
    }
    loaded_.scene.add(flat);
  }

  void read_light(const toml::node& node) {
    const TomlTable table(node, "a light", {"type", "center", "intensity"});
    const std::string type = table.string("type");
    if (type != "point") {
      fail_at(table.at("type"), "unknown light " + in_quotes(type) +
                                    ": lights are of type 'point'; surfaces "
                                    "emit with ke");
    }
    require("point", table.at("type").source(), "there is a point light");
    loaded_.scene.add(
        PointLight{table.vector("center"), table.colour("intensity")});
  }

  Syllabus syllabus_;
  std::string folder_;
  LoadedScene loaded_;
  std::map<std::string, const Texture*> textures_;
  std::map<std::string, const Material*, std::less<>> materials_;
};

/// More bytes than any scene has: a wrong file must not fill the memory.
inline constexpr std::uintmax_t most_scene_bytes = 1 << 30;

/// The bytes of a scene file. Folders and devices are refused.
inline std::string read_scene_text(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  const auto fail = [&](const std::string& why) {
    throw SceneError((path.empty() ? "''" : path) + ": " + why);
  };
  if (!fs::exists(status)) fail("there is no such scene file");
  if (fs::is_directory(status)) fail("is a folder, not a scene file");
  if (!fs::is_regular_file(status)) fail("is not a regular file");
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > most_scene_bytes) fail("is larger than 1 GB");
  std::ifstream file(path, std::ios::binary);
  std::string text;
  try {
    text.assign(std::istreambuf_iterator<char>(file), {});
  } catch (
      const std::ios::failure&) {  // as the C++ library of GCC reports it
    fail("cannot be read");
  }
  if (!file) fail("cannot be read");
  return text;
}

/// Reads the scene of a TOML text; `path` is what error messages call it.
inline LoadedScene parse_scene(std::string_view text, const std::string& path,
                               const Syllabus& syllabus) {
  check_key_parts(text, path);
  toml::table root;
  try {
    root = toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    fail_at(error.source(),
            "this is not TOML: " + std::string(error.description()));
  }
  LoadedScene loaded =
      SceneReader(syllabus,
                  std::filesystem::path(path).parent_path().string())
          .read(root);
  loaded.sha256 = sha256(text);
  return loaded;
}

inline LoadedScene load_scene(const std::string& path,
                              const Syllabus& syllabus) {
  return parse_scene(read_scene_text(path), path, syllabus);
}

}  // namespace lightwalk
