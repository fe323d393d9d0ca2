// What radiance the stored photons give.

#include <doctest/doctest.h>

#include "stages/7_photon_mapping/path_tracer.hpp"
#include "support/exact_radiance.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using namespace lightwalk::stage7;

namespace {

constexpr double exact_pi = 3.14159265358979;

/// A point on a floor with kd = (0.5, 0.25, 1), seen at a slant from above.
struct Floor {
  Hit hit{};
  Material material{.kd = {0.5f, 0.25f, 1}};
  Surface surface;

  explicit Floor(const Vec3& position = Vec3(0))
      : surface(hit_at(position), material, normalize(Vec3(0.6f, 0.8f, 0))) {}
  Floor(const Floor&) = delete;
  Floor& operator=(const Floor&) = delete;

 private:
  const Hit& hit_at(const Vec3& position) {
    hit.position = position;
    hit.normal = {0, 1, 0};
    hit.material = &material;
    return hit;
  }
};

/// A photon of power (1, 2, 4) on the floor.
Photon photon_at(float x, float z, const Vec3& normal = {0, 1, 0},
                 int bounces = 1) {
  return {{x, 0, z}, {1, 2, 4}, normal, bounces};
}

Vec3 estimate_of(const std::vector<Photon>& photons, float radius,
                 Filter filter, int most = 8) {
  const Floor floor;
  return estimate(PhotonMap(photons), floor.surface, most, radius * radius,
                  filter);
}

/// Photons on the floor, uniform in the square of side 2 about (0, 0), of the
/// power `power(x, z)` in all channels.
template <class Power>
PhotonMap on_a_square(int count, std::uint64_t seed, Power power) {
  std::vector<Photon> photons;
  Random random(seed, 0, 0);
  for (int i = 0; i < count; ++i) {
    const Vec2 u = random.uniform_2d();
    const float x = 2 * u.x - 1, z = 2 * u.y - 1;
    photons.push_back({{x, 0, z}, Vec3(power(x, z)), {0, 1, 0}, 1});
  }
  return PhotonMap(std::move(photons));
}

}  // namespace

TEST_SUITE_BEGIN("units");

// The mean over the disk is the integral of w(t) 2t dt from 0 to 1.
TEST_CASE("each filter has the mean 1 over the disk") {
  for (const Filter filter : {Filter::box, Filter::cone}) {
    double mean = 0;
    constexpr int steps = 1000;
    for (int i = 0; i < steps; ++i) {
      const double t = (i + 0.5) / steps;
      mean += red(Vec3(filter_weight(filter, static_cast<float>(t)))) * 2 *
              t / steps;
    }
    check_value(filter == Filter::box ? "the mean of the box"
                                      : "the mean of the cone",
                mean, 1, 1e-4);
  }
}

TEST_CASE("the box is flat, and the cone falls to 0 at the rim") {
  const auto weight = [](Filter filter, float t) {
    return red(Vec3(filter_weight(filter, t)));
  };
  for (const float t : {0.0f, 0.5f, 0.99f}) {
    check_value("the box", weight(Filter::box, t), 1);
  }
  check_value("the cone in the middle", weight(Filter::cone, 0), 3);
  check_value("the cone half way", weight(Filter::cone, 0.5f), 1.5);
  check_value("the cone at the rim", weight(Filter::cone, 1), 0);
}

// L = kd/pi w Phi/(pi r^2), for r = 0.2 and a photon at 0.1.
TEST_CASE("one photon in the disk: L = kd/pi w Phi/(pi r^2)") {
  const std::vector<Photon> one{photon_at(0.06f, 0.08f)};
  const Vec3 box = Vec3(0.5f, 0.5f, 4) / float(exact_pi * exact_pi * 0.04);
  check_color("by the box", estimate_of(one, 0.2f, Filter::box), box);
  check_color("by the cone, w = 1.5", estimate_of(one, 0.2f, Filter::cone),
              1.5f * box);
  const std::vector<Photon> two{photon_at(0.06f, 0.08f),
                                photon_at(-0.15f, 0)};
  check_color("two photons", estimate_of(two, 0.2f, Filter::box), 2.0f * box);
  check_color("two photons by the cone, w = 1.5 and 0.75",
              estimate_of(two, 0.2f, Filter::cone), 2.25f * box);
}

TEST_CASE("photons beyond the radius do not count") {
  check_color("a photon at 0.21",
              estimate_of({photon_at(0.21f, 0)}, 0.2f, Filter::box), Vec3(0));
  check_color("a photon on the rim",
              estimate_of({photon_at(0.25f, 0)}, 0.25f, Filter::box),
              Vec3(0));
  check_color("no photon", estimate_of({}, 0.2f, Filter::cone), Vec3(0));
}

