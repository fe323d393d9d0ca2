// The lab's box, built in code and painted by stage 4. Needs GLM and the
// standard library, nothing else:
//
//     c++ -std=c++20 -O2 -pthread -I . examples/paint.cpp -o paint && ./paint

#include "common/render/paint.hpp"
#include "common/files/write_file.hpp"
#include "common/image/pfm.hpp"
#include "stages/4_russian_roulette/path_tracer.hpp"

using namespace lightwalk;

int main() {
  Scene scene;
  const Material* white = scene.add(Material{.kd = Vec3(0.8f)});
  const Material* red = scene.add(Material{.kd = {0.8f, 0.2f, 0.2f}});
  const Material* green = scene.add(Material{.kd = {0.2f, 0.8f, 0.2f}});
  const Material* plastic =
      scene.add(Material{.kd = {0.2f, 0.2f, 0.6f}, .ks = Vec3(0.3f)});
  const Material* glass =
      scene.add(Material{.ks = Vec3(0.1f), .kt = Vec3(0.9f)});
  scene.add(Plane{{1, 0, 0}, 1, red});
  scene.add(Plane{{-1, 0, 0}, 1, green});
  scene.add(Plane{{0, 1, 0}, 1, white});
  scene.add(Plane{{0, -1, 0}, 1, white});
  scene.add(Plane{{0, 0, -1}, 1, white});
  scene.add(Sphere{{-0.5f, -0.7f, 0.25f}, 0.3f, plastic});
  scene.add(Sphere{{0.5f, -0.7f, -0.25f}, 0.3f, glass});
  scene.add(PointLight{{0, 0.5f, 0}, Vec3(1)});

  scene.camera.width = scene.camera.height = 128;
  const auto picture =
      paint<stage4::PathTracer>(scene, {.samples_per_pixel = 16});
  write_file("box.pfm", encode_pfm(picture.radiance));
}
