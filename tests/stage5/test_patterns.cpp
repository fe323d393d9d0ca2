// Textures and patterns: which point of the picture belongs to a point of the
// shape, and which color it has.

#include <doctest/doctest.h>

#include "stages/5_fresnel_textures/path_tracer.hpp"
#include "support/expectations.hpp"
#include "support/renders.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using namespace lightwalk::stage5;

TEST_SUITE_BEGIN("units");

namespace {

/// The hit of the first shape that a ray toward `target` meets.
Vec2 uv_at(const Scene& scene, const Vec3& from, const Vec3& target) {
  const auto hit = scene.nearest_hit({from, normalize(target - from)});
  REQUIRE(hit.has_value());
  return texture_coordinates(scene, *hit);
}

Scene with(const std::string& shape) {
  return scene_text("[materials]\nm = { kd = 0.5 }\n[[shapes]]\n" + shape +
                    "\nmaterial = \"m\"\n");
}

/// Four texels: red, green above; blue, white below.
Texture four_texels() {
  Texture texture;
  texture.width = texture.height = 2;
  texture.texels = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 255}};
  return texture;
}

constexpr float tolerance = 1e-5f;

void check_color(const Vec3& color, const Vec3& expected,
                 SourceLine place = {__builtin_FILE(), __builtin_LINE()}) {
  if (length(color - expected) < 1e-4f) return;
  ADD_FAIL_CHECK_AT(place.file, place.line, "the color is ", color,
                    ", expected ", expected);
}

void check_image(const Texture& texture, const Vec2& uv, bool has_poles,
                 const Vec3& expected,
                 SourceLine place = {__builtin_FILE(), __builtin_LINE()}) {
  const Vec3 color = image_color(texture, uv, has_poles);
  if (length(color - expected) < 1e-4f) return;
  ADD_FAIL_CHECK_AT(
      place.file, place.line, "image_color at (u, v) = ", uv,
      std::string(has_poles ? ", with poles," : ", without poles,"),
      " of an image of ", texture.width, " x ", texture.height, " texels is ",
      color, ", expected ", expected);
}

void check_uv(const Vec2& uv, const Vec2& expected,
              SourceLine place = {__builtin_FILE(), __builtin_LINE()}) {
  if (glm::length(uv - expected) < 1e-4f) return;
  ADD_FAIL_CHECK_AT(place.file, place.line, "(u, v) is ", uv, ", expected ",
                    expected);
}

}  // namespace

TEST_CASE("a rectangle's uv run along its edges") {
  const Scene scene = with(
      "type = \"rectangle\"\ncorner = [1, 2, 3]\n"
      "edge_u = [2, 0, 0]\nedge_v = [0, 4, 0]");
  for (const Vec2 uv : {Vec2(0.1f, 0.2f), Vec2(0.9f, 0.5f)}) {
    check_uv(uv_at(scene, {1, 2, 0}, {1 + 2 * uv.x, 2 + 4 * uv.y, 3}), uv);
  }
}

TEST_CASE("a triangle's uv run along its first two edges") {
  const Scene scene = with(
      "type = \"triangle\"\n"
      "vertices = [[0, 0, 1], [2, 0, 1], [1, 3, 1]]");
  // corner + 0.25 (2, 0) + 0.5 (1, 3)
  const Vec2 uv = uv_at(scene, {0, 0, 0}, {1, 1.5f, 1});
  check_uv(uv, {0.25f, 0.5f});
}

