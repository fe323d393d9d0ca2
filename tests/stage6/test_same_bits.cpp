// Stage 6 renders the pictures of stage 5, to the last bit.

#include <doctest/doctest.h>

#include <cstring>
#include <filesystem>
#include <sstream>

#include "stages/6_many_paths/path_tracer.hpp"
#include "support/exact_radiance.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

template <class PathTracer>
std::pair<Film, std::uint64_t> film_of(const Scene& scene,
                                       const RenderSettings& settings) {
  Film film(scene.camera.width, scene.camera.height);
  RenderProgress progress;
  const std::atomic<bool> stop{false};
  render(tile_renderer<PathTracer>(scene, settings), settings, film, stop,
         progress);
  return {film, progress.rays};
}

/// The pixels whose bits differ, and the first of them in words.
struct Difference {
  std::size_t pixels = 0;
  std::string first;
  bool operator==(const Difference&) const = default;
};

Difference difference(const Film& one, const Film& many) {
  Difference found;
  for (std::size_t i = 0; i < one.pixels().size(); ++i) {
    const Pixel &a = one.pixels()[i], &b = many.pixels()[i];
    if (std::memcmp(&a, &b, sizeof(Pixel)) == 0) continue;
    if (found.pixels++ > 0) continue;
    const auto width = static_cast<std::size_t>(one.width());
    std::ostringstream says;
    const auto tell = [&](const Pixel& p) {
      says << "(" << p.mean[0] << ", " << p.mean[1] << ", " << p.mean[2]
           << ") of " << p.samples << " samples";
    };
    says << "pixel " << i % width << "," << i / width << " is ";
    tell(b);
    says << ", and in stage 5 ";
    tell(a);
    found.first = says.str();
  }
  return found;
}

/// The fewest bounces with which the pictures differ.
int first_wrong_bounce(const Scene& scene, RenderSettings settings) {
  for (int bounces = 0; bounces < settings.max_bounces; ++bounces) {
    RenderSettings fewer = settings;
    fewer.max_bounces = bounces;
    if (difference(film_of<stage5::PathTracer>(scene, fewer).first,
                   film_of<stage6::PathTracer>(scene, fewer).first)
            .pixels > 0) {
      return bounces;
    }
    if (bounces == 64) break;
  }
  return settings.max_bounces;
}

void check_same_bits_as_stage5(const std::string& what, const Scene& scene,
                               const RenderSettings& settings) {
  const auto [one, rays] = film_of<stage5::PathTracer>(scene, settings);
  const auto [many, rays_of_many] =
      film_of<stage6::PathTracer>(scene, settings);
  const Difference wrong = difference(one, many);
  if (wrong.pixels > 0) {
    FAIL_CHECK(what << ": " << wrong.pixels << " of " << one.pixels().size()
                    << " pixels differ, from "
                    << first_wrong_bounce(scene, settings)
                    << " bounces on. The first: " << wrong.first);
  } else if (rays != rays_of_many) {
    FAIL_CHECK(what << ": " << rays_of_many << " rays were counted, and "
                    << rays << " by stage 5");
  }
}

RenderSettings settings_of(int samples, int bounces, Sampling sampling) {
  return {.samples_per_pixel = samples,
          .max_bounces = bounces,
          .seed = 7,
          .sampling = sampling,
          .threads = 1};
}

/// A scene with everything in it, drawn at random.
Scene random_scene(std::uint64_t seed) {
  Random random(seed, 0, 0);
  const auto number = [&](float least, float most) {
    return least + (most - least) * random.uniform();
  };
  const auto vector = [&](float most) {
    const float x = number(-most, most), y = number(-most, most);
    return Vec3(x, y, number(-most, most));
  };
  const auto color = [&](float most) {
    const float r = number(0, most), g = number(0, most);
    return Vec3(r, g, number(0, most));
  };
  Scene scene;
  scene.camera.width = scene.camera.height = 12;
  const VaryingCoefficient* patterns[] = {
      &scene.varying_coefficients.emplace_back(VaryingCoefficient{
          VaryingType::checker, color(0.5f), color(0.5f), 3, nullptr}),
      &scene.varying_coefficients.emplace_back(
          VaryingCoefficient{VaryingType::position_checker, color(0.3f),
                             color(0.3f), 2, nullptr}),
      &scene.varying_coefficients.emplace_back(VaryingCoefficient{
          VaryingType::schlick, color(0.2f), color(0.6f), 1, nullptr})};
  const auto material = [&] {
    Material m;
    const float kind = random.uniform();
    if (kind < 0.4f) m.kd = color(0.9f);
    if (kind > 0.3f && kind < 0.6f) m.ks = color(0.5f);
    if (kind > 0.5f) m.kt = color(0.9f);
    if (kind > 0.85f) m.kd = color(0.4f), m.ks = color(0.4f);
    m.fresnel = random.uniform() < 0.3f;
    m.eta = number(1.05f, 2.4f);
    if (random.uniform() < 0.2f) m.varying_kd = patterns[0];
    if (random.uniform() < 0.1f) m.varying_ks = patterns[1];
    if (random.uniform() < 0.1f) m.varying_kt = patterns[2];
    if (random.uniform() < 0.12f) {
      // Half of the emitters have coefficients that no path uses.
      if (random.uniform() < 0.5f) m = Material{};
      m.ke = color(3);
    }
    return scene.add(m);
  };
  // A few shapes are tested one by one, many with a tree.
  const int spheres =
      random.uniform() < 0.2f ? 70 : 1 + static_cast<int>(number(0, 12));
  const int flats =
      random.uniform() < 0.1f ? 70 : static_cast<int>(number(0, 10));
  for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0),
                             Vec3(0, -1, 0), Vec3(0, 0, -1)}) {
    if (random.uniform() < 0.8f) scene.add(Plane{normal, 1, material()});
  }
  for (int i = 0; i < spheres; ++i) {
    const float radius = number(0.02f, 0.5f);
    scene.add(Sphere{vector(0.8f), radius, material()});
  }
  if (random.uniform() < 0.2f) {  // one as large as a planet
    scene.add(Sphere{{0, -6e6f - 0.9f, 0}, 6e6f, material()});
  }
  for (int i = 0; i < flats; ++i) {
    const Vec3 corner = vector(0.9f), u = vector(0.8f), v = vector(0.8f);
    if (random.uniform() < 0.5f) {
      scene.add(Rectangle(corner, u, cross(u, v), material()));
    } else {
      scene.add(Triangle(corner, u, v, material()));
    }
  }
  const int lights = static_cast<int>(number(0, 3.5f));
  for (int i = 0; i < lights; ++i) {
    scene.add(PointLight{vector(0.8f), color(1)});
  }
  scene.prepare();
  return scene;
}

}  // namespace

