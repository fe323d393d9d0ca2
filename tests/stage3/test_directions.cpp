// Reflection and refraction by themselves.

#include <doctest/doctest.h>

#include "stages/3_specular_refraction/path_tracer.hpp"
#include "support/expectations.hpp"
#include "support/hemisphere.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using namespace lightwalk::stage3;

TEST_SUITE_BEGIN("units");

namespace {

/// A direction at `degrees` from the z axis, toward +x.
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

TEST_CASE("reflected and refracted directions have unit length") {
  const Vec3 wo = normalize(Vec3(0.3f, -0.5f, 0.8f));
  check_value("length of reflect(wo, normal)",
              static_cast<double>(length(reflect(wo, up))), 1, 1e-5);
  for (const float eta_ratio : {1 / 1.5f, 1.0f, 1.1f}) {
    const auto wi = refract(wo, up, eta_ratio);
    if (!wi) {
      FAIL("refract(wo, normal, " << eta_ratio << ") with wo = " << wo
                                  << " is nothing, expected a direction");
    }
    check_value("length of refract(wo, normal, " +
                    text_of(static_cast<double>(eta_ratio)) + ")",
                static_cast<double>(length(*wi)), 1, 1e-5);
  }
}

TEST_CASE("a mirror: equal angles, on the other side of the normal") {
  for (const double degrees : {0.0, 10.0, 45.0, 80.0, 89.0}) {
    const Vec3 wi = reflect(at_angle(degrees), up);
    const Vec3 expected = at_angle(-degrees);
    INFO("wo at ", degrees,
         " degrees to the normal (0, 0, 1) is reflected to ", wi,
         ", expected ", expected, ", away from the surface");
    CHECK(length(wi - expected) < 2e-6f);
  }
}

TEST_CASE("mirroring twice gives back the direction, for any normal") {
  const Vec3 wo = normalize(Vec3(0.3f, -0.5f, 0.8f));
  for (const Vec3& normal : test_normals(100)) {
    const Vec3 twice = reflect(reflect(wo, normal), normal);
    INFO("wo = ", wo, " mirrored twice at the normal ", normal, " is ",
         twice);
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
  const Case cases[] = {{30, 19.471221, 1 / 1.5f},
                        {60, 35.264390, 1 / 1.5f},
                        {30, 48.590378, 1.5f},
                        {19.471221, 30, 1.5f},
                        {45, 45, 1},
                        {0, 0, 1 / 1.5f}};
  for (const Case& one : cases) {
    INFO("theta_o = ", one.from, " degrees, eta_o/eta_i = ", one.eta_ratio,
         ", expected theta_i = ", one.to);
    const auto wi = refract(at_angle(one.from), up, one.eta_ratio);
    REQUIRE(wi.has_value());
    REQUIRE_MESSAGE(dot(*wi, up) < 0, "wi = ", *wi, " for the normal ", up,
                    ": n . wi is ", dot(*wi, up),
                    ", expected below 0: wi leads behind the surface");
    check_value(
        "sin theta_i = eta_o/eta_i sin theta_o: theta_i in degrees "
        "for theta_o = " +
            text_of(one.from) + " and eta_o/eta_i = " +
            text_of(static_cast<double>(one.eta_ratio)),
        angle_to(*wi, -up), one.to, one.to == 0 ? 0 : 1.1e-4);
    INFO("wi = ", *wi, " for wo = ", at_angle(one.from),
         ", expected wi.x below 0: light crosses the normal");
    CHECK(wi->x <= 0);
  }
}

TEST_CASE("a refracted ray taken backwards gives the incoming ray") {
  Random random(3, 0, 0);
  for (const Vec3& normal : test_normals(200)) {
    const Vec3 wo =
        stage1::sample_uniform_hemisphere(normal, random.uniform_2d());
    const auto wi = refract(wo, normal, 1 / 1.5f);
    INFO("wo = ", wo, " is bent into glass to ", wi,
         ", expected a direction");
    REQUIRE(wi.has_value());
    const auto back = refract(*wi, -normal, 1.5f);
    INFO("and back out of it to ", back, ", expected ", wo);
    REQUIRE(back.has_value());
    REQUIRE(length(*back - wo) < 2e-3f);  // grazing angles amplify rounding
  }
}

// The critical angle of 1.5 is arcsin(1/1.5) = 41.8103 degrees.
TEST_CASE("total internal reflection begins at 41.81 degrees inside glass") {
  const auto check = [](double degrees, float eta_ratio, bool passes) {
    const bool passed = refract(at_angle(degrees), up, eta_ratio).has_value();
    if (passed == passes) return;
    FAIL_CHECK(
        "at " << degrees << " degrees with eta_o/eta_i = " << eta_ratio
              << std::string(passes
                                 ? " nothing passes, expected a direction"
                                 : " light passes, expected none: all of it "
                                   "is reflected"));
  };
  check(41.80, 1.5f, true);
  check(41.82, 1.5f, false);
  check(89, 1.5f, false);
  check(89, 1 / 1.5f, true);
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
  // A bubble of air in water has an eta below 1.
  for (const float eta : {1.5f, 1.25f, 2.0f, 0.75f}) {
    Material glass;
    glass.eta = eta;
    const Hit hit = hit_on(glass);
    const Surface outside(hit, glass, at_angle(20));
    const Surface inside(hit, glass, -at_angle(20));
    const std::string of = " glass of " + text_of(static_cast<double>(eta));
    check_value("eta_o/eta_i with wo outside" + of,
                static_cast<double>(relative_eta(outside)),
                1 / static_cast<double>(eta));
    check_value("eta_o/eta_i with wo inside" + of,
                static_cast<double>(relative_eta(inside)),
                static_cast<double>(eta));
  }
}

TEST_CASE("the lobe of refraction bends wo about the normal on its side") {
  Material glass;
  glass.kt = Vec3(1);
  glass.eta = 1.5f;
  const Hit hit = hit_on(glass);
  Random random(1, 0, 0);
  for (const float side : {1.0f, -1.0f}) {
    const Vec3 wo = side * at_angle(20);
    const Surface surface(hit, glass, wo);
    const Vec3 wi =
        sample(Lobe::refraction, surface, Sampling::cosine, random).wi;
    // sin 20 / 1.5 = sin 13.1801, and sin 20 * 1.5 = sin 30.8659.
    const Vec3 expected = -side * at_angle(side > 0 ? 13.180114 : 30.865883);
    if (length(wi - expected) < 1e-4f) continue;
    const Vec3 swapped =
        refract(surface.normal, wo, relative_eta(surface)).value_or(Vec3(0));
    FAIL_CHECK(
        std::string(side > 0 ? "outside" : "inside")
        << " glass, wo = " << wo << " is bent to " << wi << ", expected "
        << expected
        << std::string(length(wi - swapped) < 1e-4f
                           ? ": is wo the first argument of refract, and the "
                             "normal the second?"
                           : ""));
  }
}

TEST_CASE("each lobe's weight is its coefficient, without a cosine") {
  Material material;
  material.kd = {0.1f, 0.2f, 0.3f};
  material.ks = {0.3f, 0.2f, 0.1f};
  material.kt = {0.2f, 0.4f, 0.5f};
  Random random(1, 0, 0);
  for (const double degrees : {5.0, 40.0, 80.0}) {
    INFO("wo is at ", degrees, " degrees");
    const Vec3 wo = at_angle(degrees);
    const Hit hit = hit_on(material);
    for (const float side : {1.0f, -1.0f}) {
      const Surface surface(hit, material, side * wo);
      const auto one = [&](Lobe lobe) {
        return sample(lobe, surface, Sampling::cosine, random);
      };
      const BsdfSample diffuse = one(Lobe::diffuse);
      check_color("weight of the diffuse lobe, kd", diffuse.weight,
                  material.kd);
      INFO("wo is ", side * wo, " and the shape's normal ", up);
      CHECK_MESSAGE(side * diffuse.wi.z > 0, "the diffuse direction ",
                    diffuse.wi, " is on the other side than wo");
      check_color("weight of the specular lobe, ks",
                  one(Lobe::specular).weight, material.ks);
      CHECK_MESSAGE(
          length(one(Lobe::specular).wi - side * reflect(wo, up)) < 1e-5f,
          "the mirrored direction is ", one(Lobe::specular).wi, ", expected ",
          side * reflect(wo, up));
      const BsdfSample refracted = one(Lobe::refraction);
      if (side < 0 && degrees > 41) {
        check_color("weight where all is reflected, kt", refracted.weight,
                    material.kt);
        CHECK_MESSAGE(length(refracted.wi - side * reflect(wo, up)) < 1e-5f,
                      "beyond the critical angle the direction is ",
                      refracted.wi, ", expected the mirrored one, ",
                      side * reflect(wo, up));
        continue;
      }
      // Radiance grows by (eta_o / eta_i)^2 toward the side of wo.
      check_color(side > 0 ? "weight into glass of 1.5, kt / eta^2"
                           : "weight out of glass of 1.5, kt eta^2",
                  refracted.weight,
                  material.kt * (side > 0 ? 1 / 2.25f : 2.25f));
      CHECK_MESSAGE(side * refracted.wi.z < 0, "the refracted direction ",
                    refracted.wi, " is on the side of wo");
    }
  }
}

TEST_SUITE_END();
