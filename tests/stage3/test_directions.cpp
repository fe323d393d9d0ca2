// Reflection and refraction by themselves.

#include <doctest/doctest.h>

#include "stages/3_specular_refraction/path_tracer.hpp"
#include "support/hemisphere.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using namespace lightwalk::stage3;

TEST_SUITE_BEGIN("units");

namespace {

/// A direction at `degrees` from the z axis, towards +x.
Vec3 at_angle(double degrees) {
  const double radians = degrees * std::acos(-1.0) / 180;
  return {static_cast<float>(std::sin(radians)), 0,
          static_cast<float>(std::cos(radians))};
}

double angle_to(const Vec3& direction, const Vec3& axis) {
  return std::acos(static_cast<double>(dot(direction, axis))) * 180 /
         std::acos(-1.0);
}

const Vec3 up{0, 0, 1};

}  // namespace

TEST_CASE("a mirror: equal angles, on the other side of the normal") {
  for (const double degrees : {0.0, 10.0, 45.0, 80.0, 89.0}) {
    CAPTURE(degrees);
    const Vec3 wi = reflect(at_angle(degrees), up);
    const Vec3 expected = at_angle(-degrees);
    CHECK(wi.x == doctest::Approx(expected.x).epsilon(1e-6));
    CHECK(wi.y == 0);
    CHECK(wi.z == doctest::Approx(expected.z).epsilon(1e-6));
  }
}

TEST_CASE("mirrored twice is where it was, for any normal") {
  const Vec3 wo = normalize(Vec3(0.3f, -0.5f, 0.8f));
  for (const Vec3& normal : test_normals(100)) {
    const Vec3 twice = reflect(reflect(wo, normal), normal);
    REQUIRE(length(twice - wo) < 1e-5f);
  }
}

// sin 30 / 1.5 = sin 19.4712; sin 30 * 1.5 = sin 48.5904; sin 60 / 1.5 =
// sin 35.2644.
TEST_CASE("Snell's law, into glass and out of it") {
  struct Case {
    double from, to;
    float eta_ratio;
  };
  const Case cases[] = {{0, 0, 1 / 1.5f},          {30, 19.471221, 1 / 1.5f},
                        {60, 35.264390, 1 / 1.5f}, {30, 48.590378, 1.5f},
                        {19.471221, 30, 1.5f},     {45, 45, 1}};
  for (const Case& one : cases) {
    CAPTURE(one.from);
    CAPTURE(one.eta_ratio);
    const auto wi = refract(at_angle(one.from), up, one.eta_ratio);
    REQUIRE(wi.has_value());
    CHECK(angle_to(*wi, -up) == doctest::Approx(one.to).epsilon(1e-4));
    CHECK(wi->x <= 0);  // the other side of the normal
    CHECK(length(*wi) == doctest::Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("a refracted ray taken backwards is the ray that came") {
  Random random(3, 0, 0);
  for (const Vec3& normal : test_normals(200)) {
    const Vec3 wo =
        stage1::sample_uniform_hemisphere(normal, random.uniform_2d());
    const auto wi = refract(wo, normal, 1 / 1.5f);
    REQUIRE(wi.has_value());
    const auto back = refract(*wi, -normal, 1.5f);
    REQUIRE(back.has_value());
    REQUIRE(length(*back - wo) < 2e-3f);  // grazing angles amplify rounding
  }
}

// The critical angle of 1.5 is arcsin(1/1.5) = 41.8103 degrees.
TEST_CASE("total internal reflection begins at 41.81 degrees inside glass") {
  CHECK(refract(at_angle(41.80), up, 1.5f).has_value());
  CHECK_FALSE(refract(at_angle(41.82), up, 1.5f).has_value());
  CHECK_FALSE(refract(at_angle(89), up, 1.5f).has_value());
  CHECK(refract(at_angle(89), up, 1 / 1.5f).has_value());
}

namespace {

Hit hit_on(const Material& material) {
  Hit hit{};
  hit.normal = up;
  hit.material = &material;
  return hit;
}

}  // namespace

TEST_CASE("eta is 1 outside, where the shape's normal points") {
  Material glass;
  glass.eta = 1.5f;
  const Hit hit = hit_on(glass);
  const Surface outside(hit, glass, at_angle(20));
  const Surface inside(hit, glass, -at_angle(20));
  CHECK(relative_eta(outside) == doctest::Approx(1 / 1.5));
  CHECK(relative_eta(inside) == doctest::Approx(1.5));
}

TEST_CASE("each lobe's weight is its coefficient, without a cosine") {
  Material material;
  material.kd = {0.1f, 0.2f, 0.3f};
  material.ks = {0.3f, 0.2f, 0.1f};
  material.kt = {0.2f, 0.4f, 0.5f};
  Random random(1, 0, 0);
  for (const double degrees : {5.0, 40.0, 80.0}) {
    CAPTURE(degrees);
    const Vec3 wo = at_angle(degrees);
    const Hit hit = hit_on(material);
    for (const float side : {1.0f, -1.0f}) {
      CAPTURE(side);
      const Surface surface(hit, material, side * wo);
      const auto one = [&](Lobe lobe) {
        return sample(lobe, surface, Sampling::cosine, random);
      };
      CHECK(one(Lobe::diffuse).weight == material.kd);
      CHECK(side * one(Lobe::diffuse).wi.z > 0);
      CHECK(one(Lobe::specular).weight == material.ks);
      CHECK(one(Lobe::specular).wi == side * reflect(wo, up));
      const BsdfSample refracted = one(Lobe::refraction);
      if (side < 0 && degrees > 41) {
        CHECK(refracted.weight == material.kt);  // totally reflected
        CHECK(refracted.wi == side * reflect(wo, up));
        continue;
      }
      // Radiance grows by (eta_o / eta_i)^2 towards the side of wo.
      CHECK(refracted.weight.z ==
            doctest::Approx(side > 0 ? 0.5 / 2.25 : 0.5 * 2.25));
      CHECK(side * refracted.wi.z < 0);
    }
  }
}

TEST_SUITE_END();