// Where stage 6 is stage 5, there is nothing to compare.
TEST_SUITE_BEGIN("relations" * doctest::skip(stage6::paths_at_once == 1));

TEST_CASE("a single path has the radiance that it has in stage 5") {
  const Scene scene = scene_file("cornell_box_point", 16, 16);
  const stage5::PathTracer one(scene, {});
  const stage6::PathTracer many(scene, {});
  for (int i = 0; i < 256; ++i) {
    const auto sample = static_cast<std::uint64_t>(i);
    Random first(3, 0, sample), second(3, 0, sample);
    const Ray ray = scene.camera.ray(i % 16, i / 16, Vec2(0.5f));
    CAPTURE(i);
    CHECK(many.radiance(ray, second) == one.radiance(ray, first));
    CHECK(second.uniform() == first.uniform());
  }
}

TEST_CASE("without a bounce the picture is stage 5's, to the bit") {
  for (const std::string name : {"cornell_box_ceiling", "cornell_box_point",
                                 "cornell_box_lamp_diffuse"}) {
    check_same_bits_as_stage5(name, scene_file(name),
                              settings_of(4, 0, Sampling::cosine));
  }
}

TEST_CASE("the picture is stage 5's, to the bit, in every scene") {
  std::size_t scenes = 0;
  for (const auto& file : std::filesystem::directory_iterator(SCENES)) {
    if (file.path().extension() != ".toml") continue;
    const std::string name = file.path().stem().string();
    const Scene scene = scene_file(name);
    for (const Sampling sampling : {Sampling::cosine, Sampling::uniform}) {
      for (const int bounces : {1, 5, bounce_cap}) {
        check_same_bits_as_stage5(name, scene,
                                  settings_of(4, bounces, sampling));
      }
    }
    ++scenes;
  }
  CHECK(scenes >= 15);
}

TEST_CASE("the picture is stage 5's, to the bit, in scenes at random") {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Scene scene = random_scene(seed);
    check_same_bits_as_stage5(
        "random scene " + std::to_string(seed), scene,
        settings_of(6, 40,
                    seed % 3 == 0 ? Sampling::uniform : Sampling::cosine));
  }
}

TEST_CASE("the bits do not depend on how many threads there are") {
  const Scene scene = scene_file("cornell_box_point", 40, 40);
  RenderSettings settings = settings_of(9, bounce_cap, Sampling::cosine);
  const Film one = film_of<stage5::PathTracer>(scene, settings).first;
  for (const int threads : {2, 3, 8}) {
    settings.threads = threads;
    CAPTURE(threads);
    const Film many = film_of<stage6::PathTracer>(scene, settings).first;
    CHECK(difference(one, many).first == "");
  }
}

TEST_CASE("a picture narrower than the rows, and one of a single pixel") {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 1}, {1, 17}}) {
    CAPTURE(width);
    CAPTURE(height);
    check_same_bits_as_stage5("box",
                              scene_file("cornell_box_point", width, height),
                              settings_of(5, bounce_cap, Sampling::cosine));
  }
}

TEST_CASE("a scene of no shapes and one of no lights are black") {
  Scene empty;
  empty.camera.width = empty.camera.height = 8;
  empty.add(PointLight{{0, 0, 0}, Vec3(1)});
  empty.prepare();
  check_same_bits_as_stage5("a light alone", empty,
                            settings_of(2, 4, Sampling::cosine));
}

TEST_CASE("a render that is stopped leaves whole pixels behind") {
  const Scene scene = scene_file("cornell_box_point", 48, 48);
  const RenderSettings settings =
      settings_of(16, bounce_cap, Sampling::cosine);
  Film film(48, 48);
  RenderProgress progress;
  const std::atomic<bool> stop{true};
  tile_renderer<stage6::PathTracer>(scene, settings)({0, 16, 0, 16, 0, 16},
                                                     film, stop);
  for (const Pixel& pixel : film.pixels()) CHECK(pixel.samples == 0);
}

TEST_SUITE_END();
