// The cost of rendering: samples and rays per second of each stage, the time
// of the parts of a path, and how both grow with the size of their input. The
// names are stage/scene/threads, or part/size.

#include <benchmark/benchmark.h>

#include <cmath>
#include <string>
#include <thread>

#include "all_stages.hpp"
#include "common/render/paint.hpp"
#include "common/scene_file/scene_file.hpp"
#include "stages/introductions.hpp"

using namespace lightwalk;

namespace {

struct Work {
  int size = 128, samples = 4, threads = 1, bounces = bounce_cap;
};

/// Renders until the time is up, and reports samples and rays per second.
template <class PathTracer>
void time_of_painting(benchmark::State& state, Scene& scene,
                      const Work& work) {
  scene.camera.width = scene.camera.height = work.size;
  const RenderSettings settings{.samples_per_pixel = work.samples,
                                .max_bounces = work.bounces,
                                .threads = work.threads};
  std::uint64_t samples = 0, rays = 0;
  for (auto _ : state) {
    const RenderResult picture = paint<PathTracer>(scene, settings);
    samples += picture.info.samples;
    rays += picture.info.rays;
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(samples));
  state.counters["rays/s"] = benchmark::Counter(static_cast<double>(rays),
                                                benchmark::Counter::kIsRate);
}

/// `stages/N` renders a scene of the folder scenes/.
template <class PathTracer>
void add_stage(int stage, const std::string& scene_name, Work work) {
  const int all = static_cast<int>(std::thread::hardware_concurrency());
  for (const int threads : {1, all}) {
    work.threads = threads;
    const std::string name = "stage" + std::to_string(stage) + "/" +
                             scene_name +
                             "/threads:" + std::to_string(threads);
    benchmark::RegisterBenchmark(
        name.c_str(),
        [stage, scene_name, work](benchmark::State& state) {
          LoadedScene loaded =
              load_scene(SCENES + scene_name + ".toml", syllabus(stage));
          time_of_painting<PathTracer>(state, loaded.scene, work);
        })
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
    if (all == 1) return;
  }
}

Vec3 random_position(Random& random) {
  const Vec2 xy = random.uniform_2d();
  const float z = random.uniform();
  return 2.0f * Vec3(xy.x, xy.y, z) - 1.0f;
}

/// The lab's box without its balls, with `count` small shapes floating in it.
Scene crowded_box(std::int64_t count, bool triangles) {
  Scene scene;
  Material white;
  white.kd = Vec3(0.8f);
  const Material* material = scene.add(white);
  for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0),
                             Vec3(0, -1, 0), Vec3(0, 0, -1)}) {
    scene.add(Plane{normal, 1, material});
  }
  Random random(1, 0, 0);
  const float size = 2 / std::cbrt(static_cast<float>(count));
  for (std::int64_t i = 0; i < count; ++i) {
    const Vec3 place = random_position(random);
    if (triangles) {
      const Vec3 u = 0.5f * size * random_position(random);
      const Vec3 v = 0.5f * size * random_position(random);
      scene.add(Triangle(place, u, v, material));
    } else {
      scene.add(Sphere{place, 0.25f * size, material});
    }
  }
  scene.add(PointLight{{0, 0.95f, -1.5f}, Vec3(1)});
  scene.prepare();
  return scene;
}

void cost_of_shapes(benchmark::State& state, bool triangles) {
  Scene scene = crowded_box(state.range(0), triangles);
  time_of_painting<stage4::PathTracer>(state, scene,
                                       {.size = 64, .samples = 2});
}

void cost_of_building(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(crowded_box(state.range(0), false));
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void cost_of(benchmark::State& state, int Work::*what) {
  Work work;
  work.*what = static_cast<int>(state.range(0));
  LoadedScene loaded =
      load_scene(SCENES "cornell_box_point.toml", syllabus(4));
  time_of_painting<stage4::PathTracer>(state, loaded.scene, work);
}

void nearest_hit(benchmark::State& state) {
  const Scene scene = crowded_box(state.range(0), false);
  Random random(2, 0, 0);
  for (auto _ : state) {
    const Vec3 from = random_position(random);
    const Vec3 way = normalize(random_position(random));
    benchmark::DoNotOptimize(scene.nearest_hit({from, way}));
  }
  state.SetItemsProcessed(state.iterations());
}

void occluded(benchmark::State& state) {
  const Scene scene = crowded_box(state.range(0), false);
  Random random(3, 0, 0);
  for (auto _ : state) {
    const Vec3 from = random_position(random);
    const Vec3 to = random_position(random);
    const Ray ray{from, normalize(to - from)};
    benchmark::DoNotOptimize(scene.geometry.occluded(ray, length(to - from)));
  }
  state.SetItemsProcessed(state.iterations());
}

using Sampler = Vec3 (*)(const Vec3& normal, const Vec2& u);

void hemisphere(benchmark::State& state, Sampler sampler) {
  Random random(4, 0, 0);
  const Vec3 normal = normalize(Vec3(1, 2, 3));
  for (auto _ : state) {
    benchmark::DoNotOptimize(sampler(normal, random.uniform_2d()));
  }
  state.SetItemsProcessed(state.iterations());
}

void random_number(benchmark::State& state) {
  Random random(5, 0, 0);
  for (auto _ : state) benchmark::DoNotOptimize(random.uniform());
  state.SetItemsProcessed(state.iterations());
}

// The parts of a path.
BENCHMARK(nearest_hit)->Arg(2)->Arg(10)->Arg(1000);
BENCHMARK(occluded)->Arg(2)->Arg(10)->Arg(1000);
BENCHMARK_CAPTURE(hemisphere, uniform, stage1::sample_uniform_hemisphere);
BENCHMARK_CAPTURE(hemisphere, cosine, stage1::sample_cosine_hemisphere);
BENCHMARK(random_number);

// What grows with size, and how much.
BENCHMARK_CAPTURE(cost_of, image_size, &Work::size)
    ->RangeMultiplier(4)
    ->Range(16, 256)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cost_of, samples, &Work::samples)
    ->RangeMultiplier(4)
    ->Range(1, 64)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cost_of, bounces, &Work::bounces)
    ->RangeMultiplier(2)
    ->Range(1, 64)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cost_of_shapes, spheres, false)
    ->RangeMultiplier(10)
    ->Range(10, 1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(cost_of_shapes, triangles, true)
    ->RangeMultiplier(10)
    ->Range(10, 1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(cost_of_building)
    ->Arg(1000)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);

// The stages, each with the boxes that it can render.
const bool stages_are_registered = [] {
  tests::for_each_stage([]<class PathTracer>(int stage) {
    const std::string diffuse = stage < 3 ? "_diffuse" : "";
    Work work;
    if (stage < 4) work.bounces = stage < 3 ? 8 : 6;
    add_stage<PathTracer>(stage, "cornell_box_ceiling" + diffuse, work);
    if (stage < 2) return;
    add_stage<PathTracer>(stage, "cornell_box_point" + diffuse, work);
    if (stage < 5) return;
    add_stage<PathTracer>(stage, "textured_globe", work);
  });
  return true;
}();

}  // namespace
