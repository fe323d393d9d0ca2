// The lab's box for a browser: every stage's path tracer, right and with some
// of its mistakes, one sample of each pixel at a time. variants.inc includes
// the stages' headers and lists their path tracers.

#include <cstdint>
#include <initializer_list>
#include <vector>

#include "common/image/tone_mapping.hpp"
#include "common/render/film.hpp"
#include "common/render/render_settings.hpp"
#include "common/scene/scene.hpp"
#include "variants.inc"

#define EXPORT(name) extern "C" __attribute__((export_name(#name)))

namespace lightwalk {

/// The picture, and its progress.
struct Box {
  Scene scene;
  RenderSettings settings;
  Film film;
  std::uint32_t samples = 0;
};

Box* box = nullptr;
Vec3 ball_kd(0), ball_ks(0.1f), ball_kt(0.9f);
float ball_eta = 1.5f;
bool ball_fresnel = false;
std::vector<std::uint8_t> screen;
std::vector<float> pixel_mean(3), told;

/// One sample of a pixel, as in common/render/render.hpp; that header needs
/// threads.
template <class PathTracer>
Vec3 sample_radiance(int column, int row, std::uint32_t sample) {
  const Scene& scene = box->scene;
  Random random(box->settings.seed,
                pixel_index(scene.camera.width, column, row), sample);
  const Ray ray = scene.camera.ray(column, row, random.uniform_2d());
  return PathTracer(scene, box->settings).radiance(ray, random);
}

using SampleRadiance = Vec3 (*)(int column, int row, std::uint32_t sample);
constexpr SampleRadiance variants[] = {LIGHTWALK_VARIANTS(sample_radiance)};

enum Piece { vertex, light_reached, light_hidden, nothing_met };

/// A piece of a path as 16 numbers: its kind, its bounce, the shape's type and
/// number, its start and its end, the throughput, and the light found before.
void tell(Piece piece, const PathVertex* at, const Vec3& from,
          const Vec3& to) {
  const auto number = [](auto x) { return static_cast<float>(x); };
  told.insert(told.end(), {number(piece), at ? number(at->bounce) : 0,
                           at ? number(at->hit.shape_type) : 0,
                           at ? number(at->hit.shape_index) : 0});
  for (const Vec3& v :
       {from, to, at ? at->throughput : Vec3(0), at ? at->sum : Vec3(0)}) {
    told.insert(told.end(), {v.x, v.y, v.z});
  }
}

/// All rays of the path in order: each hit the next vertex, or nothing.
void tell(const PathLog& log) {
  auto next = log.vertices.begin();
  for (const Ray& ray : log.rays) {
    if (next == log.vertices.end() || next->wo != -ray.direction) {
      tell(nothing_met, nullptr, ray.origin, ray.origin + ray.direction);
      continue;
    }
    tell(vertex, &*next, ray.origin, next->hit.position);
    for (const ShadowRay& shadow : next->shadow_rays) {
      const Vec3& from = shadow.ray.origin;
      tell(shadow.reached ? light_reached : light_hidden, &*next, from,
           from + shadow.distance * shadow.ray.direction);
    }
    ++next;
  }
}

enum Lighting { ceiling, lamp, point };

void light_it(Scene& scene, Lighting lighting, const Material* white) {
  const auto glowing = [&](const Vec3& ke) {
    return scene.add(Material{.ke = ke});
  };
  const Vec3 down(0, -1, 0);
  scene.add(Plane{down, 1, lighting == ceiling ? glowing(Vec3(1)) : white});
  if (lighting == lamp) {
    scene.add(Sphere{{0, 0.5f, 0}, 0.1f, glowing(Vec3(24))});
  }
  if (lighting == point) scene.add(PointLight{{0, 0.5f, 0}, Vec3(1)});
}

/// The box of scenes/cornell_box_*.toml; `diffuse` for stages 1 and 2.
void furnish(Scene& scene, Lighting lighting, bool diffuse) {
  const auto paint = [&](const Vec3& kd) {
    return scene.add(Material{.kd = kd});
  };
  const Material* white = paint(Vec3(0.8f));
  scene.add(Plane{{1, 0, 0}, 1, paint({0.8f, 0.2f, 0.2f})});
  scene.add(Plane{{-1, 0, 0}, 1, paint({0.2f, 0.8f, 0.2f})});
  scene.add(Plane{{0, 1, 0}, 1, white});
  scene.add(Plane{{0, 0, -1}, 1, white});
  const Material* left =
      diffuse
          ? paint({0.3f, 0.3f, 0.8f})
          : scene.add(Material{.kd = {0.2f, 0.2f, 0.6f}, .ks = Vec3(0.3f)});
  const Material* right = diffuse
                              ? white
                              : scene.add(Material{.kd = ball_kd,
                                                   .ks = ball_ks,
                                                   .kt = ball_kt,
                                                   .eta = ball_eta,
                                                   .fresnel = ball_fresnel});
  scene.add(Sphere{{-0.5f, -0.7f, 0.25f}, 0.3f, left});
  scene.add(Sphere{{0.5f, -0.7f, -0.25f}, 0.3f, right});
  light_it(scene, lighting, white);
  scene.prepare();
}

}  // namespace lightwalk

