// Where photons go, what they lose on the way, and where they are stored.

#include <doctest/doctest.h>

#include <cstring>

#include "stages/7_photon_mapping/path_tracer.hpp"
#include "support/exact_radiance.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using namespace lightwalk::stage7;

namespace {

std::vector<Photon> photons_of(const Scene& scene,
                               const RenderSettings& settings,
                               std::uint64_t map = 0) {
  const std::atomic<bool> stop{false};
  RenderProgress progress;
  return trace_photons(scene, settings, map, stop, progress).points();
}

RenderSettings with_photons(int photons, int max_bounces = bounce_cap) {
  RenderSettings settings;
  settings.photons = photons;
  settings.max_bounces = max_bounces;
  settings.threads = 1;
  return settings;
}

/// What each of many photons of power 1 brings to diffuse surfaces in all:
/// the sum of its power over the places where it is stored.
Pixel brought(const Scene& scene, const Vec3& from, int photons,
              int max_bounces = bounce_cap) {
  Pixel pixel;
  for (int i = 0; i < photons; ++i) {
    Random random(3, 0, static_cast<std::uint64_t>(i));
    const Vec3 direction = sample_sphere(random.uniform_2d());
    std::vector<Photon> stored;
    follow_photon(scene, with_photons(1, max_bounces), {from, direction},
                  Vec3(1), random, stored);
    Vec3 sum(0);
    for (const Photon& photon : stored) sum += photon.power;
    pixel.add(sum);
  }
  return pixel;
}

/// A surface with all lobes, and a sample of one of them.
struct Sampled {
  Hit hit{};
  Material material;
  BsdfSample next;
  Vec3 weight;  ///< of power
};

Sampled sampled(Lobe lobe, const Vec3& wo) {
  Sampled result;
  result.material = {.kd = {0.3f, 0.2f, 0.1f},
                     .ks = {0.1f, 0.2f, 0.3f},
                     .kt = {0.4f, 0.5f, 0.6f}};
  result.hit.normal = {0, 1, 0};
  result.hit.material = &result.material;
  const Surface surface(result.hit, result.material, normalize(wo));
  Random random(1, 2, 3);
  result.next = stage3::sample(lobe, surface, Sampling::cosine, random);
  result.weight = power_weight(surface, result.next);
  return result;
}

std::string room(const std::string& wall) {
  return "[materials]\nwall = " + wall +
         "\nglass = { ks = 0.1, kt = 0.9 }\nmirror = { ks = 1 }\n" +
         text::sphere("0, 0, 0", "2", "wall");
}

}  // namespace

TEST_SUITE_BEGIN("units");

// Radiance gets (eta_o/eta_i)^2 in refraction, and power does not.
TEST_CASE("what refraction leaves of power is kt, from either side") {
  const Sampled in = sampled(Lobe::refraction, {0.6f, 0.8f, 0});
  CHECK(in.next.wi.y < 0);
  check_color("power that goes in", in.weight, in.material.kt);
  const Sampled out = sampled(Lobe::refraction, {0.3f, -0.8f, 0});
  CHECK(out.next.wi.y > 0);
  check_color("power that goes out", out.weight, out.material.kt);
}

TEST_CASE("total internal reflection leaves kt of the power") {
  const Sampled total = sampled(Lobe::refraction, {0.8f, -0.6f, 0});
  CHECK(total.next.wi.y < 0);
  check_color("power that stays inside", total.weight, total.material.kt);
}

TEST_CASE("a mirror leaves ks of the power, and a diffuse surface kd") {
  for (const float side : {1.0f, -1.0f}) {
    const Vec3 wo(0.6f, 0.8f * side, 0);
    const Sampled mirrored = sampled(Lobe::specular, wo);
    check_color("mirrored power", mirrored.weight, mirrored.material.ks);
    const Sampled diffuse = sampled(Lobe::diffuse, wo);
    check_color("scattered power", diffuse.weight, diffuse.material.kd);
  }
}

TEST_CASE("photons are stored where they are, on the side that they lit") {
  const Scene scene = scene_text("[materials]\nwall = { kd = 0.5 }\n" +
                                 text::plane("0, 1, 0", "1", "wall") +
                                 text::plane("0, 1, 0", "-1", "wall") +
                                 text::point_light("0, 0, 0", "1"));
  const std::vector<Photon> photons = photons_of(scene, with_photons(2000));
  CHECK(photons.size() > 500);
  for (const Photon& photon : photons) {
    const float side = photon.position.y > 0 ? -1.0f : 1.0f;
    CHECK(photon.normal == Vec3(0, side, 0));
    require_value("height of the photon", red(Vec3(photon.position.y)),
                  -red(Vec3(side)), 1e-5);
  }
}

TEST_CASE("direct light is not stored, and bounces are counted from it") {
  const Scene scene =
      scene_text(room("{ kd = 0.9 }") + text::point_light("0, 0, 0", "1"));
  CHECK(photons_of(scene, with_photons(1000, 1)).empty());
  int of_one_bounce = 0;
  for (const Photon& photon : photons_of(scene, with_photons(1000, 4))) {
    if (photon.bounces < 1 || photon.bounces > 3) {
      FAIL_CHECK("a photon has " << photon.bounces
                                 << " bounces, expected 1 to 3");
      break;
    }
    of_one_bounce += photon.bounces == 1;
  }
  CHECK(of_one_bounce > 800);
}

