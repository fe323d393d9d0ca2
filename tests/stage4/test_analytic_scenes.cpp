// Scenes whose mean, variance and path length are known.

#include <doctest/doctest.h>

#include "stages/4_russian_roulette/path_tracer.hpp"
#include "support/each_or_mean.hpp"
#include "support/expectations.hpp"
#include "support/specular_scenes.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage4::PathTracer;

TEST_SUITE_BEGIN("analytic scenes");

namespace {

// A diffuse sphere from inside, with a point light of intensity pi in its
// center: each hit sees the light with radiance kd.
std::string lit_sphere(const std::string& kd) {
  return "[materials]\nwall = { kd = " + kd +
         " }\n[[shapes]]\ntype = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\n"
         "material = \"wall\"\n[[lights]]\ntype = \"point\"\n"
         "center = [0, 0, 0]\nintensity = 3.14159265\n";
}

const Ray inside{{0.2f, 0.1f, -0.3f}, {0, 0, 1}};

}  // namespace

/// The probabilities of going on after each bounce, on a wall of kd = 1/2.
std::vector<double> survivals() {
  Material wall;
  wall.kd = Vec3(0.5f);
  std::vector<double> result;
  for (int bounce = 0; bounce < 400; ++bounce) {
    const auto p = stage4::lobe_probabilities(wall, bounce);
    result.push_back(
        static_cast<double>(p.diffuse + p.specular + p.refraction));
  }
  return result;
}

/// Each hit brings kd = 1/2 times the throughput, and the throughput is
/// multiplied by kd / p_n where the path goes on, with probability p_n. So X_n,
/// what hit n and all later hits bring, has the mean 1 and
///
///     E[X_n^2] = kd^2 + 2 kd kd + kd^2 / p_n  E[X_n+1^2].
///
/// For p = kd = 1/2 the variance is 1/2.
double variance_of_roulette() {
  double square = 1;
  const std::vector<double> p = survivals();
  for (auto one = p.rbegin(); one != p.rend(); ++one) {
    square = 0.25 + 0.5 + 0.25 / *one * square;
  }
  return square - 1;
}