TEST_CASE("a plane's uv are distances along two axes square to its normal") {
  const Scene scene =
      with("type = \"plane\"\nnormal = [0, 1, 0]\ndistance = 1");
  const Vec2 a = uv_at(scene, {0, 0, 0}, {0.5f, -1, 0.25f});
  const Vec2 b = uv_at(scene, {0, 0, 0}, {2.5f, -1, 0.25f});
  const Vec2 c = uv_at(scene, {0, 0, 0}, {0.5f, -1, 3.25f});
  INFO("three points of the plane have (u, v) = ", a, ", ", b, " and ", c,
       ", expected the second 2 and the third 3 from the first, at a right "
       "angle");
  CHECK(glm::length(a - b) == doctest::Approx(2).epsilon(tolerance));
  CHECK(glm::length(a - c) == doctest::Approx(3).epsilon(tolerance));
  CHECK(glm::dot(a - b, a - c) == doctest::Approx(0).epsilon(tolerance));
}

// The lab's box has its walls one unit away, their normals toward the
// middle, and its camera looks along +z with -x to the left and +y up. So for
// an eye in the middle the first point here is at the lower left of a wall's
// picture, and the next two are right of it and above it. On the floor and
// the ceiling, above is farther from the camera.
TEST_CASE("a picture on a plane stands upright and is not mirrored") {
  struct Case {
    const char* normal;
    Vec3 low_left, right, up;
  };
  const Case cases[] = {
      {"[0, 0, -1]", {-0.9f, -0.9f, 1}, {1, 0, 0}, {0, 1, 0}},  // back
      {"[0, 0, 1]", {0.9f, -0.9f, -1}, {-1, 0, 0}, {0, 1, 0}},  // behind
      {"[1, 0, 0]", {-1, -0.9f, -0.9f}, {0, 0, 1}, {0, 1, 0}},  // left
      {"[-1, 0, 0]", {1, -0.9f, 0.9f}, {0, 0, -1}, {0, 1, 0}},  // right
      {"[0, 1, 0]", {-0.9f, -1, -0.9f}, {1, 0, 0}, {0, 0, 1}},  // floor
      {"[0, -1, 0]", {0.9f, 1, -0.9f}, {-1, 0, 0}, {0, 0, 1}},  // ceiling
      {"[0, 1e-6, -1]", {-0.9f, -0.9f, 1}, {1, 0, 0}, {0, 1, 0}},
      {"[1e-6, -1, 1e-6]", {0.9f, 1, -0.9f}, {-1, 0, 0}, {0, 0, 1}}};
  for (const Case& one : cases) {
    INFO("the plane's normal is ", std::string(one.normal));
    const Scene scene = with(std::string("type = \"plane\"\nnormal = ") +
                             one.normal + "\ndistance = 1");
    const auto uv = [&](const Vec3& x) { return uv_at(scene, {0, 0, 0}, x); };
    const Vec2 u = uv(one.low_left + one.right) - uv(one.low_left);
    const Vec2 v = uv(one.low_left + one.up) - uv(one.low_left);
    INFO("to the right (u, v) changes by ", u,
         ", expected (1, 0), and "
         "upwards by ",
         v, ", expected (0, 1)");
    CHECK(glm::length(u - Vec2(1, 0)) < 1e-4f);
    CHECK(glm::length(v - Vec2(0, 1)) < 1e-4f);
  }
}

// A roof that rises at 45 degrees toward +z: v is measured along it.
TEST_CASE("on a slope v is measured along the plane") {
  const Scene scene =
      with("type = \"plane\"\nnormal = [0, 1, -1]\ndistance = 1");
  const Vec3 foot(0.2f, -1, 0);
  const Vec2 a = uv_at(scene, {0, 0, 0}, foot);
  const Vec2 b = uv_at(scene, {0, 0, 0}, foot + Vec3(0, 1, 1));
  const Vec2 c = uv_at(scene, {0, 0, 0}, foot + Vec3(1, 0, 0));
  INFO("up the slope (u, v) changes by ", b - a,
       ", expected (0, 1.41421), and to the right by ", c - a,
       ", expected (1, 0)");
  CHECK(glm::length(b - a - Vec2(0, std::sqrt(2.0f))) < 1e-4f);
  CHECK(glm::length(c - a - Vec2(1, 0)) < 1e-4f);
}

