#pragma once

// Tests of any sampler of the hemisphere against the density it claims.

#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <vector>

#include "common/math/random.hpp"
#include "common/math/vector.hpp"
#include "support/chi_squared.hpp"
#include "support/expectations.hpp"

namespace lightwalk::tests {

/// Normals along every axis, both ways, and `count` random ones.
inline std::vector<Vec3> test_normals(int count) {
  std::vector<Vec3> normals = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                               {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
  Random random(99, 0, 0);
  while (count-- > 0) {
    const Vec2 u(random.uniform_2d());
    const float z = 2 * u.x - 1;
    const float r = std::sqrt(1 - z * z);
    normals.push_back(
        {r * std::cos(two_pi * u.y), r * std::sin(two_pi * u.y), z});
  }
  return normals;
}

using HemisphereSampler = std::function<Vec3(const Vec3& normal, Vec2 u)>;

inline void check_directions(const HemisphereSampler& sampler) {
  for (const Vec3& normal : test_normals(1000)) {
    for (const Vec2 u : {Vec2(0.3f, 0.7f), Vec2(0.5f, 0.25f), Vec2(0, 0),
                         Vec2(0, 0.9999999f), Vec2(0.9999999f, 0)}) {
      const Vec3 wi = sampler(normal, u);
      INFO("wi = ", wi, " for the normal ", normal, " and u = ", u);
      require_value("length of wi", static_cast<double>(length(wi)), 1, 1e-5);
      const float cosine = dot(wi, normal);
      INFO("n . wi is ", cosine, ", expected 0 or more: above the surface");
      REQUIRE(cosine > -1e-6f);
    }
  }
}

/// Numbers that are near give directions that are near, but for a few jumps. An
/// angle in degrees for one in radians goes 57 times around: the density is
/// nearly right, and neighbors are far apart.
inline void check_once_around(const HemisphereSampler& sampler) {
  constexpr float step = 1e-3f;  // of a number: at most 0.0063 of an angle
  std::vector<float> turns;
  Random random(3, 0, 0);
  for (int i = 0; i < 999; ++i) {
    const Vec2 u = Vec2(random.uniform_2d()) * (1 - step);
    const Vec3 wi = sampler({0, 0, 1}, u);
    turns.push_back(
        std::max(length(sampler({0, 0, 1}, u + Vec2(step, 0)) - wi),
                 length(sampler({0, 0, 1}, u + Vec2(0, step)) - wi)));
  }
  std::sort(turns.begin(), turns.end());
  const float turn = turns[turns.size() / 2];
  INFO("a step of 0.001 in u turns the direction by ", turn,
       ", expected at most 0.0063 where phi goes once around");
  CHECK(turn < 0.05f);
}

/// The mean cosine says most about a density, and the cell that is farthest
/// off says where. A right sampler fails once in a million times.
struct HemisphereCounts {
  double p_value = 0, mean_cosine = 0, expected_mean_cosine = 0;
  std::string farthest;  ///< the cell in words
};

/// Directions sorted into cells of equal solid angle: bins of the cosine
/// times bins of the azimuth about the normal. `cumulative(c)` is the
/// probability that a direction's cosine lies below c; the azimuth is
/// uniform.
inline HemisphereCounts count_hemisphere(
    const HemisphereSampler& sampler, const Vec3& normal,
    const std::function<double(double)>& cumulative) {
  constexpr int rings = 12, sectors = 16, samples = 200'000;
  // The test's own axes: the code under test must not judge itself.
  const Vec3 aside =
      std::abs(normal.x) < 0.5f ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 x = normalize(cross(aside, normal)), y = cross(normal, x);
  std::vector<double> observed(rings * sectors), expected(rings * sectors);
  HemisphereCounts result;
  Random random(5, 0, 0);
  for (int i = 0; i < samples; ++i) {
    const Vec2 u(random.uniform_2d());
    const Vec3 wi = sampler(normal, u);
    result.mean_cosine += static_cast<double>(dot(wi, normal)) / samples;
    const float turn = std::atan2(dot(wi, y), dot(wi, x)) / two_pi + 0.5f;
    const int ring =
        std::clamp(static_cast<int>(dot(wi, normal) * rings), 0, rings - 1);
    const int sector =
        std::clamp(static_cast<int>(turn * sectors), 0, sectors - 1);
    observed[static_cast<std::size_t>(ring * sectors + sector)] += 1;
  }
  for (int ring = 0; ring < rings; ++ring) {
    const double low = static_cast<double>(ring) / rings;
    const double share = cumulative(low + 1.0 / rings) - cumulative(low);
    for (int sector = 0; sector < sectors; ++sector) {
      expected[static_cast<std::size_t>(ring * sectors + sector)] =
          samples * share / sectors;
    }
  }
  // The mean is 1 minus the integral of the cumulative probability.
  constexpr int steps = 10'000;
  for (int i = 0; i < steps; ++i) {
    result.expected_mean_cosine +=
        (1 - cumulative((i + 0.5) / steps)) / steps;
  }
  result.p_value = chi_squared_test(observed, expected).p_value;
  double farthest = 0;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    const double off =
        std::abs(observed[i] - expected[i]) / std::sqrt(expected[i]);
    if (off <= farthest) continue;
    farthest = off;
    // Of the cell's middle; `turn` above begins opposite to x.
    const float cosine = (static_cast<float>(i / sectors) + 0.5f) / rings;
    const float turn = (static_cast<float>(i % sectors) + 0.5f) / sectors;
    const float sine = std::sqrt(1 - cosine * cosine);
    const float angle = two_pi * (turn - 0.5f);
    const Vec3 middle =
        cosine * normal + sine * (std::cos(angle) * x + std::sin(angle) * y);
    result.farthest = text_of(observed[i]) + " of " + text_of(samples) +
                      " are around " + text_of(middle) + ", expected " +
                      text_of(std::round(expected[i]));
  }
  return result;
}

/// Fails unless a sampler has the density that is called `density`.
inline void check_hemisphere(
    const std::string& density, const HemisphereSampler& sampler,
    const Vec3& normal, const std::function<double(double)>& cumulative) {
  const HemisphereCounts counts =
      count_hemisphere(sampler, normal, cumulative);
  if (counts.p_value > significance) return;
  FAIL_CHECK("directions about the normal "
             << normal << " do not have the density " << density
             << ": mean cosine " << counts.mean_cosine << ", expected "
             << counts.expected_mean_cosine << "; " << counts.farthest);
}

}  // namespace lightwalk::tests