// Roulette that is switched off has the same mean and no variance. A right
// program may have more, if it samples the lights only in the diffuse event,
// or less, if it follows two paths from the first surface.
TEST_CASE("roulette has the mean 1, and the variance of absorption") {
  const Scene scene = scene_text(lit_sphere("0.5"));
  const Pixel pixel = estimate(PathTracer(scene, {}), inside, 200'000);
  check_mean("roulette that divides by its probability, 1/p", pixel, 0, 1);
  check_variance("roulette, whose paths end as their probabilities say",
                 pixel, 0, variance_of_roulette(), 0.03);
}

/// Rays of one path inside the sphere, without a light: one for each hit.
Pixel hits_inside(const std::string& kd) {
  std::string text = lit_sphere(kd);
  const Scene scene = scene_text(text.substr(0, text.find("[[lights]]")));
  const PathTracer tracer(scene, {});
  Pixel hits;
  for (std::uint64_t i = 0; i < 50'000; ++i) {
    Random random(2, 0, i);
    const std::uint64_t before = rays_cast;
    tracer.radiance(inside, random);
    hits.add(Vec3(static_cast<float>(rays_cast - before)));
  }
  return hits;
}

// 1 + p_0 + p_0 p_1 + ...; for p = 1/2 that is 2. A loop may end paths for
// other reasons as well, such as a small throughput; then there are fewer. A
// sample of two paths has up to twice as many, and half of the variance.
TEST_CASE("paths end as often as their probabilities say") {
  double expected = 0, alive = 1;
  for (const double p : survivals()) {
    expected += alive;
    alive *= p;
  }
  const Scene scene = scene_text(lit_sphere("0.5"));
  const Pixel pixel = estimate(PathTracer(scene, {}), inside, 50'000);
  const bool of_two = pixel.variance(0) < 0.75 * variance_of_roulette();
  if (of_two) expected *= 2;
  const Pixel hits = hits_inside("0.5");
  INFO("a sample has ", hits.mean[0], " hits on average, expected ", expected,
       " or fewer");
  CHECK(hits.mean[0] <=
        expected + 4.4 * std::sqrt(hits.variance(0) / hits.samples));
}

// 1/2 + 1/4 + ... = 1, and for kd = 0.8: 0.8 / (1 - 0.8) = 4.
TEST_CASE("without a bound all the light is there") {
  const Scene scene = scene_text(lit_sphere("[0.8, 0.4, 0.1]"));
  const Pixel pixel = estimate(PathTracer(scene, {}), inside, 200'000);
  const double truth[] = {4, 2.0 / 3, 1.0 / 9};
  for (int c = 0; c < 3; ++c) {
    // Where nearly all paths agree, they differ only by rounding.
    check_mean(
        "kd + kd^2 + ... = kd / (1 - kd), channel " + std::to_string(c),
        pixel, c, truth[c]);
  }
}

TEST_CASE("with a bound of N bounces there are N terms of the series") {
  const Scene scene = scene_text(lit_sphere("0.5"));
  for (const int n : {0, 1, 2, 3, 5}) {
    RenderSettings settings;
    settings.max_bounces = n;
    const Pixel pixel =
        estimate(PathTracer(scene, settings), inside, 100'000);
    const double truth = 1 - std::exp2(-n);
    check_mean("1/2 + 1/4 + ..., at most " + bounces_in_words(n), pixel, 0,
               truth);
  }
}

// A room's wall seen through every lobe at once: kd + ks of the room's light
// comes directly, and for kt the ball's inside is diffuse and specular too.
// Where only one lobe has a color, the others must not lose theirs.
TEST_CASE("each lobe keeps its color, whichever event is drawn") {
  const Scene scene = in_white_room(
      "{ kd = [0.8, 0, 0.1], ks = [0.1, 0.9, 0] }", ball("thing"));
  RenderSettings settings;
  settings.max_bounces = 1;
  const Pixel pixel =
      estimate(PathTracer(scene, settings), {{0, 0, -5}, {0, 0, 1}}, 100'000);
  const double truth[] = {0.9, 0.9, 0.1};
  INFO(
      "kd = (0.8, 0, 0.1), ks = (0.1, 0.9, 0): each event's light is divided "
      "by the probability of the event that was drawn, and of no other");
  for (int c = 0; c < 3; ++c) {
    check_mean(
        "kd + ks of plastic in a white room, channel " + std::to_string(c),
        pixel, c, truth[c]);
  }
}

// Seen from inside glass, a wall of radiance 1 has 1.5^2 times kt. The weight
// of refraction is not its coefficient alone.
TEST_CASE(
    "an event has the weight of its sample: refraction has eta squared") {
  RenderSettings settings;
  settings.max_bounces = 1;
  const Scene scene = in_white_room("{ kt = 0.5 }", ball("thing"));
  const PathTracer tracer(scene, settings);
  const Pixel in = estimate(tracer, {{0, 0, 0}, {0, 0, 1}}, 20'000);
  check_mean("seen from inside, kt (eta_o/eta_i)^2 = 0.5 * 1.5^2", in, 0,
             0.5 * 2.25);
}

// kd + ks = 1 in red, ks + kt = 1 in green: nothing is lost, as long as a path
// can end anywhere. Beyond bounce 16 roulette adds noise, not light.
TEST_CASE("what loses no light is invisible in a white room, on average") {
  struct Case {
    const char* material;
    bool exact;  // every path of fewer than 16 bounces
  };
  const Case cases[] = {{"{ ks = 1 }", true},
                        {"{ kt = 1 }", true},
                        {"{ ks = 0.1, kt = 0.9 }", false},
                        {"{ kd = 0.5, ks = 0.5 }", false},
                        {"{ kd = 0.2, ks = 0.3, kt = 0.5 }", false}};
  for (const Case& one : cases) {
    const Scene scene = in_white_room(one.material, ball("thing"));
    const PathTracer tracer(scene, {});
    // Where nothing can be absorbed early on, nothing is random.
    EachOrMean all(1, 1e-5);
    Pixel pixel;
    for (std::uint64_t i = 0; i < 40'000; ++i) {
      Random random(8, 0, i);
      const Ray ray = ray_at_thing(random);
      const float radiance = tracer.radiance(ray, random).x;
      all.add(radiance);
      pixel.add(Vec3(radiance));
    }
    if (one.exact) all.check(one.material);
    check_mean(
        "a ball in a white room, material = " + std::string(one.material),
        pixel, 0, 1);
  }
}

// Most paths find out of the cube within 15 bounces, and bring 1. Stage 3
// follows the same paths without roulette; the mean difference is 0.
TEST_CASE("a glass cube in a white room is as invisible as in stage 3") {
  const Scene scene = in_white_room("{ kt = 1 }", cube("thing"));
  RenderSettings settings;
  settings.max_bounces = 15;
  const PathTracer tracer(scene, settings);
  const stage3::PathTracer third(scene, settings);
  Pixel difference;
  double seen = 0;
  for (std::uint64_t i = 0; i < 20'000; ++i) {
    Random random(8, 0, i), other(8, 1, i);
    const Ray ray = ray_at_thing(random);
    const Vec3 expected = third.radiance(ray, other);
    difference.add(tracer.radiance(ray, random) - expected);
    seen += static_cast<double>(expected.x) / 20'000;
  }
  INFO("stage 3 brings ", seen, " on average, and this stage ",
       seen + difference.mean[0], ", expected the same");
  CHECK(seen > 0.5);
  CHECK(std::abs(difference.mean[0]) <=
        4.4 * std::sqrt(difference.variance(0) / difference.samples) + 1e-5);
}

TEST_SUITE_END();