// Longitude 0, the middle of the map, is toward -z; east is toward +x,
// which is to the right for a camera that looks along +z.
TEST_CASE("a sphere is a globe: middle to -z, east to +x, north to +y") {
  const Scene scene =
      with("type = \"sphere\"\ncenter = [0, 0, 0]\nradius = 2");
  struct Case {
    Vec3 from;
    float u, v;
  };
  const Case cases[] = {{{0, 0, -9}, 0.5f, 0.5f},
                        {{9, 0, 0}, 0.75f, 0.5f},
                        {{-9, 0, 0}, 0.25f, 0.5f},
                        {{0, 9, -9}, 0.5f, 0.75f},
                        {{0, -9, -9}, 0.5f, 0.25f}};
  for (const Case& one : cases) {
    const Vec2 uv = uv_at(scene, one.from, {0, 0, 0});
    INFO("seen from ", one.from);
    check_uv(uv, {one.u, one.v});
  }
  const auto north = static_cast<double>(uv_at(scene, {0, 9, 0}, {}).y);
  check_value("v at the north pole", north, 1, 1e-5);
  const Vec2 south = uv_at(scene, {0, -9, 0}, {0, 0, 0});
  INFO("at the south pole v is ", south.y, ", expected 0");
  CHECK(std::abs(south.y) < 1e-5f);
  const Vec2 east = uv_at(scene, {0.01f, 0, 9}, {0, 0, 0});
  const Vec2 west = uv_at(scene, {-0.01f, 0, 9}, {0, 0, 0});
  INFO("just beside the seam u is ", east.x,
       " in the far east, expected 1, "
       "and ",
       west.x, " in the far west, expected 0");
  CHECK(east.x > 0.99f);
  CHECK(west.x < 0.01f);
}

TEST_CASE("a texel has its color at its center, v = 0 at the bottom") {
  const Texture texture = four_texels();
  check_image(texture, {0.25f, 0.75f}, false, {1, 0, 0});
  check_image(texture, {0.75f, 0.75f}, false, {0, 1, 0});
  check_image(texture, {0.25f, 0.25f}, false, {0, 0, 1});
  check_image(texture, {0.75f, 0.25f}, false, {1, 1, 1});
}

TEST_CASE("at the same (u, v) each picture has its own color") {
  Texture other = four_texels();
  std::reverse(other.texels.begin(), other.texels.end());
  check_image(four_texels(), {0.25f, 0.75f}, false, {1, 0, 0});
  check_image(other, {0.25f, 0.75f}, false, {1, 1, 1});
}

TEST_CASE("between texels the color is mixed") {
  const Texture texture = four_texels();
  check_image(texture, {0.5f, 0.75f}, false, {0.5f, 0.5f, 0});
  check_image(texture, {0.5f, 0.5f}, false, {0.5f, 0.5f, 0.5f});
  check_image(texture, {0.375f, 0.75f}, false, {0.75f, 0.25f, 0});
}

// 3 x 2 texels: the second column's center is at u = 1/2, the upper row's at
// v = 3/4. A quarter of the way down to the lower row v is 5/8.
TEST_CASE("a picture need not be square") {
  Texture texture;
  texture.width = 3;
  texture.height = 2;
  texture.texels = {{0, 0, 0}, {255, 0, 0}, {0, 0, 0},
                    {0, 0, 0}, {0, 255, 0}, {255, 255, 255}};
  check_image(texture, {0.5f, 0.75f}, false, {1, 0, 0});
  check_image(texture, {0.5f, 0.625f}, false, {0.75f, 0.25f, 0});
  check_image(texture, {5 / 6.0f, 0.25f}, false, {1, 1, 1});
  check_image(texture, {0.5f, 0.25f}, false, {0, 1, 0});
}

