#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "common/render/paint.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

/// Radiance that shows which ray and which random numbers it was given.
struct FakeTracer {
  FakeTracer() = default;
  FakeTracer(const Scene&, const RenderSettings&) {}

  Vec3 radiance(const Ray& ray, Random& random) const {
    ++rays_cast;
    return {random.uniform(), ray.direction.x, random.uniform()};
  }
};

/// Calls `radiance` for each sample, with a camera of the film's size.
template <class Tracer>
TileRenderer renderer(const Tracer& tracer, std::uint64_t seed = 1) {
  return [&tracer, seed](const Tile& tile, Film& film,
                         const std::atomic<bool>& stop) {
    Scene scene;
    scene.camera.width = film.width();
    scene.camera.height = film.height();
    render_tile(tracer, scene, seed, tile, film, stop);
  };
}

Film rendered(int width, int height, int samples, int threads,
              std::uint64_t seed = 1) {
  Film film(width, height);
  const FakeTracer tracer;
  const std::atomic<bool> stop{false};
  RenderProgress progress;
  render(renderer(tracer, seed),
         {.samples_per_pixel = samples, .threads = threads}, film, stop,
         progress);
  return film;
}

/// How many pixels of two films differ in some bit.
int different_pixels(const Film& a, const Film& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const Pixel& p = a.pixels()[i];
    const Pixel& q = b.pixels()[i];
    bool same = p.samples == q.samples;
    for (int c = 0; c < 3; ++c) {
      same = same && p.mean[c] == q.mean[c] && p.squares[c] == q.squares[c];
    }
    count += !same;
  }
  return count;
}

constexpr std::pair<int, int> sizes[] = {{1, 1},   {7, 5},  {8, 8}, {9, 17},
                                         {33, 20}, {1, 50}, {64, 3}};

}  // namespace

// This test computes the reference without tiles, passes or threads.
TEST_CASE("a render is each pixel's samples in order, whatever its size") {
  for (const auto& size : sizes) {
    const int width = size.first, height = size.second;
    Film expected(width, height);
    Camera camera;
    camera.width = width;
    camera.height = height;
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        for (std::uint64_t sample = 0; sample < 5; ++sample) {
          Random random(1, expected.index(column, row), sample);
          const Ray ray = camera.ray(column, row, random.uniform_2d());
          expected.pixel(column, row).add(FakeTracer().radiance(ray, random));
        }
      }
    }
    CAPTURE(width);
    CAPTURE(height);
    CHECK(different_pixels(rendered(width, height, 5, 1), expected) == 0);
  }
}

TEST_CASE("any number of threads gives the same bits") {
  for (const auto& size : sizes) {
    const int width = size.first, height = size.second;
    const Film one = rendered(width, height, 9, 1);
    for (const int threads : {0, 2, 7}) {
      CAPTURE(width);
      CAPTURE(height);
      CAPTURE(threads);
      CHECK(different_pixels(rendered(width, height, 9, threads), one) == 0);
    }
  }
}

TEST_CASE("more threads than tiles do no harm") {
  CHECK(different_pixels(rendered(8, 8, 3, 64), rendered(8, 8, 3, 1)) == 0);
  CHECK(different_pixels(rendered(17, 9, 3, 64), rendered(17, 9, 3, 1)) == 0);
}

TEST_CASE("every pixel gets exactly the samples asked for") {
  for (const int samples : {1, 2, 3, 64, 65, 100, 1000}) {
    const Film film = rendered(11, 9, samples, 2);
    int wrong = 0;
    for (const Pixel& pixel : film.pixels()) {
      wrong += pixel.samples != static_cast<std::uint32_t>(samples);
    }
    CAPTURE(samples);
    CHECK(wrong == 0);
  }
}

// If a later pass used a sample's numbers again, the pixel's variance would
// still look right, but its mean would not converge.
TEST_CASE("no pass repeats the numbers of another") {
  const Film film = rendered(4, 4, 1000, 1);
  // n uniform numbers each: all 32 means are within 4.9 / sqrt(12 n).
  const double bound = 4.9 / std::sqrt(12.0 * 1000);
  for (const Pixel& pixel : film.pixels()) {
    CHECK(std::abs(pixel.mean[0] - 0.5) < bound);
    CHECK(std::abs(pixel.mean[2] - 0.5) < bound);
    CHECK(pixel.variance(0) == doctest::Approx(1.0 / 12).epsilon(0.15));
  }
}

TEST_CASE("the seed changes every pixel") {
  CHECK(different_pixels(rendered(16, 16, 4, 1, 1),
                         rendered(16, 16, 4, 1, 2)) == 256);
}

TEST_CASE("samples that are not finite are counted, and cost no pixel") {
  struct {
    Vec3 radiance(const Ray&, Random& random) const {
      return random.uniform() < 0.25f
                 ? Vec3(std::numeric_limits<float>::quiet_NaN())
                 : Vec3(2);
    }
  } const tracer;
  Film film(8, 8);
  const std::atomic<bool> stop{false};
  RenderProgress progress;
  render(renderer(tracer), {.samples_per_pixel = 100, .threads = 2}, film,
         stop, progress);
  std::uint32_t dropped = 0;
  for (const Pixel& pixel : film.pixels()) {
    CHECK(pixel.samples + pixel.dropped == 100);
    CHECK(pixel.mean[0] == 2);
    dropped += pixel.dropped;
  }
  CHECK(dropped > 64 * 20);
  CHECK(dropped < 64 * 30);
}

