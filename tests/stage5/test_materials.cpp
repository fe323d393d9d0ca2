// What a material is at a hit, and that the whole path uses it.

#include <doctest/doctest.h>

#include "stages/5_fresnel_textures/path_tracer.hpp"
#include "support/exact_radiance.hpp"
#include "support/specular_scenes.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using namespace lightwalk::stage5;

TEST_SUITE_BEGIN("units");

namespace {

/// The material of a ball of radius 1, seen squarely from outside.
Material seen(const std::string& material) {
  const Scene scene = in_white_room(material, ball("thing"));
  const auto hit = scene.nearest_hit({{0, 0, -5}, {0, 0, 1}});
  REQUIRE(hit.has_value());
  return material_at(scene, *hit, {0, 0, -1});
}

std::string floor_of(const std::string& material) {
  return "[materials]\nthing = " + material +
         "\nsky = { ke = 2 }\n[[shapes]]\ntype = \"plane\"\n"
         "normal = [0, 1, 0]\ndistance = 0\nmaterial = \"thing\"\n";
}

const Ray down{{0.5f, 0.5f, 0.5f}, {0, -1, 0}};

RenderSettings one_bounce() {
  RenderSettings settings;
  settings.max_bounces = 1;
  return settings;
}

}  // namespace

// F = 0.04: ks F, kt (1 - F), and kd as it was.
TEST_CASE("Fresnel shares out the coefficients of mirror and glass only") {
  const std::string k = "{ kd = 0.1, ks = [0.5, 0.9, 0.2], kt = 0.8, ";
  const Material m = seen(k + "eta = 1.5, fresnel = true }");
  check_color("kd with fresnel, as it was", m.kd, Vec3(0.1f));
  check_color("F ks with F = 0.04", m.ks, 0.04f * Vec3(0.5f, 0.9f, 0.2f),
              1e-3);
  check_color("(1 - F) kt with F = 0.04", m.kt, Vec3(0.96f * 0.8f));
  // At 85 degrees F is 0.61, not 0.04.
  const Scene scene = in_white_room(k + "fresnel = true }", ball("thing"));
  auto hit = scene.nearest_hit({{0, 0, -5}, {0, 0, 1}});
  REQUIRE(hit.has_value());
  const Material grazing =
      material_at(scene, *hit, normalize(Vec3(0, 0.99619f, -0.08716f)));
  if (!(grazing.ks.x > 0.5 * 0.55)) {
    FAIL_CHECK("at 85 degrees F ks is " << grazing.ks.x
                                        << " for ks = 0.5, expected 0.305");
  }
  check_color("kd with fresnel at 85 degrees, as it was", grazing.kd,
              Vec3(0.1f));
  check_value("F + (1 - F) at 85 degrees",
              red(grazing.ks / 0.5f + grazing.kt / 0.8f), 1);
}

// Of glass without a mirror lobe only the refraction is left: (1 - F) kt. What
// F would reflect is lost, inside beyond the critical angle all of it.
TEST_CASE("fresnel takes F from kt without ks, too, from either side") {
  const Scene scene =
      in_white_room("{ kt = 1, fresnel = true }", ball("thing"));
  const auto front = scene.nearest_hit({{0, 0, -5}, {0, 0, 1}});
  const auto back = scene.nearest_hit({{0, 0, 0}, {0, 0, 1}});
  REQUIRE(front.has_value());
  REQUIRE(back.has_value());
  const Vec3 squarely(0, 0, -1), aside = normalize(Vec3(1, 0, -1));
  check_color("(1 - F) kt outside, F = 0.04",
              material_at(scene, *front, squarely).kt, Vec3(0.96f));
  check_color("(1 - F) kt inside, seen squarely, F = 0.04",
              material_at(scene, *back, squarely).kt, Vec3(0.96f));
  check_color("(1 - F) kt inside at 45 degrees, F = 1",
              material_at(scene, *back, aside).kt, Vec3(0));
  check_color("F ks where ks is 0", material_at(scene, *back, aside).ks,
              Vec3(0));
}