TEST_CASE("a picture repeats, and mixes across its edges") {
  const Texture texture = four_texels();
  for (const float shift : {-3.0f, -1.0f, 1.0f, 7.0f}) {
    check_image(texture, {0.25f + shift, 0.75f}, false, {1, 0, 0});
    check_image(texture, {0.25f, 0.75f + shift}, false, {1, 0, 0});
  }
  check_image(texture, {0, 0.75f}, false, {0.5f, 0.5f, 0});
  check_image(texture, {1, 0.75f}, false, {0.5f, 0.5f, 0});
  check_image(texture, {-1e-9f, 0.75f}, false, {0.5f, 0.5f, 0});
}

// To the left of the first column is the last one, not the second.
TEST_CASE("a picture of three columns repeats to the left as to the right") {
  Texture texture;
  texture.width = 3;
  texture.height = 1;
  texture.texels = {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}};
  const Vec3 columns[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = -6; i < 6; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / 3;
    check_image(texture, {u, 0.5f}, false, columns[(i + 6) % 3]);
  }
  for (const float u : {-2.0f, -1.0f, 0.0f, 1.0f}) {
    check_image(texture, {u, 0.5f}, false, {0.5f, 0, 0.5f});
  }
}

// One texel is white, and a quarter of a texel from its center, along each
// axis, it has 3/4 of the weight along that axis.
TEST_CASE("each texel is mixed with its neighbors on all sides") {
  for (const auto& [width, height] : {std::pair{4, 3}, std::pair{3, 4}}) {
    for (int place = 0; place < width * height; ++place) {
      Texture texture;
      texture.width = width;
      texture.height = height;
      texture.texels.resize(static_cast<std::size_t>(width * height));
      texture.texels[static_cast<std::size_t>(place)] = {255, 255, 255};
      const int column = place % width, row = place / width;
      for (const Vec2 aside : {Vec2(0.25f, 0.25f), Vec2(-0.25f, 0.25f),
                               Vec2(0.25f, -0.25f), Vec2(-0.25f, -0.25f)}) {
        INFO("one texel is white, in column ", column, ", row ", row);
        const float x = static_cast<float>(column) + 0.5f + aside.x;
        const float y = static_cast<float>(row) + 0.5f + aside.y;
        check_image(texture,
                    {x / static_cast<float>(width),
                     1 - y / static_cast<float>(height)},
                    false, Vec3(0.75f * 0.75f));
      }
    }
  }
}

TEST_CASE("the poles of a globe do not mix") {
  const Texture texture = four_texels();
  check_image(texture, {0.25f, 1}, true, {1, 0, 0});
  check_image(texture, {0.25f, 0}, true, {0, 0, 1});
  check_image(texture, {0, 0.75f}, true, {0.5f, 0.5f, 0});
}

TEST_CASE("the poles of a map that is not square do not mix") {
  for (const auto& [width, height] : {std::pair{6, 2}, std::pair{2, 6}}) {
    Texture texture;
    texture.width = width;
    texture.height = height;
    const auto row = static_cast<std::size_t>(width);
    texture.texels.resize(row * static_cast<std::size_t>(height));
    std::fill_n(texture.texels.begin(), row,
                decltype(texture.texels)::value_type{255, 0, 0});
    std::fill_n(texture.texels.rbegin(), row,
                decltype(texture.texels)::value_type{0, 0, 255});
    check_image(texture, {0.4f, 1}, true, {1, 0, 0});
    check_image(texture, {0.4f, 0}, true, {0, 0, 1});
  }
}

