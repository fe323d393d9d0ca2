#pragma once

// The [materials] of a scene file, with their patterns and textures.

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/image/image.hpp"
#include "common/image/srgb.hpp"
#include "common/image/texture_file.hpp"
#include "common/scene/scene.hpp"
#include "common/scene_file/syllabus.hpp"
#include "common/scene_file/toml_reader.hpp"

namespace lightwalk {

/// Refuses what a later stage introduces.
inline void require(const Syllabus& syllabus, std::string_view word,
                    const toml::source_region& place,
                    const std::string& message) {
  if (const auto stage = syllabus.still_to_come(word)) {
    fail_at(place, message + ", which stage " + std::to_string(*stage) +
                       " introduces");
  }
}

/// Adds materials to a scene, and knows their names.
class MaterialReader {
 public:
  /// Paths of textures are relative to `folder`, that of the scene file.
  MaterialReader(const Syllabus& syllabus, std::string folder, Scene& scene)
      : syllabus_(syllabus), folder_(std::move(folder)), scene_(scene) {}

  void read(const toml::node& node) {
    if (!node.is_table()) {
      fail_at(node, "[materials] must be a table of materials, not " +
                        kind_of(node));
    }
    for (const auto& [key, value] : *node.as_table()) {
      const std::string name(key.str());
      const TomlTable table(value, "material " + in_quotes(name),
                            {"kd", "ks", "kt", "ke", "eta", "fresnel"});
      by_name_[name] = scene_.add(read_material(table));
    }
  }

  /// The material that a table names.
  const Material* named_by(const TomlTable& table) const {
    const toml::node& node = table.at("material");
    const std::string name = read_string(node, table.label("material"));
    const auto found = by_name_.find(name);
    if (found != by_name_.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [known, material] : by_name_) names.push_back(known);
    fail_at(node, "there is no material " + in_quotes(name) +
                      suggestion(name, names));
  }

  const std::map<std::string, const Material*, std::less<>>& by_name() const {
    return by_name_;
  }

 private:
  Material read_material(const TomlTable& table) {
    for (const auto& [key, value] : table.table()) {
      require(syllabus_, key.str(), key.source(),
              table.name() + " has " + std::string(key.str()));
    }
    Material material;
    Material brightest;  // each coefficient where it is largest
    brightest.kd =
        read_coefficient(table, "kd", material.kd, material.varying_kd);
    brightest.ks =
        read_coefficient(table, "ks", material.ks, material.varying_ks);
    brightest.kt =
        read_coefficient(table, "kt", material.kt, material.varying_kt);
    if (table.find("ke")) material.ke = table.color("ke");
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

  /// Reads a coefficient: a color into `value`, or a pattern. Returns the
  /// largest value that it has anywhere; 0 if the file has none.
  Vec3 read_coefficient(const TomlTable& table, const char* key, Vec3& value,
                        const VaryingCoefficient*& pattern) {
    const toml::node* node = table.find(key);
    if (!node) return Vec3(0);
    if (!node->is_table()) return value = table.color(key);
    const TomlTable options(*node, table.label(key),
                            {"image", "checker", "schlick", "scale", "over"});
    const std::string type = pattern_type(options);
    VaryingCoefficient& result = scene_.varying_coefficients.emplace_back();
    pattern = &result;
    if (type == "image") return read_image(options, result);
    read_two_colors(options, type.c_str(), result);
    if (type == "schlick") {
      result.type = VaryingType::schlick;
    } else {
      read_checker(options, result);
    }
    return glm::max(result.first, result.second);
  }

  /// The one type that a pattern must have.
  std::string pattern_type(const TomlTable& options) const {
    const std::string& name = options.name();
    std::string type;
    for (const char* one : {"image", "checker", "schlick"}) {
      const toml::node* found = options.find(one);
      if (!found) continue;
      if (!type.empty()) {
        fail_at(*found,
                name + " cannot be both '" + type + "' and '" + one + "'");
      }
      type = one;
      require(syllabus_, type, found->source(),
              name + " is of type '" + type + "'");
    }
    if (type.empty()) {
      fail_at(options.table(),
              name + " needs one of 'image', 'checker', 'schlick'");
    }
    for (const char* one : {"scale", "over"}) {
      if (type != "checker" && options.find(one)) {
        fail_at(*options.find(one),
                options.label(one) + " goes with 'checker' only");
      }
    }
    return type;
  }

  static void read_checker(const TomlTable& options,
                           VaryingCoefficient& pattern) {
    pattern.type = VaryingType::checker;
    if (options.find("scale")) {
      pattern.scale = options.number("scale");
      if (!(pattern.scale > 0) || pattern.scale > 1e6f) {
        fail_at(options.at("scale"),
                options.label("scale") + " must lie between 0 and 1e6");
      }
    }
    if (!options.find("over")) return;
    const std::string over = options.string("over");
    if (over != "uv" && over != "position") {
      fail_at(options.at("over"),
              options.label("over") + ": " +
                  none_of(over, std::array{"uv", "position"}));
    }
    if (over == "position") pattern.type = VaryingType::position_checker;
  }

  static void read_two_colors(const TomlTable& options, const char* key,
                              VaryingCoefficient& pattern) {
    const toml::node& node = options.at(key);
    const toml::array* array = node.as_array();
    if (!array || array->size() != 2) {
      fail_at(node, options.label(key) +
                        " must be two colors, like "
                        "[[0.8, 0.8, 0.8], [0.1, 0.1, 0.1]]");
    }
    pattern.first = read_color(*array->get(0), options.label(key));
    pattern.second = read_color(*array->get(1), options.label(key));
  }

  Vec3 read_image(const TomlTable& options, VaryingCoefficient& pattern) {
    const std::string path = options.string("image");
    auto known = textures_.find(path);
    if (known == textures_.end()) {
      try {
        Texture& texture =
            scene_.textures.emplace_back(load_texture(folder_, path));
        known = textures_.emplace(path, &texture).first;
        texels_ += texture.texels.size();
        if (texels_ > max_texels) {
          throw FileError("the textures of a scene may have " +
                          std::to_string(max_texels) +
                          " pixels in all, and these are more");
        }
      } catch (const std::exception& error) {
        fail_at(options.at("image"), "texture " + in_quotes(path) +
                                         " cannot be used: " + error.what());
      }
    }
    pattern.type = VaryingType::image;
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
    for (int c = 0; c < 3; ++c) {
      if (sum[c] > 1 + 1e-6f) {
        fail_at(table.table(),
                table.name() +
                    " reflects more light than it "
                    "gets: " +
                    formula + " is " + std::to_string(sum[c]) + " in the " +
                    channel_names[static_cast<std::size_t>(c)] +
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

  const Syllabus& syllabus_;
  std::string folder_;
  Scene& scene_;
  /// 800 MB of textures.
  static constexpr std::size_t max_texels = std::size_t{1} << 28;

  std::map<std::string, const Texture*> textures_;
  std::size_t texels_ = 0;
  std::map<std::string, const Material*, std::less<>> by_name_;
};

}  // namespace lightwalk
