// The whole stage: pictures whose light is known, and the other stages'.

#include <doctest/doctest.h>

#include "stage.hpp"
#include "support/bounce_bounds.hpp"
#include "support/comparisons.hpp"
#include "support/first_things.hpp"
#include "support/goldens.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

RenderSettings with_photons(int photons, int neighbors, int max_bounces,
                            std::uint64_t seed = 1) {
  RenderSettings settings;
  settings.photons = photons;
  settings.neighbors = neighbors;
  settings.max_bounces = max_bounces;
  settings.seed = seed;
  settings.threads = 1;
  return settings;
}

/// The radiance along a ray by many maps. `make(seed)` makes a path tracer
/// with the photons of that number.
template <class Make>
Pixel by_many_maps(const Ray& ray, int maps, Make make) {
  Pixel pixel;
  for (int i = 0; i < maps; ++i) {
    Random random(1, 0, static_cast<std::uint64_t>(i));
    pixel.add(make(static_cast<std::uint32_t>(i)).radiance(ray, random));
  }
  return pixel;
}

/// The mean of a picture with one sample of each pixel.
template <class PathTracer>
Vec3 mean_of(Scene& scene, RenderSettings settings) {
  settings.samples_per_pixel = 1;
  const RenderResult picture = paint<PathTracer>(scene, settings);
  DoubleVec3 sum(0);
  for (const Vec3& one : picture.radiance.pixels) sum += DoubleVec3(one);
  return Vec3(sum / double(picture.radiance.pixels.size()));
}

/// The means of the pictures by samples 0, 1, 2, ...
template <class PathTracer>
Pixel means_of(Scene& scene, RenderSettings settings, int pictures) {
  Pixel pixel;
  for (int i = 0; i < pictures; ++i) {
    settings.first_sample = static_cast<std::uint32_t>(i);
    pixel.add(mean_of<PathTracer>(scene, settings));
  }
  return pixel;
}

double sigma(const Pixel& pixel, int channel) {
  return std::sqrt(pixel.variance(channel) / pixel.samples);
}

std::string room(const std::string& wall) {
  return "[materials]\nwall = " + wall +
         "\nlamp = { ke = 3 }\nmirror = { ks = 1 }\n" +
         text::sphere("0, 0, 0", "1", "wall");
}

const Ray at_wall{{0.6f, 0, 0}, {1, 0, 0}};

}  // namespace

TEST_SUITE_BEGIN("units");

TEST_CASE("a ray that meets nothing brings the background") {
  check_nothing_is_black<PathTracer>();
}

TEST_CASE(
    "without bounces there are the lamps alone, with one direct light") {
  const Scene scene = scene_text(
      room("{ kd = 0.5 }") + text::sphere("0, 0, 0", "0.5", "lamp") +
      text::point_light("0.7, 0, 0", "3.14159265"));
  // From (0.7, 0, 0) the wall at (1, 0, 0) is 0.3 away, and gets pi/0.09; the
  // lamp fills a quarter of its sky.
  for (const int bounces : {0, 1}) {
    check_radiance<PathTracer>("the lamp", scene, {{0.6f, 0, 0}, {-1, 0, 0}},
                               with_bounces(bounces), DoubleVec3(3));
    check_radiance<PathTracer>(
        "the wall", scene, at_wall, with_bounces(bounces),
        DoubleVec3(bounces * 0.5 * (1 / 0.09 + 3.0 / 4)));
  }
}