TEST_CASE("mirrors and glass store no photons") {
  const Scene scene = scene_text(room("{ kd = 0.5 }") +
                                 text::sphere("1, 0, 0", "0.5", "mirror") +
                                 text::sphere("-1, 0, 0", "0.5", "glass") +
                                 text::point_light("0, 0, 0", "1"));
  int on_the_wall = 0, elsewhere = 0;
  for (const Photon& photon : photons_of(scene, with_photons(2000))) {
    ++(length(photon.position) > 1.9f ? on_the_wall : elsewhere);
  }
  CHECK(on_the_wall > 1000);
  CHECK(elsewhere == 0);
}

TEST_CASE("the same photons with any number of threads, others in each map") {
  const Scene scene = scene_file("cornell_box_point");
  RenderSettings settings = with_photons(5432);
  const auto same = [](const std::vector<Photon>& a,
                       const std::vector<Photon>& b) {
    return a.size() == b.size() &&
           std::memcmp(a.data(), b.data(), a.size() * sizeof(Photon)) == 0;
  };
  const std::vector<Photon> one = photons_of(scene, settings);
  for (const int threads : {2, 3, 8}) {
    settings.threads = threads;
    CAPTURE(threads);
    CHECK(same(photons_of(scene, settings), one));
  }
  CHECK(!same(photons_of(scene, settings, 1), one));
  settings.seed = 2;
  CHECK(!same(photons_of(scene, settings), one));
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("analytic scenes");

// Within a closed wall, each bounce leaves kd of the power: after b bounces
// kd^b arrives, in each channel. Direct light is not stored. So the sum is
// kd + kd^2 + ... = kd/(1 - kd).
TEST_CASE("a wall around a light gets kd + kd^2 + ... of its power") {
  const Scene scene = scene_text(room("{ kd = [0.8, 0.2, 0.5] }"));
  const Pixel all = brought(scene, {0.5f, 0.2f, 0}, 20'000);
  const double kd[] = {0.8, 0.2, 0.5};
  for (int c = 0; c < 3; ++c) {
    check_mean("power on the wall", all, c, kd[c] / (1 - kd[c]), 1e-4);
  }
  const Pixel two = brought(scene, {0.5f, 0.2f, 0}, 20'000, 3);
  for (int c = 0; c < 3; ++c) {
    check_mean("power on the wall, at most 2 bounces before it", two, c,
               kd[c] + kd[c] * kd[c], 1e-4);
  }
}

// Power in = power absorbed. Mirrors and glass with ks + kt = 1 absorb
// nothing, and the wall absorbs half of what arrives. So 2 arrives there in
// all. What comes straight from the light is not stored: the share of the
// directions that no ball hides. A ball of radius r at the distance d hides
// (1 - cos a)/2 with sin a = r/d.
TEST_CASE("the power that leaves a light is absorbed somewhere") {
  const Scene scene = scene_text(room("{ kd = 0.5 }") +
                                 text::sphere("1, 0, 0", "0.6", "mirror") +
                                 text::sphere("-1, 0, 0", "0.8", "glass"));
  const double hidden =
      (1 - std::sqrt(1 - 0.36)) / 2 + (1 - std::sqrt(1 - 0.64)) / 2;
  const Pixel all = brought(scene, {0, 0, 0}, 20'000);
  check_mean("power on the wall", all, 0, 2 - (1 - hidden), 1e-4);
}

// Under a ball is a mirror, and all else is open. What the ball gets by the
// mirror is ks times the share of the directions that it fills, seen from the
// light's image in the mirror: (1 - cos a)/2 with sin a = r/d.
TEST_CASE("the power that escapes is missing, and no other") {
  const Scene scene =
      scene_text("[materials]\nmirror = { ks = 0.8 }\nwall = { kd = 0.5 }\n" +
                 text::plane("0, 1, 0", "1", "mirror") +
                 text::sphere("0, 4, 0", "1", "wall"));
  const Pixel one = brought(scene, {0, 0, 0}, 40'000, 2);
  // Seen in the mirror the light is at (0, -2, 0), 6 below the ball.
  const double share = (1 - std::sqrt(1 - 1 / 36.0)) / 2;
  check_mean("power on the ball by the mirror", one, 0, 0.8 * share, 1e-4);
}

// Below y = 0 all is glass, with a diffuse floor in it. Half of the light
// goes down, and kt of it into the glass. There is no mirror, so this is what
// arrives, wherever it is bent to.
TEST_CASE("a floor in glass gets kt of the power that goes down") {
  const Scene scene = scene_text(
      "[materials]\nglass = { kt = [0.9, 0.6, 0.3], eta = 1.5 }\n"
      "floor = { kd = 0.5 }\n" +
      text::plane("0, 1, 0", "0", "glass") +
      text::plane("0, 1, 0", "1", "floor"));
  const Pixel pixel = brought(scene, {0, 1, 0}, 20'000, 2);
  const double kt[] = {0.9, 0.6, 0.3};
  for (int c = 0; c < 3; ++c) {
    check_mean("power on a floor in glass", pixel, c, kt[c] / 2, 1e-4);
  }
}

TEST_SUITE_END();
