// How much power lamps have, and how photons leave them.

#include <doctest/doctest.h>

#include "stages/7_photon_mapping/path_tracer.hpp"
#include "support/exact_radiance.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using namespace lightwalk::stage7;

namespace {

constexpr int draws = 100'000;

const PointLight point{{0.2f, 1, 0.1f}, {3, 2, 1}};
const RectangleLight rectangle{
    {-0.3f, 1.2f, -0.2f}, {0.5f, 0, 0.2f}, {0, 0.1f, 0.7f}, {5, 4, 3}};
const SphereLight sphere{{0.1f, 1, -0.2f}, 0.4f, {5, 4, 3}};

/// The mean of a number over draws, against what it should be.
template <class Value>
void check_mean_of(const std::string& what, double expected, Value value) {
  Pixel mean;
  for (int i = 0; i < draws; ++i) {
    Random random(5, 0, static_cast<std::uint64_t>(i));
    mean.add(Vec3(static_cast<float>(value(random))));
  }
  check_mean(what, mean, 0, expected);
}

}  // namespace

TEST_SUITE_BEGIN("units");

TEST_CASE("the power of a point light is 4 pi I") {
  check_color("4 pi I", power_of(Light{point}),
              float(4 * 3.14159265) * Vec3(3, 2, 1));
}

// The edges are not perpendicular: |u x v| = |(0.02, 0.35, -0.05)|.
TEST_CASE("the power of a rectangle is pi A L, and of a sphere too") {
  const double area = std::sqrt(0.02 * 0.02 + 0.35 * 0.35 + 0.05 * 0.05);
  check_color("pi A L with A = |u x v|", power_of(Light{rectangle}),
              float(3.14159265 * area) * Vec3(5, 4, 3));
  check_color("pi 4 pi r^2 L", power_of(Light{sphere}),
              float(4 * 3.14159265 * 3.14159265 * 0.16) * Vec3(5, 4, 3));
}

// Uniform on the sphere: each coordinate is uniform from -1 to 1, and two of
// them are not correlated.
TEST_CASE("photons leave a point in all directions alike") {
  for (int axis = 0; axis < 3; ++axis) {
    const auto coordinate = [&](Random& random, int which) {
      const Vec3 d = sample_sphere(random.uniform_2d());
      return static_cast<double>(d[which]);
    };
    check_mean_of("a coordinate of the direction", 0,
                  [&](Random& r) { return coordinate(r, axis); });
    check_mean_of("its square", 1.0 / 3, [&](Random& r) {
      return std::pow(coordinate(r, axis), 2);
    });
    check_mean_of("its fourth power", 1.0 / 5, [&](Random& r) {
      return std::pow(coordinate(r, axis), 4);
    });
    check_mean_of("the product of two coordinates", 0, [&](Random& random) {
      const Vec3 d = sample_sphere(random.uniform_2d());
      return red(Vec3(d[axis] * d[(axis + 1) % 3]));
    });
  }
  for (int i = 0; i < 1000; ++i) {
    Random random(6, 0, static_cast<std::uint64_t>(i));
    const Vec3 d = sample_sphere(random.uniform_2d());
    require_value("length of the direction", red(Vec3(length(d))), 1, 1e-5);
  }
}

// A floor is lit by one lamp. What next-event estimation finds there, the mean
// of (weight of the light) cos(theta) over a square of area 1, is also what
// photons bring there: the power of those that land in the square.
TEST_CASE("photons light a floor as next-event estimation does") {
  for (const Light& light : {Light{point}, Light{rectangle}, Light{sphere}}) {
    const std::vector<Lamp> lamps{{&light, power_of(light), 1, {}}};
    const int count = 400'000;
    Pixel photons, asked;
    for (int i = 0; i < count; ++i) {
      Random random(7, 0, static_cast<std::uint64_t>(i));
      const Emission start = std::visit(
          [&](const auto& form) { return emit(form, random); }, light.form);
      const float t = -start.position.y / start.direction.y;
      const Vec3 at = start.position + t * start.direction;
      const bool lands =
          t > 0 && std::abs(at.x) < 0.5f && std::abs(at.z) < 0.5f;
      photons.add(lands ? static_cast<float>(count) *
                              photon_power(lamps[0], count)
                        : Vec3(0));
      const Vec2 u = random.uniform_2d();
      const Vec3 x(u.x - 0.5f, 0, u.y - 0.5f);
      const auto sample = stage2::sample_light(light, x, random.uniform_2d());
      asked.add(sample.weight * std::max(0.0f, sample.direction.y));
    }
    for (int c = 0; c < 3; ++c) {
      const double noise = std::sqrt(
          (photons.variance(c) + asked.variance(c)) / photons.samples);
      CAPTURE(light.form.index());
      CAPTURE(c);
      INFO("photons bring ", photons.mean[c], " W, shadow rays ",
           asked.mean[c],
           " W: ", factor_in_words(photons.mean[c] / asked.mean[c]));
      CHECK(asked.mean[c] > 0.1);
      CHECK(std::abs(photons.mean[c] - asked.mean[c]) <
            max_deviations * noise);
    }
  }
}

// The mean power over the draws of a lamp is the power of all, over N.
TEST_CASE("the photons of all lamps together have the power of all lamps") {
  Scene scene;
  scene.add(PointLight{{0, 0, 0}, {3, 0, 1}});
  scene.add(PointLight{{1, 0, 0}, {0, 1, 0}});
  scene.add(PointLight{{1, 0, 0}, {0, 0, 0}});
  const Material lamp{.ke = {2, 2, 4}};
  scene.add(Sphere{{0, 3, 0}, 0.5f, scene.add(lamp)});
  scene.prepare();
  const std::vector<Lamp> lamps = lamps_of(scene);
  REQUIRE(lamps.size() == 4);
  Vec3 all(0), mean(0);
  float sum = 0;
  for (const Lamp& one : lamps) {
    sum += one.probability;
    all += one.power;
    if (one.probability > 0) mean += one.probability * photon_power(one, 50);
  }
  check_value("the sum of the probabilities", red(Vec3(sum)), 1, 1e-6);
  check_color("50 photons' mean power", 50.0f * mean, all, 1e-5);
  for (const Lamp& one : lamps) {
    check_mean_of("how often a lamp is drawn", red(Vec3(one.probability)),
                  [&](Random& random) {
                    return &choose_lamp(lamps, random.uniform()) == &one;
                  });
  }
}

TEST_CASE("a scene without power has no photons") {
  Scene scene;
  scene.add(PointLight{{0, 0, 0}, Vec3(0)});
  scene.add(Sphere{{0, 0, 0}, 1, scene.add(Material{.kd = Vec3(0.5f)})});
  scene.prepare();
  const std::atomic<bool> stop{false};
  RenderProgress progress;
  CHECK(lamps_of(scene).empty());
  CHECK(trace_photons(scene, {}, 0, stop, progress).points().empty());
}

TEST_SUITE_END();