// --pixel prints it.
TEST_CASE("the log tells what the photons bring, and what else there is") {
  const Scene scene = scene_text(room("{ kd = 0.5 }") +
                                 text::point_light("0, 0, 0", "3.14159265"));
  const PathTracer tracer(scene, with_photons(2000, 20, 4));
  PathLog log;
  const PathListener listener(log);
  Random random(1, 0, 0);
  const Vec3 radiance = tracer.radiance(at_wall, random);
  REQUIRE(log.vertices.size() == 1);
  CHECK(log.vertices[0].shadow_rays.size() == 1);
  REQUIRE(log.vertices[0].photons.has_value());
  const auto& [count, radius, light] = *log.vertices[0].photons;
  CHECK(count == 19);  // the 20th is on the rim
  check_color("direct light is the rest", radiance - light, Vec3(0.5f), 1e-3);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("analytic scenes");

// A light of intensity pi in the middle of a sphere of radius 1: each bounce
// brings kd^n. Photons are uniform on the wall, and independent of each
// other. A ball of radius r about a point of a sphere cuts a cap of the area
// pi r^2 from it, exactly. So with any number of photons the mean is right.
TEST_CASE("photons in a sphere: at most N bounces, N terms") {
  const Scene scene = scene_text(room("{ kd = [0.5, 0.8, 0.2] }") +
                                 text::point_light("0, 0, 0", "3.14159265"));
  const double kd[] = {0.5, 0.8, 0.2};
  for (const int bounces : {2, 3, 6}) {
    const Pixel pixel = by_many_maps(at_wall, 1500, [&](std::uint32_t seed) {
      return PathTracer(scene, with_photons(100, 10, bounces, seed));
    });
    CAPTURE(bounces);
    for (int c = 0; c < 3; ++c) {
      check_mean("a wall around a point light", pixel, c,
                 kd[c] * power_series(kd[c], bounces), 1e-4);
    }
  }
}

// The same, while the radius shrinks: maps 1, 2, 3, ... have smaller disks.
TEST_CASE("photons in a sphere, with a radius that shrinks") {
  const Scene scene = scene_text(room("{ kd = 0.5 }") +
                                 text::point_light("0, 0, 0", "3.14159265"));
  for (const Filter filter : {Filter::box, Filter::cone}) {
    RenderSettings settings = with_photons(100, 10, 3);
    settings.filter = filter;
    const Pixel pixel = by_many_maps(at_wall, 1500, [&](std::uint32_t map) {
      return PathTracer(scene, settings, map);
    });
    check_mean("a wall around a point light", pixel, 0,
               0.5 * power_series(0.5, 3), 1e-4);
  }
}

// A ball of radius 1/2 that shines fills a quarter of the wall's sky: L = kd
// ke/4 (1 + q + ...) with q = kd 3/4.
TEST_CASE("photons of a lamp in a sphere") {
  const Scene scene = scene_text(room("{ kd = 0.8 }") +
                                 text::sphere("0, 0, 0", "0.5", "lamp"));
  const Pixel pixel = by_many_maps(at_wall, 1500, [&](std::uint32_t seed) {
    return PathTracer(scene, with_photons(100, 10, 2, seed));
  });
  const double direct = 0.8 * 3 / 4, second = direct * 0.8 * 0.75;
  check_mean("a wall around a lamp", pixel, 0, direct + second, 1e-4);
}

// A wall that is also a mirror: q = kd + ks of the power goes on at each
// bounce, so the diffuse lobe sends out D_N = kd (1 + q + ... + q^(N-1)). The
// path sees it directly and in the mirrors: L = D_3 + ks D_2 + ks^2 D_1. A
// path tracer finds less: the light's image in the mirror is a point.
TEST_CASE("photons on a wall with two lobes") {
  const Scene scene = scene_text(room("{ kd = 0.4, ks = [0.3, 0.15, 0.1] }") +
                                 text::point_light("0, 0, 0", "3.14159265"));
  const RenderSettings settings = with_photons(200, 10, 3);
  const Ray slanted{{0.2f, 0.1f, -0.3f}, {0, 0.6f, 0.8f}};
  const Pixel pixel = by_many_maps(slanted, 3000, [&](std::uint32_t map) {
    return PathTracer(scene, settings, map);
  });
  const double ks[] = {0.3, 0.15, 0.1};
  for (int c = 0; c < 3; ++c) {
    const double q = 0.4 + ks[c];
    check_mean("a wall around a point light", pixel, c,
               0.4 * (power_series(q, 3) + ks[c] * power_series(q, 2) +
                      ks[c] * ks[c]),
               1e-4);
  }
}

// A wall between: the light is behind it, and in front all is black. The plane
// behind the light faces the same way, but is farther off than the radius.
TEST_CASE("a thin wall is dark on its back") {
  const Scene scene = scene_text(
      "[materials]\nwall = { kd = 0.8 }\n" +
      text::rectangle("-9, -9, 0", "18, 0, 0", "0, 18, 0", "wall") +
      text::plane("0, 0, -1", "1", "wall") +
      text::point_light("0, 0, 0.5", "3"));
  RenderSettings settings = with_photons(20'000, 20, 8);
  settings.radius = 0.5f;
  const PathTracer tracer(scene, settings);
  Random random(1, 0, 0);
  check_color("the dark side",
              tracer.radiance({{0, 0, -1}, {0, 0, 1}}, random), Vec3(0));
  Random again(1, 0, 1);
  CHECK(max_component(tracer.radiance({{0.1f, 0, 0.9f}, {0, 0, -1}}, again)) >
        0.5f);
}

TEST_CASE("a lamp in a mirror counts, and in a diffuse surface only once") {
  const Scene scene = scene_text(room("{ ks = 0.5 }") +
                                 text::sphere("0, 0, 0", "0.5", "lamp"));
  check_radiance<PathTracer>("a lamp in a mirror", scene, at_wall,
                             with_bounces(1), DoubleVec3(1.5));
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("relations");

// No photon starts on an emitter that is no light. So all is found by paths,
// with the random numbers of stage 5.
TEST_CASE("by emitters that are no lights, every sample is stage 5's") {
  const Scene scene = scene_file("cornell_box_ceiling", 16, 16);
  const stage5::PathTracer paths(scene, {});
  const PathTracer photons(scene, {});
  for (int i = 0; i < 512; ++i) {
    Random first(3, 0, static_cast<std::uint64_t>(i));
    Random second = first;
    const Ray ray = scene.camera.ray(i % 16, (i / 16) % 16, Vec2(0.5f));
    const Vec3 expected = paths.radiance(ray, first);
    const Vec3 actual = photons.radiance(ray, second);
    if (actual != expected) {
      FAIL_CHECK("sample " << i << " is " << text_of(actual)
                           << ", and in stage 5 " << text_of(expected));
      break;
    }
  }
}

// A path that goes on for the light of a plane has gathered the lamp's at its
// first diffuse vertex. So with the same random numbers, plane and lamp
// together bring the sum of what each brings alone. A black ceiling stands for
// one that does not shine, and ends paths and photons as well.
TEST_CASE(
    "a lamp beside a shining plane is asked once, also behind mirrors") {
  const auto box = [](const std::string& ceiling, const std::string& lamp) {
    return scene_text(
        "[materials]\nwall = { kd = 0.5, ks = 0.4 }\nceiling = " + ceiling +
        "\n" + text::plane("0, 1, 0", "1", "wall") +
        text::plane("0, 0, -1", "1", "wall") +
        text::plane("0, 0, 1", "1", "wall") +
        text::plane("0, -1, 0", "1", "ceiling") +
        text::point_light("0, 0.3, 0", lamp));
  };
  const Scene both = box("{ ke = 1 }", "3");
  const Scene plane = box("{ ke = 1 }", "1e-20");
  const Scene lamp = box("{ kd = 0 }", "3");
  const RenderSettings settings = with_photons(2000, 20, 20);
  const PathTracer of_both(both, settings), of_plane(plane, settings),
      of_lamp(lamp, settings);
  const Ray slanted{{0.1f, 0.2f, -0.3f}, {0.36f, -0.48f, 0.8f}};
  for (std::uint64_t i = 0; i < 500; ++i) {
    Random random(5, 0, i);
    Random again = random, once_more = random;
    const Vec3 sum = of_plane.radiance(slanted, again) +
                     of_lamp.radiance(slanted, once_more);
    const Vec3 actual = of_both.radiance(slanted, random);
    if (max_abs_component(actual - sum) > 1e-4f * max_component(sum)) {
      FAIL_CHECK("sample " << i << " is " << text_of(actual)
                           << ", and plane and lamp alone bring "
                           << text_of(sum));
      break;
    }
  }
}

// Where the disk hangs over an edge, light is missing. By the cone, the mean
// of |x| over the disk is r/pi, and half of it hangs over: along each edge a
// strip of r/(2 pi) is lost. The box has walls of 2 x 2, and no edge at its
// open front: at most 4 edges of length 2 on an area of 4. So at most the
// share r/pi of the photons' light is missing, and nothing comes in addition:
// the light is nearly linear across a disk of this size.
TEST_CASE("a diffuse box is stage 2's, but for the edges") {
  Scene scene = scene_file("cornell_box_point_diffuse", 16, 16);
  const int maps = 24;
  const RenderSettings settings = with_photons(4000, 8, bounce_cap);
  const Pixel photons = means_of<PathTracer>(scene, settings, maps);
  const Pixel paths =
      means_of<stage2::PathTracer>(scene, with_photons(1, 8, 100), 4 * maps);
  // 4000 photons are stored some 13,000 times on 5 walls and two balls, an
  // area of 22.3: 8 of them have r = 0.066, and r falls by sqrt(s_i).
  double squared_scale = 1, radius = 0;
  for (std::uint32_t i = 1; i <= maps; ++i) {
    radius += 0.066 * std::sqrt(squared_scale) / maps;
    squared_scale = stage7::next_squared_scale(squared_scale, i);
  }
  for (int c = 0; c < 3; ++c) {
    const double noise =
        max_deviations * std::hypot(sigma(photons, c), sigma(paths, c));
    const double edges = radius / 3.14159 * paths.mean[c];
    INFO("channel ", c, ": ", photons.mean[c], " by photons, ", paths.mean[c],
         " by paths, noise ", noise, ", missing at the edges at most ",
         edges);
    CHECK(photons.mean[c] < paths.mean[c] + noise);
    CHECK(photons.mean[c] > paths.mean[c] - edges - noise);
  }
}

// A lamp of radius 0.2 over a glass ball, so large that paths find it through
// the ball by chance. The camera looks under the ball, at the bright spot. The
// photons' disks blur it, by a bias in proportion to the squared radius, and
// so to k. So twice the result for k less that for 2k has none.
TEST_CASE("the caustic of a glass ball is that of brute force") {
  Scene scene = scene_text(
      "[camera]\norigin = [1.2, -0.7, 0]\nleft = [0, 0, 0.15]\n"
      "up = [0, 0.06, 0]\nforward = [-1.2, -0.3, 0]\nsize = [6, 6]\n"
      "[materials]\nfloor = { kd = 0.8 }\nglass = { ks = 0.1, kt = 0.9 }\n"
      "lamp = { ke = 25 }\n" +
      text::plane("0, 1, 0", "1", "floor") +
      text::sphere("0, -0.5, 0", "0.4", "glass") +
      text::sphere("0, 1.5, 0", "0.2", "lamp"));
  const int k = 8;
  Pixel photons;
  for (std::uint32_t i = 0; i < 60; ++i) {
    RenderSettings sharp = with_photons(20'000, k, bounce_cap);
    sharp.first_sample = i;
    RenderSettings blurred = sharp;
    blurred.neighbors = 2 * k;
    photons.add(2.0f * mean_of<PathTracer>(scene, sharp) -
                mean_of<PathTracer>(scene, blurred));
  }
  const Pixel paths = means_of<stage5::PathTracer>(
      scene, with_photons(1, 2, bounce_cap), 6000);
  const double noise = std::hypot(sigma(photons, 0), sigma(paths, 0));
  INFO(photons.mean[0], " by photons, ", paths.mean[0],
       " by paths; the noise is ", noise);
  CHECK(std::abs(photons.mean[0] - paths.mean[0]) < max_deviations * noise);
  // Most of this light goes through the glass.
  const Pixel direct =
      means_of<stage5::PathTracer>(scene, with_photons(1, 2, 1), 40);
  CHECK(direct.mean[0] < 0.2 * paths.mean[0]);
}

TEST_CASE("threads do not change a bit, seeds do") {
  Scene scene = scene_file("cornell_box_point", 20, 15);
  RenderSettings settings = with_photons(3000, 10, bounce_cap);
  settings.samples_per_pixel = 3;
  const RenderResult one = paint<PathTracer>(scene, settings);
  CHECK(one.info.dropped == 0);
  for (const int threads : {2, 7}) {
    settings.threads = threads;
    CAPTURE(threads);
    const RenderResult again = paint<PathTracer>(scene, settings);
    check_same_bits(again, one);
    CHECK(again.info.rays == one.info.rays);
  }
  settings.seed = 2;
  check_other_noise(paint<PathTracer>(scene, settings), one);
}

// stage-merge joins them: the first map has the same photons in each part.
TEST_CASE("two halves of the samples are the picture") {
  Scene scene = scene_file("cornell_box_point", 12, 12);
  RenderSettings settings = with_photons(2000, 10, bounce_cap);
  settings.samples_per_pixel = 6;
  const Image whole = paint<PathTracer>(scene, settings).radiance;
  settings.samples_per_pixel = 3;
  const Image first = paint<PathTracer>(scene, settings).radiance;
  settings.first_sample = 3;
  const Image second = paint<PathTracer>(scene, settings).radiance;
  for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
    require_color("the mean of both halves",
                  0.5f * (first.pixels[i] + second.pixels[i]),
                  whole.pixels[i], 1e-5);
  }
}

// --pixel tells the sample that is in the picture.
TEST_CASE("a single sample is that of the picture") {
  Scene scene = scene_file("cornell_box_point", 8, 8);
  RenderSettings settings = with_photons(2000, 10, bounce_cap);
  settings.samples_per_pixel = 1;
  settings.first_sample = 5;
  const Image picture = paint<PathTracer>(scene, settings).radiance;
  const PathTracer tracer(scene, settings, 5);
  for (int row = 0; row < 8; ++row) {
    require_color("pixel 4 of a row",
                  sample_radiance(tracer, scene, 1, {4, row, 5}),
                  picture.at(4, row), 1e-6);
  }
}

TEST_CASE("a render that is stopped leaves no part of a pass behind") {
  const Scene scene = scene_file("cornell_box_point", 8, 8);
  Film film(8, 8);
  RenderProgress progress;
  const std::atomic<bool> stop{true};
  PathTracer::render(scene, with_photons(2000, 10, 8), film, stop, progress);
  for (const Pixel& pixel : film.pixels()) CHECK(pixel.samples == 0);
}

TEST_SUITE_END();

// Last of all: a failure of any other test says more. The golden images have the
// bias of the pictures that they are compared with.
TEST_SUITE_BEGIN("golden images");

TEST_CASE("golden images: the pictures of the stage") {
  check_goldens<PathTracer>(7);
}

TEST_SUITE_END();