using namespace lightwalk;

/// The right ball, if the box is not all diffuse.
EXPORT(set_ball)
void set_ball(float kd, float ks, float kt, float eta, int fresnel) {
  ball_kd = Vec3(kd);
  ball_ks = Vec3(ks);
  ball_kt = Vec3(kt);
  ball_eta = eta;
  ball_fresnel = fresnel != 0;
}

/// Begins a picture of `size` x `size` pixels.
EXPORT(begin)
void begin(int size, int lighting, int diffuse, int max_bounces, int uniform,
           int seed) {
  delete box;
  box = new Box{{},
                {.max_bounces = max_bounces,
                 .seed = static_cast<std::uint64_t>(seed),
                 .sampling = uniform ? Sampling::uniform : Sampling::cosine},
                Film(size, size)};
  box->scene.camera.width = box->scene.camera.height = size;
  furnish(box->scene, static_cast<Lighting>(lighting), diffuse != 0);
}

/// Adds a sample to each pixel. Returns the number of samples per pixel.
EXPORT(add_pass)
int add_pass(int variant) {
  for (int row = 0; row < box->film.height(); ++row) {
    for (int column = 0; column < box->film.width(); ++column) {
      box->film.pixel(column, row)
          .add(variants[variant](column, row, box->samples));
    }
  }
  return static_cast<int>(++box->samples);
}

/// The picture for a screen, four bytes per pixel.
EXPORT(show)
const std::uint8_t* show(float exposure) {
  const Image shown = tone_map(
      box->film.radiance(),
      {.exposure = exposure, .steps = {ToneStep::clamp, ToneStep::gamma}});
  screen.clear();
  for (const Vec3& pixel : shown.pixels) {
    for (int c = 0; c < 3; ++c) {
      screen.push_back(static_cast<std::uint8_t>(255 * pixel[c] + 0.5f));
    }
    screen.push_back(255);
  }
  return screen.data();
}

/// The mean of a pixel's samples, three floats.
EXPORT(mean_of)
const float* mean_of(int column, int row) {
  const Pixel& pixel = box->film.pixel(column, row);
  for (int c = 0; c < 3; ++c) {
    pixel_mean[static_cast<std::size_t>(c)] =
        static_cast<float>(pixel.mean[c]);
  }
  return pixel_mean.data();
}

/// Follows one path again. Returns the number of its pieces.
EXPORT(follow)
int follow(int variant, int column, int row, int sample) {
  PathLog log;
  {
    const PathListener listener(log);
    const Vec3 radiance =
        variants[variant](column, row, static_cast<std::uint32_t>(sample));
    told.assign({radiance.x, radiance.y, radiance.z});
  }
  tell(log);
  return static_cast<int>(told.size() - 3) / 16;
}

/// The radiance of the followed path, then its pieces.
EXPORT(path)
const float* path() {
  return told.data();
}
