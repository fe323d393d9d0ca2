// Renders that end before their time: by an exception, or because they are
// stopped, even within a sample that would never end.

#include <doctest/doctest.h>

#include <atomic>
#include <stdexcept>

#include "common/program/progress.hpp"
#include "common/render/paint.hpp"

using namespace lightwalk;

namespace {

const Ray ray{{0, 0, 0}, {0, 0, 1}};

/// Casts rays forever.
Vec3 never(const Scene& scene) {
  for (Vec3 sum(0);;) {
    if (scene.nearest_hit(ray)) sum += Vec3(1);
  }
}

Scene scene_of(int width, int height) {
  Scene scene;
  scene.camera.width = width;
  scene.camera.height = height;
  return scene;
}

/// One sample throws after some others have begun, which never end.
template <class Exception>
struct Throwing {
  const Scene& scene;
  mutable std::atomic<int> begun{0};

  Throwing(const Scene& scene_, const RenderSettings&) : scene(scene_) {}
  Throwing(const Throwing& other) : scene(other.scene) {}

  Vec3 radiance(const Ray&, Random&) const {
    const int number = begun++;
    if (number < 3) return Vec3(1);
    if (number == 3) throw Exception("the fourth sample");
    return never(scene);
  }
};

struct NoStandardException {
  explicit NoStandardException(const char*) {}
};

}  // namespace

TEST_CASE("an exception of the path tracer comes out of the render") {
  Scene scene = scene_of(100, 80);
  for (const int threads : {1, 2, 8}) {
    const RenderSettings settings{.samples_per_pixel = 4, .threads = threads};
    CAPTURE(threads);
    CHECK_THROWS_WITH_AS(paint<Throwing<std::runtime_error>>(scene, settings),
                         "the fourth sample", std::runtime_error);
    CHECK_THROWS_AS(paint<Throwing<NoStandardException>>(scene, settings),
                    NoStandardException);
  }
}

TEST_CASE("a thread casts rays as before after a render that threw") {
  Scene scene = scene_of(4, 4);
  CHECK_THROWS(paint<Throwing<std::runtime_error>>(scene, {.threads = 1}));
  CHECK(ray_watcher == nullptr);
  for (int i = 0; i < 1000; ++i) scene.nearest_hit(ray);
}

// Complete samples count, and the interrupted one does not, even if the path
// tracer catches the exception that should end it.
TEST_CASE("a render can be stopped within a sample") {
  struct Endless {
    const Scene& scene;
    std::atomic<bool>& stop;
    bool catches;

    Vec3 radiance(const Ray&, Random& random) const {
      if (random.uniform() < 0.9f) return Vec3(2);
      stop = true;
      if (!catches) return never(scene);
      try {
        return never(scene);
      } catch (...) {
        return Vec3(1000);
      }
    }
  };
  const Scene scene = scene_of(40, 40);
  for (const int threads : {1, 8}) {
    for (const bool catches : {false, true}) {
      std::atomic<bool> stop{false};
      const Endless tracer{scene, stop, catches};
      Film film(40, 40);
      RenderProgress progress;
      render(
          [&](const Tile& tile, Film& into, const std::atomic<bool>& when) {
            render_tile(tracer, scene, 1, tile, into, when);
          },
          {.samples_per_pixel = 8, .threads = threads}, film, stop, progress);
      CAPTURE(threads);
      CAPTURE(catches);
      int wrong = 0;
      for (const Pixel& pixel : film.pixels()) {
        wrong += pixel.samples > 1 || pixel.dropped > 0;
        wrong += pixel.mean[0] != (pixel.samples > 0 ? 2 : 0);
      }
      CHECK(wrong == 0);
      CHECK(stop);
    }
  }
}

TEST_CASE("a render that will take absurdly long is announced") {
  const auto warning = [](double samples, double rays) {
    return cost_warning({samples, rays, 1, 2, 4e6}).value_or("");
  };
  // One second, two threads, four million samples. None is done: 2e6 s.
  CHECK(warning(0, 2e7) ==
        "each sample follows more than 10 M rays; the picture would take "
        "more than 23 days; fewer --max-bounces take less");
  // 398 are done: 1e4 s.
  CHECK(warning(398, 2e7) ==
        "each sample follows about 50 k rays; the picture would take about 3 "
        "hours; fewer --max-bounces take less");
  // Many rays, but only a quarter of an hour; hours, but only few rays.
  CHECK(warning(4000, 2e7) == "");
  CHECK(warning(398, 2e5) == "");
  // A render that has just begun.
  CHECK(warning(0, 0) == "");
}