// Patterns first: here the mirror's color comes from one.
TEST_CASE("a pattern is what Fresnel shares out") {
  const Material m = seen(
      "{ ks = { schlick = [0.5, 0.5] }, kt = { checker = [0.8, 0.8] }, "
      "eta = 1.5, fresnel = true }");
  check_color("F ks with F = 0.04 and ks from a pattern", m.ks,
              Vec3(0.5f * 0.04f), 1e-3);
  check_color("(1 - F) kt with F = 0.04 and kt from a pattern", m.kt,
              Vec3(0.8f * 0.96f));
}

TEST_CASE("each coefficient has its own pattern") {
  const Material m = seen(
      "{ kd = { checker = [0.1, 0.1] }, ks = { checker = [0.2, 0.2] }, "
      "kt = { checker = [0.3, 0.3] } }");
  check_color("kd from a pattern", m.kd, Vec3(0.1f));
  check_color("ks from a pattern", m.ks, Vec3(0.2f));
  check_color("kt from a pattern", m.kt, Vec3(0.3f));
}

// Both are looked up at the same (u, v).
TEST_CASE("two images on a material are two images") {
  Scene scene = in_white_room("{ kd = 0.5 }", ball("thing"));
  const auto hit = scene.nearest_hit({{0, 0, -5}, {0, 0, 1}});
  REQUIRE(hit.has_value());
  const auto plain = [](Texture& texture, std::uint8_t r, std::uint8_t g,
                        std::uint8_t b) {
    texture.width = texture.height = 1;
    texture.texels = {{r, g, b}};
    return VaryingCoefficient{VaryingType::image, Vec3(0), Vec3(0), 1,
                              &texture};
  };
  Texture red, blue, green;
  const VaryingCoefficient kd = plain(red, 255, 0, 0);
  const VaryingCoefficient ks = plain(blue, 0, 0, 255);
  const VaryingCoefficient kt = plain(green, 0, 255, 0);
  Material material;
  material.varying_kd = &kd;
  material.varying_ks = &ks;
  material.varying_kt = &kt;
  Hit there = *hit;
  there.material = &material;
  const Material m = material_at(scene, there, {0, 0, -1});
  check_color("kd from a red image", m.kd, Vec3(1, 0, 0));
  check_color("ks from a blue image", m.ks, Vec3(0, 0, 1));
  check_color("kt from a green image", m.kt, Vec3(0, 1, 0));
}

// From inside, at 45 degrees, all is reflected: the hit's normal points away
// from the viewer, and both the cosine and the indices are reversed.
TEST_CASE(
    "from inside, glass beyond the critical angle lets nothing through") {
  const Scene scene =
      in_white_room("{ ks = 1, kt = 1, fresnel = true }", ball("thing"));
  const auto hit = scene.nearest_hit({{0, 0, 0}, {0, 0, 1}});
  REQUIRE(hit.has_value());
  const Material beyond = material_at(scene, *hit, normalize(Vec3(1, 0, -1)));
  check_value("F ks inside at 45 degrees, F = 1", red(beyond.ks), 1);
  check_value("(1 - F) kt inside at 45 degrees, F = 1", red(beyond.kt), 0);
  const Material square = material_at(scene, *hit, {0, 0, -1});
  check_value("F ks inside, seen squarely, F = 0.04", red(square.ks), 0.04,
              1e-3);
}