TEST_CASE(
    "a picture on a rectangle repeats upwards and on a globe does not") {
  const Texture texture = four_texels();
  const VaryingCoefficient pattern{VaryingType::image, Vec3(0), Vec3(0), 1,
                                   &texture};
  // The upper edge of the rectangle mixes upper and lower row; the north pole
  // is half red and half green, whichever way it is turned.
  const Scene flat = with(
      "type = \"rectangle\"\ncorner = [0, 0, 1]\n"
      "edge_u = [1, 0, 0]\nedge_v = [0, 1, 0]");
  const Vec3 edge(0.25f, 0.9999999f, 1);
  const auto on_flat = flat.nearest_hit({{0, 0, 0}, normalize(edge)});
  REQUIRE(on_flat.has_value());
  check_color(coefficient_at(pattern, flat, *on_flat, {0, 0, -1}),
              {0.5f, 0, 0.5f});
  const Scene globe =
      with("type = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1");
  const auto on_globe = globe.nearest_hit({{0, 5, 0}, {0, -1, 0}});
  REQUIRE(on_globe.has_value());
  const float blue = coefficient_at(pattern, globe, *on_globe, {0, 1, 0}).z;
  INFO("the blue of the globe's north pole is ", blue, ", expected 0");
  CHECK(blue == doctest::Approx(0));
}

TEST_CASE("a globe's map moves with it") {
  const Scene scene =
      with("type = \"sphere\"\ncenter = [3, -2, 7]\nradius = 2");
  const Vec2 uv = uv_at(scene, {3, -2, 0}, {3, -2, 7});
  check_uv(uv, {0.5f, 0.5f});
}

TEST_CASE("each rectangle has its own uv") {
  const Scene scene = with(
      "type = \"rectangle\"\ncorner = [5, 5, 5]\nedge_u = [1, 0, 0]\n"
      "edge_v = [0, 1, 0]\nmaterial = \"m\"\n[[shapes]]\n"
      "type = \"rectangle\"\ncorner = [0, 0, 1]\nedge_u = [1, 0, 0]\n"
      "edge_v = [0, 1, 0]");
  const Vec2 uv = uv_at(scene, {0.25f, 0.5f, 0}, {0.25f, 0.5f, 1});
  check_uv(uv, {0.25f, 0.5f});
}

TEST_CASE("each triangle has its own uv") {
  const Scene scene = with(
      "type = \"triangle\"\nvertices = [[5, 5, 5], [6, 5, 5], [5, 6, 5]]\n"
      "material = \"m\"\n[[shapes]]\n"
      "type = \"triangle\"\nvertices = [[0, 0, 1], [1, 0, 1], [0, 1, 1]]");
  check_uv(uv_at(scene, {0.25f, 0.5f, 0}, {0.25f, 0.5f, 1}), {0.25f, 0.5f});
}

// A scale that is odd: a cube that is one too deep would have another color.
TEST_CASE("checkers over the position are cubes of 1/scale") {
  const Scene scene =
      with("type = \"plane\"\nnormal = [0, 1, 0]\ndistance = 0.1");
  const VaryingCoefficient pattern{VaryingType::position_checker, Vec3(1),
                                   Vec3(0), 3, nullptr};
  // 3 (x, -0.1, 0.1) lies in the cubes floor(3 x), -1, 0.
  for (int i = 0; i < 4; ++i) {
    const float x = (static_cast<float>(i) + 0.5f) / 3;
    const auto hit = scene.nearest_hit({{x, 1, 0.1f}, {0, -1, 0}});
    REQUIRE(hit.has_value());
    check_color(coefficient_at(pattern, scene, *hit, {0, 1, 0}),
                Vec3(i % 2 == 0 ? 0.0f : 1.0f));
  }
}

// IEC 61966-2-1: 188 is 0.5029 linear, 55 is 0.0382, 10 is 10/255/12.92.
TEST_CASE("texels are decoded from sRGB, once, and before they are mixed") {
  Texture texture;
  texture.width = 2;
  texture.height = 1;
  texture.texels = {{188, 55, 10}, {0, 0, 0}};
  check_image(texture, {0.25f, 0.5f}, false,
              {0.502886f, 0.038204f, 0.003035f});
  check_image(texture, {0.5f, 0.5f}, false,
              {0.251443f, 0.019102f, 0.001518f});
}

