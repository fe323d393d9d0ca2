// Scene files: refused in one line that begins with the place, or loaded, and
// then the scene can be rendered. Textures are found in the
// scene's folder, never outside.

#include "common/scene_file/scene_file.hpp"

#include <filesystem>

#include "stages/5_fresnel_textures/path_tracer.hpp"
#include "stages/introductions.hpp"
#include "tests/core/temporary_folder.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/fuzz/limited_memory.hpp"

using namespace lightwalk;
using namespace lightwalk::fuzz;

namespace {

/// inside/textures/globe.png and marble.png, 4 x 2, and beside that folder
/// outside.png, 2 x 1, which no scene of the folder may use.
struct Folder {
  tests::TemporaryFolder folder;
  std::string scene = folder / "inside/scene.toml";

  Folder() {
    namespace fs = std::filesystem;
    fs::create_directories(folder / "inside/textures");
    for (const char* name : {"globe", "marble"}) {
      fs::copy_file(
          PICTURES "/corners.png",
          folder / ("inside/textures/" + std::string(name) + ".png"));
    }
    fs::copy_file(PICTURES "/rgba.png", folder / "outside.png");
  }
};

/// The scene, or nullopt if it is refused.
std::optional<LoadedScene> load(const std::string& text,
                                const std::string& path, int stage) {
  try {
    return parse_scene(text, path, syllabus(stage));
  } catch (const SceneError& error) {
    const std::string_view message = error.what();
    expect(is_one_line(message), "a refusal is one line", error.what());
    expect(message.starts_with(path + ':'), "a refusal begins with the place",
           error.what());
    return std::nullopt;
  }
}

void check(const LoadedScene& loaded) {
  const Scene& scene = loaded.scene;
  expect(scene.geometry.size() > 0, "a scene has shapes");
  expect(scene.camera.width >= 1 && scene.camera.width <= 65536 &&
             scene.camera.height >= 1 && scene.camera.height <= 65536,
         "the picture's size fits");
  for (const Texture& texture : scene.textures) {
    expect(texture.width == 4 && texture.height == 2,
           "a texture is from the scene's folder");
  }
  for (const Material& material : scene.materials) {
    const Vec3 most = material.fresnel ? glm::max(material.ks, material.kt)
                                       : material.ks + material.kt;
    expect(max_component(material.kd + most) <= 1.00001f,
           "no material gives more light than it gets");
    expect(material.eta >= 0.1f && material.eta <= 10, "eta fits");
  }
  for (const std::string& warning : loaded.warnings) {
    expect(is_one_line(warning), "a warning is one line", warning);
  }
}

/// Follows a few paths. Their radiance may be too large for a float, but the
/// surfaces that they hit have finite positions and normals.
void send_rays(const LoadedScene& loaded) {
  const Scene& scene = loaded.scene;
  RenderSettings settings;
  settings.max_bounces = 4;
  const stage5::PathTracer tracer(scene, settings);
  for (std::uint32_t i = 0; i < 4; ++i) {
    Random random(1, 0, i);
    const Ray ray =
        scene.camera.ray(static_cast<int>(i) * (scene.camera.width - 1) / 3,
                         static_cast<int>(i) * (scene.camera.height - 1) / 3,
                         random.uniform_2d());
    if (const auto hit = scene.nearest_hit(ray)) {
      expect(hit->distance > 0, "a hit lies ahead");
      expect(is_finite(hit->position), "a hit has a place",
             text(hit->position));
      expect(std::abs(length(hit->normal) - 1) < 1e-4f,
             "a hit has a unit normal", text(hit->normal));
    }
    tracer.radiance(ray, random);
  }
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  const LimitedMemory limited;
  const std::string bytes = text_of(data, size);
  const auto last = load(bytes, folder.scene, 5);
  // An early stage refuses what later ones introduce, and nothing else.
  const int stage = 1 + static_cast<int>(size % 4);
  const auto early = load(bytes, folder.scene, stage);
  expect(!early || last, "a later stage takes what an earlier one takes");
  if (!last) return 0;
  check(*last);
  send_rays(*last);
  return 0;
}