TEST_CASE("photons on the back of the surface do not count") {
  check_color(
      "light on the back",
      estimate_of({photon_at(0.1f, 0, {0, -1, 0})}, 0.2f, Filter::box),
      Vec3(0));
}

TEST_CASE("photons around the corner do not count") {
  check_color("light on a wall beside the floor",
              estimate_of({photon_at(0.1f, 0, {1, 0, 0})}, 0.2f, Filter::box),
              Vec3(0));
}

TEST_CASE("photons of too many bounces do not count") {
  const std::vector<Photon> third{photon_at(0.1f, 0, {0, 1, 0}, 3)};
  CHECK(estimate_of(third, 0.2f, Filter::box, 3) != Vec3(0));
  check_color("3 bounces where 2 are allowed",
              estimate_of(third, 0.2f, Filter::box, 2), Vec3(0));
}

// (1 + 2/3)/2 = 5/6, and 5/6 (2 + 2/3)/3 = 20/27.
TEST_CASE("the squared radius shrinks by (i + alpha)/(i + 1)") {
  check_value("after one map", next_squared_scale(1, 1), 5.0 / 6);
  check_value("after two maps", next_squared_scale(5.0 / 6, 2), 20.0 / 27);
  check_value("of another radius", next_squared_scale(0.5, 1), 5.0 / 12);
}

// The product of (i + alpha)/(i + 1) is Gamma(n + alpha)/(Gamma(1 + alpha)
// Gamma(n + 1)), which goes to n^(alpha - 1)/Gamma(1 + alpha).
TEST_CASE("the squared radius falls like n^(-1/3)") {
  double squared_scale = 1;
  for (std::uint32_t i = 1; i < 100'000; ++i) {
    squared_scale = next_squared_scale(squared_scale, i);
  }
  check_value("R^2 of map 100,000, times the third root of 100,000",
              squared_scale * std::cbrt(100'000.0), 1 / std::tgamma(5.0 / 3),
              1e-4);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("analytic scenes");

// 400 photons on an area of 4, each of power 1/100: E = 1. The k-th of them
// sets the radius, and k - 1 count. The share s of the area that the k-th
// reaches has the beta distribution with k and 401 - k, so the mean of 1/s is
// 400/(k - 1), and that of the estimate is exactly 1. If the k-th counted, it
// would be k/(k - 1). The disk must stay in the square: 10 of 400 photons
// have the radius 0.18.
TEST_CASE("a uniformly lit plane has its irradiance, on average") {
  const Floor floor;
  for (const Filter filter : {Filter::box, Filter::cone}) {
    Pixel pixel;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
      const PhotonMap map =
          on_a_square(400, seed, [](float, float) { return 1 / 100.0f; });
      const float squared_radius = map.squared_distance_to(
          10, Vec3(0), infinity, [](const Photon&) { return true; });
      pixel.add(estimate(map, floor.surface, 8, squared_radius, filter));
    }
    check_mean(
        filter == Filter::box ? "kd/pi E by the box" : "kd/pi E by the cone",
        pixel, 0, 0.5 / exact_pi, 1e-5);
    if (filter == Filter::box) {
      // The relative variance of (k - 1)/s: 1/(k - 2), less the share of the
      // photons that is looked at.
      check_variance("the estimate by the box", pixel, 0,
                     std::pow(0.5 / exact_pi, 2) / 8, 0.15);
    }
  }
}

// E = 1 + a (x^2 + z^2) with a = 2. A disk of radius r finds 1 + a m r^2, with
// m the mean of t^2 under the filter: 1/2 for the box, and for the cone the
// integral of 3 (1 - t) t^2 2t dt, 6 (1/4 - 1/5) = 0.3. So the bias falls like
// r^2, and that of the cone is smaller.
TEST_CASE("the bias of a disk is what its radius explains") {
  const Floor floor;
  for (const auto& [filter, m] :
       {std::pair{Filter::box, 0.5}, {Filter::cone, 0.3}}) {
    for (const double r : {0.8, 0.4, 0.2}) {
      Pixel pixel;
      for (std::uint64_t seed = 0; seed < 500; ++seed) {
        const PhotonMap map = on_a_square(1000, seed, [](float x, float z) {
          return (1 + 2 * (x * x + z * z)) / 250;
        });
        pixel.add(estimate(map, floor.surface, 8, static_cast<float>(r * r),
                           filter));
      }
      CAPTURE(r);
      check_mean(filter == Filter::box ? "kd/pi (1 + a r^2/2) by the box"
                                       : "kd/pi (1 + 0.3 a r^2) by the cone",
                 pixel, 0, 0.5 / exact_pi * (1 + 2 * m * r * r), 1e-5);
    }
  }
}

TEST_SUITE_END();
