// Compares the samplers with the densities they claim, and both with the
// BRDF.

#include <doctest/doctest.h>

#include "stages/1_diffuse/path_tracer.hpp"
#include "support/expectations.hpp"
#include "support/hemisphere.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using namespace lightwalk::stage1;

TEST_SUITE_BEGIN("units");

TEST_CASE("uniform directions are unit vectors above the surface") {
  check_directions(sample_uniform_hemisphere);
}

TEST_CASE("cosine directions are unit vectors above the surface") {
  check_directions(sample_cosine_hemisphere);
}

TEST_CASE("uniform directions go once around the normal") {
  check_once_around(sample_uniform_hemisphere);
}

TEST_CASE("cosine directions go once around the normal") {
  check_once_around(sample_cosine_hemisphere);
}

// Equal solid angles are equal steps of the cosine: P(cos < c) = c.
TEST_CASE("uniform directions fill the hemisphere evenly") {
  for (const Vec3& normal : test_normals(4)) {
    check_hemisphere("p = 1/(2 pi)", sample_uniform_hemisphere, normal,
                     [](double c) { return c; });
  }
}

// P(cos < c) = integral of 2 c' from 0 to c = c^2.
TEST_CASE(
    "cosine directions fill the hemisphere in proportion to the cosine") {
  for (const Vec3& normal : test_normals(4)) {
    check_hemisphere("p = cos/pi", sample_cosine_hemisphere, normal,
                     [](double c) { return c * c; });
  }
}

// Each density over the hemisphere: the midpoint rule in cos(theta), where
// the solid angle of a ring is 2 pi times its step.
TEST_CASE("the densities integrate to 1 over the hemisphere") {
  double uniform = 0, cosine = 0;
  constexpr int rings = 1000;
  for (int i = 0; i < rings; ++i) {
    const float cos_theta = (static_cast<float>(i) + 0.5f) / rings;
    uniform += static_cast<double>(uniform_hemisphere_pdf() * two_pi) / rings;
    cosine += static_cast<double>(cosine_hemisphere_pdf(cos_theta) * two_pi) /
              rings;
  }
  check_value("the integral of p = 1/(2 pi)", uniform, 1, 1e-5);
  check_value("the integral of p = cos/pi", cosine, 1, 1e-5);
}

TEST_CASE("the BRDF is kd / pi") {
  Material material;
  material.kd = {0.9f, 0.5f, 0.1f};
  const Vec3 brdf = evaluate(material);
  check_color("f_r = kd/pi", brdf, material.kd * inverse_pi);
}

// surface.hit.normal is the shape's own, and may point away from wo.
TEST_CASE("directions go to the side that wo is on") {
  const Material material;
  Hit hit{};
  hit.normal = normalize(Vec3(1, 2, -3));
  Random random(8, 0, 0);
  for (const float side : {1.0f, -1.0f}) {
    const Surface surface(hit, material, side * hit.normal);
    for (const Sampling sampling : {Sampling::cosine, Sampling::uniform}) {
      int behind = 0;
      for (int i = 0; i < 1000; ++i) {
        const Vec2 u(random.uniform_2d());
        behind += dot(sample(surface, sampling, u).wi, surface.wo) < 0;
      }
      INFO(behind, " of 1000 directions by ",
           sampling == Sampling::uniform ? "uniform" : "cosine",
           " sampling go behind the surface, as wo sees it, expected 0; the "
           "shape's normal points ",
           side > 0 ? "to" : "away from", " the side of wo");
      CHECK(behind == 0);
    }
  }
}

TEST_CASE("the simplified weights are f cos / p") {
  Material material;
  material.kd = {0.9f, 0.5f, 0.1f};
  Hit hit{};
  hit.normal = normalize(Vec3(1, 2, -3));
  // Seen at a slant, so that wo is not taken for the normal.
  const Vec3 wo = normalize(hit.normal + Vec3(0.4f, 0.7f, 0.6f));
  Random random(4, 0, 0);
  for (int i = 0; i < 2000; ++i) {
    const Vec2 u(random.uniform_2d());
    // From either side: surface.normal is on that of wo, hit.normal need not.
    const bool front = i % 2 == 0;
    const Surface surface(hit, material, front ? wo : -wo);
    for (const Sampling sampling : {Sampling::cosine, Sampling::uniform}) {
      const std::string formula =
          std::string(sampling == Sampling::uniform
                          ? "weight = f_r cos / p = 2 kd cos for p = 1/(2 pi)"
                          : "weight = f_r cos / p = kd for p = cos/pi") +
          (front ? "" : ", with wo where the shape's normal points away");
      const BsdfSample one = sample(surface, sampling, u);
      const float cos_theta = dot(surface.normal, one.wi);
      const float pdf = sampling == Sampling::uniform
                            ? uniform_hemisphere_pdf()
                            : cosine_hemisphere_pdf(cos_theta);
      const Vec3 full = unsimplified_weight(material, cos_theta, pdf);
      require_value("length of wi", static_cast<double>(length(one.wi)), 1);
      require_color(formula, one.weight, full, 1e-3);
    }
  }
}

// The mean weight is the share of light that the surface returns.
TEST_CASE("the mean weight is the albedo kd") {
  Material material;
  material.kd = {0.9f, 0.5f, 0.1f};
  Hit hit{};
  hit.normal = {0, 1, 0};
  const Surface surface(hit, material, hit.normal);
  Random random(6, 0, 0);
  for (const Sampling sampling : {Sampling::cosine, Sampling::uniform}) {
    Pixel weights;
    for (int i = 0; i < 100'000; ++i) {
      weights.add(sample(surface, sampling, random.uniform_2d()).weight);
    }
    for (int c = 0; c < 3; ++c) {
      check_mean(sampling == Sampling::uniform
                     ? "the mean of 2 kd cos, which is kd"
                     : "the mean of the weight kd",
                 weights, c, static_cast<double>(material.kd[c]), 1e-5);
    }
  }
}

TEST_SUITE_END();
