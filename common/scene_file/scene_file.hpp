#pragma once

// Scene files: TOML in, a Scene out, or a SceneError that says what is wrong,
// in which line and column, and what was expected. The format is described in
// scenes/README.md and, for editors, in scenes/scene.schema.json.

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "common/files/file_path.hpp"
#include "common/files/read_file.hpp"
#include "common/render/render_settings.hpp"
#include "common/scene/scene.hpp"
#include "common/scene_file/duplicate_shapes.hpp"
#include "common/scene_file/loaded_scene.hpp"
#include "common/scene_file/material_reader.hpp"
#include "common/scene_file/shape_reader.hpp"
#include "common/scene_file/syllabus.hpp"
#include "common/scene_file/toml_reader.hpp"

namespace lightwalk {

class SceneReader {
 public:
  /// Paths of textures are relative to `folder`, that of the scene file.
  SceneReader(const Syllabus& syllabus, std::string folder)
      : syllabus_(syllabus),
        materials_(syllabus, std::move(folder), loaded_.scene),
        shapes_(materials_, loaded_) {}

  LoadedScene read(const toml::table& root) {
    const TomlTable file(
        root, "the scene",
        {"camera", "render", "materials", "shapes", "lights"});
    read_camera(file.at("camera"));
    if (const auto* render = file.find("render")) read_render(*render);
    if (const auto* node = file.find("materials")) materials_.read(*node);
    for_each(file, "shapes", "shape",
             [&](const toml::node& node) { shapes_.read(node); });
    for_each(file, "lights", "light",
             [&](const toml::node& node) { read_light(node); });
    loaded_.scene.prepare();
    if (loaded_.scene.geometry.size() == 0) {
      fail_at(root, "the scene has no [[shapes]]");
    }
    for (const auto& [name, material] : materials_.by_name()) {
      loaded_.material_names[material] = name;
    }
    return std::move(loaded_);
  }

 private:
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

  void read_light(const toml::node& node) {
    const TomlTable table(node, "a light", {"type", "center", "intensity"});
    const std::string type = table.string("type");
    if (type != "point") {
      fail_at(table.at("type"), "unknown light " + in_quotes(type) +
                                    ": lights are of type 'point'; surfaces "
                                    "emit with ke");
    }
    require(syllabus_, "point", table.at("type").source(),
            "there is a point light");
    loaded_.scene.add(
        PointLight{table.vector("center"), table.color("intensity")});
  }

  const Syllabus& syllabus_;
  LoadedScene loaded_;
  MaterialReader materials_;
  ShapeReader shapes_;
};

/// ", did you mean 'scenes/glass.toml'?" for the scene file whose name is
/// nearest, in the folder that was named or in the folder scenes.
inline std::string scene_suggestion(const std::string& path) {
  namespace fs = std::filesystem;
  const fs::path wanted = file_path(path), here = wanted.parent_path();
  for (const fs::path& folder : {here, here / "scenes", fs::path("scenes")}) {
    std::vector<std::string> names;
    std::error_code error;
    fs::directory_iterator file(folder.empty() ? "." : folder, error);
    for (; !error && file != fs::directory_iterator();
         file.increment(error)) {
      std::error_code ignored;
      if (file->path().extension() == ".toml" &&
          file->is_regular_file(ignored)) {
        names.push_back(name_of(file->path().stem()));
      }
    }
    std::sort(names.begin(), names.end());  // the folder has no order
    const std::string best = nearest(name_of(wanted.stem()), names);
    if (best.empty()) continue;
    return ", did you mean '" + name_of(folder / file_path(best + ".toml")) +
           "'?";
  }
  return "";
}

/// More bytes than any scene file has: two million triangles. A wrong file
/// must not fill the memory.
inline constexpr std::uintmax_t max_scene_bytes = 1 << 28;

/// The bytes of a scene file. Throws a SceneError, also for folders and
/// devices.
inline std::string read_scene_text(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(file_path(path), error);
  const auto fail = [&](const std::string& why) {
    const std::string name = path.empty() ? "''" : path;
    throw SceneError(shortened(name, max_shown_name) + ": " + why);
  };
  if (error == std::errc::permission_denied) fail(error.message());
  if (!fs::exists(status)) {
    fail("there is no such scene file" + scene_suggestion(path));
  }
  if (fs::is_directory(status)) fail("is a folder, not a scene file");
  if (!fs::is_regular_file(status)) fail("is not a regular file");
  const std::uintmax_t size = fs::file_size(file_path(path), error);
  if (!error && size > max_scene_bytes) fail("is larger than 256 MB");
  try {
    return read_file(path, max_scene_bytes);
  } catch (const FileError&) {
    fail("cannot be read");
  }
  return {};
}

/// Reads the scene of a TOML text; error messages call it `path`. Throws a
/// SceneError.
inline LoadedScene parse_scene(std::string_view text, const std::string& path,
                               const Syllabus& syllabus) {
  check_extent(text, path);
  toml::table root;
  try {
    root = toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    fail_at(error.source(),
            "this is not TOML: " + std::string(error.description()));
  }
  LoadedScene loaded =
      SceneReader(syllabus, name_of(file_path(path).parent_path()))
          .read(root);
  loaded.hash = fnv_1a(text);
  if (const auto warning = duplicate_shapes(loaded)) {
    loaded.warnings.push_back(path + ':' + *warning);
  }
  return loaded;
}

inline LoadedScene load_scene(const std::string& path,
                              const Syllabus& syllabus) {
  return parse_scene(read_scene_text(path), path, syllabus);
}

}  // namespace lightwalk