TEST_CASE("Schlick's colors are the same from both sides") {
  const Scene scene =
      in_white_room("{ ks = { schlick = [0.2, 0.8] } }", ball("thing"));
  const auto hit = scene.nearest_hit({{0, 0, -5}, {0, 0, 1}});
  REQUIRE(hit.has_value());
  // cos = 1/2: 0.2 + 0.6 / 32.
  const Vec3 aside(0.8660254f, 0, 0);
  for (const float side : {-0.5f, 0.5f}) {
    check_value("k0 + (k90 - k0)(1 - cos)^5 with |cos| = 1/2, seen from " +
                    std::string(side < 0 ? "outside" : "inside"),
                red(material_at(scene, *hit, aside + Vec3(0, 0, side)).ks),
                0.2 + 0.6 / 32);
  }
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("analytic scenes");

// kd/pi I / h^2 with the kd of this square: the second of the checkers.
TEST_CASE("a patterned floor under a light: kd/pi I / h^2") {
  const Scene scene = scene_text(
      floor_of("{ kd = { checker = [0.2, 0.6], over = \"position\" } }") +
      "[[lights]]\ntype = \"point\"\ncenter = [0.5, 2, 0.5]\n"
      "intensity = 9\n");
  Random random(1, 0, 0);
  const PathTracer tracer(scene, one_bounce());
  // The cube below the floor, (0, -1, 0), is an odd one; its neighbor is not.
  check_value("kd/pi I/h^2 with the second color of the checkers",
              red(tracer.radiance(down, random)),
              0.6 / std::acos(-1.0) * 9 / 4);
  const Ray beside{{1.5f, 0.5f, 0.5f}, {0, -1, 0}};
  check_value("kd/pi I cos/d^2 with the first color of the checkers",
              red(tracer.radiance(beside, random)),
              0.2 / std::acos(-1.0) * 9 * 2 / std::pow(5.0, 1.5));
}

// The diffuse lobe is not shared out: kd/pi I cos/d^2 at any angle of view.
// The mirrored ray leaves the scene.
TEST_CASE(
    "direct light on varnish: kd/pi I cos/d^2, also at a grazing view") {
  const Scene scene =
      scene_text(floor_of("{ kd = 0.5, ks = 0.4, fresnel = true }") +
                 "[[lights]]\ntype = \"point\"\ncenter = [0, 2, 0]\n"
                 "intensity = 9\n");
  // F is 0.04, 0.25 and 0.61.
  for (const double degrees : {0.0, 75.0, 85.0}) {
    const double angle = degrees * std::acos(-1.0) / 180;
    const Vec3 wo(0, static_cast<float>(std::cos(angle)),
                  static_cast<float>(std::sin(angle)));
    check_radiance<PathTracer>("varnish seen at " + text_of(degrees) +
                                   " degrees under a point light",
                               scene, {wo, -wo}, one_bounce(),
                               DoubleVec3(0.5 / std::acos(-1.0) * 9 / 4));
  }
}

// The sky cannot be sampled, so its light comes from the path itself.
TEST_CASE("a patterned floor under a sky is kd ke") {
  for (const char* kind : {"kd", "ks"}) {
    const Scene scene = scene_text(
        floor_of(std::string("{ ") + kind + " = { checker = [0.6, 0.6] } }") +
        "[[shapes]]\ntype = \"plane\"\nnormal = [0, -1, 0]\ndistance = 5\n"
        "material = \"sky\"\n");
    const Pixel pixel =
        estimate(PathTracer(scene, one_bounce()), down, 20'000);
    check_mean(std::string("k ke under a sky, k a pattern of ") + kind, pixel,
               0, 0.6 * 2);
  }
}

// Every ray, of both events, brings 1.
TEST_CASE("a ball of Fresnel glass in a white room is invisible on average") {
  const Scene scene =
      in_white_room("{ ks = 1, kt = 1, fresnel = true }", ball("thing"));
  RenderSettings settings;
  settings.max_bounces = 60;
  const PathTracer tracer(scene, settings);
  const Pixel pixel = estimate_of_thing(tracer, 20'000, 9);
  check_mean("a Fresnel glass ball in a room of radiance 1", pixel, 0, 1,
             1e-5);
}

TEST_SUITE_END();
