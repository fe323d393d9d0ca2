#include "support/renders.hpp"

#include "common/scene_file/scene_file.hpp"

namespace lightwalk::tests {

namespace {
// These tests test the stages, not the loader: here everything is allowed.
constexpr Syllabus everything{9, {}};
}  // namespace

LoadedScene load_scene_for_tests(const std::string& name) {
  return load_scene(SCENES "/" + name + ".toml", everything);
}

Scene scene_file(const std::string& name, int width, int height) {
  LoadedScene loaded = load_scene_for_tests(name);
  loaded.scene.camera.width = width;
  loaded.scene.camera.height = height;
  return std::move(loaded.scene);
}

Scene scene_text(std::string_view text) {
  constexpr std::string_view camera =
      "[camera]\norigin = [0, 0, -3.5]\nleft = [-1, 0, 0]\nup = [0, 1, 0]\n"
      "forward = [0, 0, 3]\nsize = [32, 32]\n";
  std::string whole(text);
  if (text.find("[camera]") == std::string_view::npos) {
    whole = std::string(camera) + whole;
  }
  return parse_scene(whole, "scene", everything).scene;
}

}  // namespace lightwalk::tests
