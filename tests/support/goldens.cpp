#include "support/goldens.hpp"

#include <toml++/toml.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/image/image_file.hpp"
#include "common/scene_file/scene_file.hpp"
#include "compare/verdict.hpp"

namespace lightwalk::tests {

namespace {

constexpr const char* folder = GOLDENS;

std::string stage_name(int stage) {
  return "stage" + std::to_string(stage);
}

/// Calls `use` with each entry of the list that belongs to the stage.
template <class Use>
void for_each_golden(int stage, Use use) {
  const toml::table list =
      toml::parse_file(std::string(folder) + "/goldens.toml");
  for (const toml::node& node : *list["golden"].as_array()) {
    const toml::table& golden = *node.as_table();
    if (golden["stage"].value<int>() == stage) use(golden);
  }
}

}  // namespace

std::vector<std::string> golden_names(int stage) {
  std::vector<std::string> names;
  for_each_golden(stage, [&](const toml::table& golden) {
    names.push_back(*golden["scene"].value<std::string>());
  });
  return names;
}

Golden load_golden(int stage, const std::string& name) {
  Golden golden;
  golden.name = name;
  for_each_golden(stage, [&](const toml::table& entry) {
    if (entry["scene"].value<std::string>() != name) return;
    golden.settings.samples_per_pixel = *entry["samples"].value<int>();
    golden.settings.max_bounces =
        entry["max_bounces"].value_or(golden.settings.max_bounces);
    golden.settings.photons =
        entry["photons"].value_or(golden.settings.photons);
    golden.settings.neighbors =
        entry["neighbors"].value_or(golden.settings.neighbors);
  });
  golden.settings.seed = 11;
  if (const char* seed = std::getenv("LIGHTWALK_GOLDEN_SEED")) {
    golden.settings.seed = std::strtoull(seed, nullptr, 10);
  }
  const std::string path =
      std::string(folder) + '/' + stage_name(stage) + '/' + name + ".pfm";
  try {
    golden.image = read_image(path);
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": " + error.what() +
                             " (`make goldens` makes it)");
  }
  golden.loaded = load_scene_for_tests(name);
  Camera& camera = golden.loaded.scene.camera;
  camera.width = golden.image.radiance.width;
  camera.height = golden.image.radiance.height;
  if (golden.loaded.hash != golden.image.info.scene_hash) {
    throw std::runtime_error(path + " was made from another version of " +
                             "scenes/" + name + ".toml; `make goldens` " +
                             "remakes it");
  }
  return golden;
}

std::string seen_in(const LoadedScene& loaded, const Region& region) {
  const Scene& scene = loaded.scene;
  std::map<std::string, int> seen;
  for (int y = region.top; y < region.top + region.height; ++y) {
    for (int x = region.left; x < region.left + region.width; ++x) {
      const auto hit =
          scene.nearest_hit(scene.camera.ray(x, y, Vec2(0.5f, 0.5f)));
      if (!hit) continue;
      ++seen["the " + shape_name(hit->shape_type) + " of '" +
             loaded.material_names.at(hit->material) + "'"];
    }
  }
  std::string most;
  for (const auto& [name, count] : seen) {
    if (most.empty() || count > seen[most]) most = name;
  }
  return most;
}

std::string broken_outright(const RenderResult& result) {
  if (result.info.dropped > 0) {
    return std::to_string(result.info.dropped) +
           " samples are not a number or infinite: a division by zero, or "
           "the root of a negative number";
  }
  bool constant = true, quiet = true;
  for (std::size_t i = 0; i < result.radiance.pixels.size(); ++i) {
    const Vec3& pixel = result.radiance.pixels[i];
    if (std::min({pixel.x, pixel.y, pixel.z}) < 0) {
      return "there is negative light in pixel " + std::to_string(i);
    }
    constant = constant && pixel == result.radiance.pixels[0];
    quiet = quiet && result.variance.pixels[i] == Vec3(0);
  }
  if (constant) return "every pixel is the same: is anything traced at all?";
  if (quiet) return "no pixel has any noise: the random numbers do nothing";
  return "";
}

std::string explain(int stage, const Golden& golden,
                    const Comparison& comparison) {
  const Image& image = golden.image.radiance;
  std::string text =
      "golden image " + golden.name + " of " + stage_name(stage) + ":\n" +
      describe(comparison.again, comparison.confirmed, Bands{}, image.width,
               image.height, [&](const Region& region) {
                 return seen_in(golden.loaded, region);
               });
  const std::filesystem::path report = "golden_failures";
  std::error_code ignored;
  std::filesystem::create_directories(report, ignored);
  const std::string path =
      (report / (stage_name(stage) + "_" + golden.name + ".png")).string();
  try {
    RenderResult picture;
    picture.radiance = difference_picture(comparison.test, golden.image);
    ToneMapping as_it_is;
    as_it_is.steps.clear();
    as_it_is.gamma_before = 2.2f;
    write_image(path, picture, as_it_is);
    text +=
        "\nyours, the golden, the difference (red: too bright) and its "
        "z are side by side in " +
        std::filesystem::absolute(path).string();
  } catch (const std::exception&) {
    // The verdict does not depend on the picture.
  }
  return text;
}

}  // namespace lightwalk::tests
