#include "support/golden_parts.hpp"

#include <ctime>
#include <map>
#include <set>

#include "support/goldens.hpp"

namespace lightwalk::tests {

namespace {

constexpr int most_bounces = 3;

/// A lobe alone needs no more, and a path that should end might not.
constexpr int bounces_of_lobes = 8;

/// Processor time, in seconds, after which no further part is begun.
constexpr double patience = 6;

struct LobeField {
  const char* name;
  Vec3 Material::*constant;
  const VaryingCoefficient* Material::*varying;
};
constexpr LobeField lobe_fields[] = {
    {"kd", &Material::kd, &Material::varying_kd},
    {"ks", &Material::ks, &Material::varying_ks},
    {"kt", &Material::kt, &Material::varying_kt}};

bool has(const Material& material, const LobeField& lobe) {
  return !is_black(material.*lobe.constant) || material.*lobe.varying;
}

/// The materials of the shapes of each type that emit.
std::map<std::string, std::set<const Material*>> lamps_of(
    const Scene& scene) {
  std::map<std::string, std::set<const Material*>> lamps;
  const auto add = [&](const char* type, const auto& shapes) {
    for (const auto& shape : shapes) {
      if (shape.material->emits()) lamps[type].insert(shape.material);
    }
  };
  add("the planes", scene.geometry.planes());
  add("the spheres", scene.geometry.spheres());
  add("the rectangles", scene.geometry.rectangles());
  add("the triangles", scene.geometry.triangles());
  for (const auto& light : scene.lights) {
    if (std::holds_alternative<PointLight>(light.form)) {
      lamps["the point lights"];
    }
  }
  return lamps;
}

/// Whether no material is of two types of lamps, which cannot be parted.
bool can_be_parted(
    const std::map<std::string, std::set<const Material*>>& lamps) {
  std::set<const Material*> all;
  std::size_t count = 0;
  for (const auto& [type, materials] : lamps) {
    all.insert(materials.begin(), materials.end());
    count += materials.size();
  }
  return lamps.size() > 1 && all.size() == count;
}

void leave_one_lobe(Scene& scene, const std::string& name) {
  for (Material& material : scene.materials) {
    for (const LobeField& lobe : lobe_fields) {
      if (name == lobe.name) continue;
      material.*lobe.constant = Vec3(0);
      material.*lobe.varying = nullptr;
    }
  }
}

void leave_one_lamp(Scene& scene, const std::string& type) {
  for (const auto& [other, materials] : lamps_of(scene)) {
    if (other == type) continue;
    for (Material& material : scene.materials) {
      if (materials.count(&material)) material.ke = Vec3(0);
    }
  }
  for (Light& light : scene.lights) {
    if (auto* point = std::get_if<PointLight>(&light.form)) {
      if (type != "the point lights") point->intensity = Vec3(0);
    } else if (auto* sphere = std::get_if<SphereLight>(&light.form)) {
      if (type != "the spheres") sphere->radiance = Vec3(0);
    } else if (type != "the rectangles") {
      std::get<RectangleLight>(light.form).radiance = Vec3(0);
    }
  }
}

std::string file_name(std::string type) {
  std::replace(type.begin(), type.end(), ' ', '-');
  return type;
}

}  // namespace

std::vector<std::string> part_names(const Golden& golden) {
  std::vector<std::string> names;
  const Scene& scene = golden.loaded.scene;
  for (int i = 0; i <= most_bounces && i < golden.settings.max_bounces; ++i) {
    names.push_back(bounces_name(static_cast<std::size_t>(i)));
  }
  std::vector<std::string> lobes;
  for (const LobeField& lobe : lobe_fields) {
    for (const Material& material : scene.materials) {
      if (!has(material, lobe)) continue;
      lobes.push_back(lobe.name);
      break;
    }
  }
  if (lobes.size() > 1) names.insert(names.end(), lobes.begin(), lobes.end());
  const auto lamps = lamps_of(scene);
  if (can_be_parted(lamps)) {
    for (const auto& [type, materials] : lamps) {
      names.push_back(file_name(type));
    }
  }
  return names;
}

RenderResult paint_part(const Golden& golden, const std::string& name,
                        int samples, std::uint64_t seed,
                        const Painter& paint) {
  LoadedScene loaded = load_scene_for_tests(golden.name);
  Scene& scene = loaded.scene;
  scene.camera.width = golden.image.radiance.width;
  scene.camera.height = golden.image.radiance.height;
  RenderSettings settings = golden.settings;
  settings.samples_per_pixel = samples;
  settings.seed = seed;
  if (name.rfind("bounces-", 0) == 0) {
    settings.max_bounces = std::atoi(name.c_str() + 8);
  } else if (name.size() == 2) {
    leave_one_lobe(scene, name);
    settings.max_bounces = std::min(settings.max_bounces, bounces_of_lobes);
  } else {
    for (const auto& [type, materials] : lamps_of(scene)) {
      if (file_name(type) == name) {
        leave_one_lamp(scene, type);
        break;
      }
    }
    settings.max_bounces = std::min(settings.max_bounces, bounces_of_lobes);
  }
  return paint(scene, settings);
}

std::string part_path(int stage, const std::string& scene) {
  return signature_path(GOLDENS "/parts", stage, scene);
}

namespace {

/// What a formula may have once too often where a material is seen.
std::vector<std::pair<std::string, std::array<double, 3>>> coefficients_of(
    const Material& material) {
  std::vector<std::pair<std::string, std::array<double, 3>>> result;
  for (const LobeField& lobe : lobe_fields) {
    if (material.*lobe.varying || is_black(material.*lobe.constant)) continue;
    const Vec3& k = material.*lobe.constant;
    std::array<double, 3> value{}, inverse{};
    for (int c = 0; c < 3; ++c) {
      value[static_cast<std::size_t>(c)] = static_cast<double>(k[c]);
      inverse[static_cast<std::size_t>(c)] =
          k[c] > 0 ? 1 / static_cast<double>(k[c]) : 0;
    }
    result.emplace_back(lobe.name, value);
    result.emplace_back(std::string("1/") + lobe.name, inverse);
  }
  if (material.refracts()) {
    // Through a ball or a pane go two surfaces.
    const Vec3 twice = material.kt * material.kt;
    if (!material.varying_kt && twice.x == twice.y && twice.y == twice.z) {
      const auto v = static_cast<double>(twice.x);
      result.push_back({"kt^2", {v, v, v}});
      result.push_back({"1/kt^2", {1 / v, 1 / v, 1 / v}});
    }
    const auto eta = static_cast<double>(material.eta);
    for (const auto& [name, value] :
         {NamedValue{eta, "eta"}, NamedValue{1 / eta, "1/eta"},
          NamedValue{eta * eta, "eta^2"},
          NamedValue{1 / eta / eta, "1/eta^2"}}) {
      result.push_back({value, {name, name, name}});
    }
  }
  return result;
}

}  // namespace

PartsView view_of(const Golden& golden) {
  const Scene& scene = golden.loaded.scene;
  constexpr int size = 4;
  const int columns = (scene.camera.width + size - 1) / size;
  const int rows = (scene.camera.height + size - 1) / size;
  const auto tiles = static_cast<std::size_t>(columns * rows);
  PartsView view;
  view.columns = static_cast<std::size_t>(columns);
  view.pixels.assign(tiles, 0);
  view.factors = usual_factors();
  if (scene.lights.size() > 1 && scene.lights.size() != 2 &&
      scene.lights.size() != 4) {
    const auto n = static_cast<double>(scene.lights.size());
    view.factors.push_back({n, "the number of lights"});
    view.factors.push_back({1 / n, "1 / the number of lights"});
  }
  for (const auto& light : scene.lights) {
    if (const auto* lamp = std::get_if<RectangleLight>(&light.form)) {
      const double area =
          static_cast<double>(length(cross(lamp->edge_u, lamp->edge_v)));
      view.factors.push_back({area, "the lamp's area"});
      view.factors.push_back({1 / area, "1 / the lamp's area"});
    }
    if (const auto* lamp = std::get_if<SphereLight>(&light.form)) {
      const auto radius = static_cast<double>(lamp->radius);
      view.factors.push_back({radius, "the lamp's radius"});
      view.factors.push_back({1 / radius, "1 / the lamp's radius"});
    }
  }
  static const char* shapes[] = {"the plane", "the sphere", "the rectangle",
                                 "the triangle"};
  std::map<std::string, SeenThing> things;
  std::map<const Material*, std::set<std::string>> types;
  for (int y = 0; y < scene.camera.height; ++y) {
    for (int x = 0; x < scene.camera.width; ++x) {
      const auto tile =
          static_cast<std::size_t>(y / size * columns + x / size);
      ++view.pixels[tile];
      const auto hit =
          scene.nearest_hit(scene.camera.ray(x, y, Vec2(0.5f, 0.5f)));
      if (!hit) continue;
      const std::string name =
          "'" + golden.loaded.material_names.at(hit->material) + "'";
      const std::string shape = shapes[static_cast<int>(hit->shape_type)];
      types[hit->material].insert(shape);
      for (const std::string& one : {name, shape + " of " + name}) {
        SeenThing& thing = things[one];
        thing.name = one;
        thing.pixels.resize(tiles);
        ++thing.pixels[tile];
        if (one == name && thing.coefficients.empty()) {
          thing.coefficients = coefficients_of(*hit->material);
        }
      }
    }
  }
  for (auto& [name, thing] : things) view.things.push_back(thing);
  // Of equals the first is taken, and "'glass'" is before "the sphere of".
  return view;
}

std::vector<PartVerdict> judge_parts(const Golden& golden,
                                     const std::vector<Part>& right,
                                     const Painter& paint) {
  std::vector<PartVerdict> verdicts;
  const PartsView view = view_of(golden);
  std::vector<Tiles> things;
  for (const SeenThing& thing : view.things) {
    things.push_back(tiles_of(thing, view));
  }
  const Part all = part_of(golden.image, "all");
  const int samples = golden.settings.samples_per_pixel;
  const std::clock_t began = std::clock();
  for (const std::string& name : part_names(golden)) {
    const Part* part = find_part(right, name);
    if (!part || part->mean.size() != all.mean.size()) continue;
    const auto seconds =
        static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
    if (seconds > patience) break;
    // What the lamps send straight to the camera says nothing of a lobe.
    const Part* before = nullptr;
    if (name.size() == 2) before = find_part(right, bounces_name(0));
    if (name.rfind("bounces-", 0) == 0 && name != bounces_name(0)) {
      std::string one_less = name;
      --one_less.back();
      before = find_part(right, one_less);
    }
    // What is neither right nor wrong for sure gets a second, closer look.
    PartVerdict verdict;
    for (const int closer : {1, 4}) {
      const std::uint64_t seed =
          golden.settings.seed + 1000 * static_cast<unsigned>(closer);
      const auto painted = [&](std::uint64_t one) {
        return part_of(paint_part(golden, name, closer * samples, one, paint),
                       name);
      };
      const Part first = painted(seed);
      const Part second =
          same_parts(first, *part, view.columns) ? first : painted(seed + 1);
      verdict =
          judge_part(first, second, *part, before, things, view.columns);
      if (verdict.wrong || verdict.right) break;
    }
    verdicts.push_back(verdict);
  }
  return verdicts;
}

}  // namespace lightwalk::tests
