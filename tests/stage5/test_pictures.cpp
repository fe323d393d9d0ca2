// Compares stage 5 with stage 4: without Fresnel and patterns nothing
// changes.

#include <doctest/doctest.h>

#include "stages/5_fresnel_textures/path_tracer.hpp"
#include "support/comparisons.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage5::PathTracer;

TEST_SUITE_BEGIN("relations");

TEST_CASE("without fresnel and patterns the picture is stage 4's") {
  for (const std::string name :
       {"cornell_box_point", "cornell_box_ceiling",
        "cornell_box_lamp_diffuse", "plastic", "coloured_lobes", "glass_cube",
        "mirror_corridor"}) {
    INFO("scene ", name);
    Scene scene = scene_file(name, 20, 20);
    RenderSettings settings;
    settings.samples_per_pixel = 8;
    const auto fourth = paint<stage4::PathTracer>(scene, settings);
    const auto fifth = paint<PathTracer>(scene, settings);
    const bool same_bits = fifth.radiance.pixels == fourth.radiance.pixels &&
                           fifth.variance.pixels == fourth.variance.pixels;
    if (same_bits) continue;
    // It draws other numbers, and has other noise.
    settings.samples_per_pixel = 512;
    const auto reference = paint<stage4::PathTracer>(scene, settings);
    check_same(renderer<PathTracer>(scene, settings), 256, reference);
  }
}

// A pattern that is the same everywhere is no pattern: checkers of two equal
// colors, and Schlick's curve between two.
TEST_CASE("a pattern of one color is that color, to the bit") {
  const auto picture = [](const std::string& coefficients) {
    Scene scene = scene_text("[materials]\nthing = " + coefficients +
                             "\nlamp = { ke = 1 }\n" +
                             R"([[shapes]]
type = "sphere"
center = [0, 0, 0]
radius = 0.8
material = "thing"
[[shapes]]
type = "plane"
normal = [0, -1, 0]
distance = 1
material = "lamp"
)");
    RenderSettings settings;
    settings.samples_per_pixel = 8;
    return paint<PathTracer>(scene, settings);
  };
  const auto plain = picture("{ kd = [0.6, 0.2, 0.1], ks = 0.25 }");
  check_same_bits(
      picture("{ kd = { checker = [[0.6, 0.2, 0.1], [0.6, 0.2, 0.1]] }, "
              "ks = { schlick = [0.25, 0.25] } }"),
      plain);
  check_same_bits(
      picture("{ kd = { checker = [[0.6, 0.2, 0.1], [0.6, 0.2, 0.1]], "
              "scale = 7, over = \"position\" }, ks = 0.25 }"),
      plain);
}

// The middle of the map faces the camera, north is up and east is right.
TEST_CASE("the globe's picture is the map: land where the map has land") {
  const Scene scene = scene_file("textured_globe", 64, 64);
  const Texture& map = scene.textures.front();
  for (const Vec2 at : {Vec2(0, 0), Vec2(0.3f, 0.2f), Vec2(-0.4f, 0.1f),
                        Vec2(0.1f, -0.45f)}) {
    const Vec3 normal(at.x, at.y, -std::sqrt(1 - dot(at, at)));
    const Vec3 point = Vec3(0, -0.1f, 0) + 0.7f * normal;
    const Vec3 origin(0, 0, -3.5f);
    const auto hit = scene.nearest_hit({origin, normalize(point - origin)});
    REQUIRE(hit.has_value());
    REQUIRE(length(hit->position - point) < 1e-4f);
    const float u = 0.5f + std::atan2(normal.x, -normal.z) / two_pi;
    const float v = 0.5f + std::asin(normal.y) / pi;
    const Vec3 kd = stage5::material_at(scene, *hit, -normal).kd;
    const Vec3 expected = stage5::image_color(map, {u, v}, true);
    INFO("kd at ", normal, " of the globe is ", kd,
         ", expected the map's color, ", expected);
    CHECK(length(kd - expected) < 1e-3f);
  }
}

// Both balls reflect the same share of grazing rays only if F is ignored: at
// 80 degrees F is 0.39, and the fixed ball's share is 0.1.
TEST_CASE(
    "Fresnel glass reflects more at its rim than glass without Fresnel") {
  const Scene scene = scene_file("fresnel_glass", 32, 32);
  const auto reflected = [&](float center_x, float degrees) {
    const Vec3 normal{0, 0, -1};
    const Vec3 center(center_x, -0.6f, 0);
    const Vec3 from = std::cos(degrees * pi / 180) * normal +
                      std::sin(degrees * pi / 180) * Vec3(0, 1, 0);
    const Vec3 origin = center + 0.4f * normal + 0.1f * from;
    const auto hit = scene.nearest_hit({origin, -from});
    REQUIRE(hit.has_value());
    return red(stage5::material_at(scene, *hit, from).ks);
  };
  check_value("F ks, seen squarely", reflected(-0.5f, 0), 0.04, 0.02);
  // Fresnel's equations say 0.3877 and Schlick's curve 0.4099.
  check_value("F ks at 80 degrees", reflected(-0.5f, 80), 0.3988, 0.06);
  check_value("ks without fresnel, seen squarely", reflected(0.5f, 0), 0.1);
  check_value("ks without fresnel, at 80 degrees", reflected(0.5f, 80), 0.1);
}

TEST_SUITE_END();