TEST_CASE("progress counts all samples and the rays of all threads") {
  for (const int threads : {1, 3}) {
    Film film(33, 20);
    const FakeTracer tracer;
    const std::atomic<bool> stop{false};
    RenderProgress progress;
    render(renderer(tracer), {.samples_per_pixel = 10, .threads = threads},
           film, stop, progress);
    CAPTURE(threads);
    CHECK(progress.samples == 33 * 20 * 10);
    CHECK(progress.rays == 33 * 20 * 10);
  }
}

TEST_CASE("a render that is stopped before it began leaves a black film") {
  Film film(9, 9);
  const FakeTracer tracer;
  const std::atomic<bool> stop{true};
  RenderProgress progress;
  render(renderer(tracer), {.samples_per_pixel = 10, .threads = 2}, film,
         stop, progress);
  for (const Pixel& pixel : film.pixels()) CHECK(pixel.samples == 0);
  for (const Vec3& pixel : film.radiance().pixels) CHECK(pixel == Vec3(0));
}

// 20 x 20 pixels, stopped in the middle of the pass from 4 to 8 samples. So
// each pixel has 4 or 8 samples, and they are the first of its sequence.
TEST_CASE("a render that is interrupted leaves a whole picture behind") {
  struct Interrupting {
    std::atomic<bool>& stop;
    std::atomic<int>& left;

    Vec3 radiance(const Ray& ray, Random& random) const {
      if (--left == 0) stop = true;
      return FakeTracer().radiance(ray, random);
    }
  };
  for (const int threads : {1, 2, 5}) {
    std::atomic<bool> stop{false};
    std::atomic<int> left{400 * 6};
    const Interrupting tracer{stop, left};
    Film film(20, 20);
    RenderProgress progress;
    render(renderer(tracer), {.samples_per_pixel = 1000, .threads = threads},
           film, stop, progress);

    const Film four = rendered(20, 20, 4, 1), eight = rendered(20, 20, 8, 1);
    int fewer = 0, more = 0, wrong = 0;
    for (std::size_t i = 0; i < film.pixels().size(); ++i) {
      const Pixel& pixel = film.pixels()[i];
      fewer += pixel.samples == 4;
      more += pixel.samples == 8;
      wrong += pixel.mean[0] != four.pixels()[i].mean[0] &&
               pixel.mean[0] != eight.pixels()[i].mean[0];
    }
    CAPTURE(threads);
    CHECK(fewer > 0);
    CHECK(more > 0);
    CHECK(fewer + more == 400);
    CHECK(wrong == 0);
  }
}

TEST_CASE("a picture has the film's pixels and records its settings") {
  Scene scene;
  scene.camera.width = 11;
  scene.camera.height = 9;
  const RenderResult picture = paint<FakeTracer>(
      scene, {.samples_per_pixel = 5, .max_bounces = 7, .seed = 3});
  const Film film = rendered(11, 9, 5, 1, 3);
  CHECK(picture.radiance.pixels == film.radiance().pixels);
  CHECK(picture.variance.pixels == film.variance().pixels);
  CHECK(picture.info.samples_per_pixel == 5);
  CHECK(picture.info.samples == 11 * 9 * 5);
  CHECK(picture.info.rays == 11 * 9 * 5);
  CHECK(picture.info.max_bounces == 7);
  CHECK(picture.info.seed == 3);
  CHECK(picture.info.dropped == 0);
  CHECK(!picture.info.first_dropped);
}

// A sample is dropped where its first number is below 1 %: of 40 x 30 pixels
// with 20 samples each about 240 are. This test finds the first one
// pixel by pixel; the threads reach them in any order.
TEST_CASE("the first sample that is not finite is named") {
  struct Dropping {
    Dropping(const Scene&, const RenderSettings&) {}
    Vec3 radiance(const Ray&, Random& random) const {
      return Vec3(random.uniform() < 0.01f ? infinity : 1);
    }
  };
  Scene scene;
  scene.camera.width = 40;
  scene.camera.height = 30;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    int column = -1, row = -1;
    std::uint64_t sample = 0;
    for (std::uint64_t i = 0; column < 0 && i < 40 * 30 * 20; ++i) {
      Random random(seed, i / 20, i % 20);
      random.uniform_2d();
      if (random.uniform() >= 0.01f) continue;
      column = static_cast<int>(i / 20 % 40);
      row = static_cast<int>(i / 20 / 40);
      sample = i % 20;
    }
    for (const int threads : {1, 4}) {
      const RenderInfo info = paint<Dropping>(scene, {.samples_per_pixel = 20,
                                                      .seed = seed,
                                                      .threads = threads})
                                  .info;
      CAPTURE(seed);
      CAPTURE(threads);
      CHECK(info.dropped > 100);
      CHECK(info.samples == 40 * 30 * 20);
      REQUIRE(info.first_dropped);
      CHECK(info.first_dropped->column == column);
      CHECK(info.first_dropped->row == row);
      CHECK(info.first_dropped->sample == sample);
    }
  }
}

TEST_CASE("a sample by itself is the same as in the picture") {
  Scene scene;
  scene.camera.width = 7;
  scene.camera.height = 5;
  const Film film = rendered(7, 5, 4, 2, 9);
  for (int row = 0; row < 5; ++row) {
    for (int column = 0; column < 7; ++column) {
      Pixel pixel;
      for (std::uint32_t sample = 0; sample < 4; ++sample) {
        pixel.add(
            sample_radiance(FakeTracer(), scene, 9, {column, row, sample}));
      }
      CHECK(pixel.mean[0] == film.pixels()[film.index(column, row)].mean[0]);
      CHECK(pixel.mean[1] == film.pixels()[film.index(column, row)].mean[1]);
    }
  }
}