TEST_CASE("checkers over uv: squares of 1/scale, the first at the corner") {
  const Scene scene = with(
      "type = \"rectangle\"\ncorner = [0, 0, 1]\n"
      "edge_u = [1, 0, 0]\nedge_v = [0, 1, 0]");
  const VaryingCoefficient pattern{VaryingType::checker, Vec3(1), Vec3(0), 4,
                                   nullptr};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      const Vec3 target((static_cast<float>(column) + 0.5f) / 4,
                        (static_cast<float>(row) + 0.5f) / 4, 1);
      const auto hit = scene.nearest_hit({{0, 0, 0}, normalize(target)});
      const Vec3 color = coefficient_at(pattern, scene, *hit, {0, 0, -1});
      INFO("row ", row, ", column ", column);
      check_color(color, Vec3((row + column) % 2 == 0 ? 1.0f : 0.0f));
    }
  }
}

TEST_CASE("checkers over the position alternate along all three axes") {
  struct Case {
    Vec3 x;
    bool expected;
    std::string rounded_down;
  };
  const Case cases[] = {{{0.5f, 0.5f, 0.5f}, false, "0 + 0 + 0 = 0"},
                        {{1.5f, 0.5f, 0.5f}, true, "1 + 0 + 0 = 1"},
                        {{0.5f, -0.5f, 0.5f}, true, "0 - 1 + 0 = -1"},
                        {{0.5f, 0.5f, -0.5f}, true, "0 + 0 - 1 = -1"},
                        {{-0.5f, -0.5f, 0.5f}, false, "-1 - 1 + 0 = -2"}};
  for (const Case& one : cases) {
    if (is_odd(one.x) == one.expected) continue;
    FAIL_CHECK("is_odd of " << one.x << " is "
                            << (one.expected ? "false, expected true"
                                             : "true, expected false")
                            << ": rounded down, " << one.rounded_down);
  }
}

// The floor y = -1 lies between two layers of cubes: rounding must not choose.
TEST_CASE("a floor between two layers of cubes has no stray spots") {
  const Scene scene =
      with("type = \"plane\"\nnormal = [0, 1, 0]\ndistance = 1");
  const VaryingCoefficient pattern{VaryingType::position_checker, Vec3(1),
                                   Vec3(0), 1, nullptr};
  Random random(1, 0, 0);
  for (int i = 0; i < 2000; ++i) {
    const Vec2 u(random.uniform_2d());
    const Vec3 target(0.01f + 0.98f * u.x, -1, 2.01f + 0.98f * u.y);
    const auto hit = scene.nearest_hit(
        {{0, 0.3f, 0}, normalize(target - Vec3(0, 0.3f, 0))});
    // The cube below: floor(x), floor(y), floor(z) are 0, -2 and 2.
    const Vec3 color = coefficient_at(pattern, scene, *hit, {0, 1, 0});
    INFO("at ", target, " the color is ", color,
         ", expected that of the cubes below the floor, ", Vec3(1));
    REQUIRE(color == Vec3(1));
  }
}

// cos = 1/2: (1 - 1/2)^5 = 1/32.
TEST_CASE("Schlick's curve goes from the square view to the grazing one") {
  const Vec3 squarely(0.04f, 0.1f, 0.5f), grazing(1, 0.9f, 0.5f);
  const auto check = [&](float cos_theta, const Vec3& expected) {
    const Vec3 color = schlick(squarely, grazing, cos_theta);
    if (length(color - expected) < 1e-4f) return;
    FAIL_CHECK("schlick of k0 = " << squarely << " and k90 = " << grazing
                                  << " with cos theta = " << cos_theta
                                  << " is " << color << ", expected "
                                  << expected);
  };
  check(1, squarely);
  check(0, grazing);
  check(0.5f, squarely + (grazing - squarely) / 32.0f);
}

TEST_SUITE_END();
