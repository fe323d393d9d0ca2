#include <doctest/doctest.h>

#include <cmath>

#include "common/image/tone_mapping.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

constexpr float rounding = 1e-6f;

Image row(std::initializer_list<Vec3> pixels) {
  Image image(static_cast<int>(pixels.size()), 1);
  image.pixels = pixels;
  return image;
}

Image mapped(const Image& image, std::vector<ToneStep> steps,
             float exposure = 0, float gamma = 2.2f) {
  return tone_map(image, {exposure, std::move(steps), gamma});
}

}  // namespace

TEST_CASE("clamp keeps what a screen can show and cuts off the rest") {
  const Image image =
      mapped(row({{0.25f, 1, 3}, {0, 0.5f, 100}}), {ToneStep::clamp});
  CHECK(image.at(0, 0) == Vec3(0.25f, 1, 1));
  CHECK(image.at(1, 0) == Vec3(0, 0.5f, 1));
}

TEST_CASE("equalize makes the largest channel of all pixels 1") {
  const Image image =
      mapped(row({{0.5f, 1, 2}, {8, 4, 0}}), {ToneStep::equalize});
  CHECK(image.at(0, 0) == Vec3(0.0625f, 0.125f, 0.25f));
  CHECK(image.at(1, 0) == Vec3(1, 0.5f, 0));
}

TEST_CASE("equalize brightens an image that is dark") {
  const Image image = mapped(row({{0.01f, 0, 0.02f}}), {ToneStep::equalize});
  CHECK(image.at(0, 0) == Near{{0.5f, 0, 1}, rounding});
}

// (1/4)^(1/2) = 1/2; with 2.2, 0.5^(1/2.2) = 0.7297.
TEST_CASE("gamma raises to 1 / gamma") {
  CHECK(mapped(row({{0, 0.25f, 1}}), {ToneStep::gamma}, 0, 2).at(0, 0) ==
        Near{{0, 0.5f, 1}, rounding});
  CHECK(mapped(row({{0.5f, 0.5f, 0.5f}}), {ToneStep::gamma}).at(0, 0) ==
        Near{Vec3(0.7297401f), rounding});
  CHECK(mapped(row({{0.3f, 0.6f, 0.9f}}), {ToneStep::gamma}, 0, 1).at(0, 0) ==
        Near{{0.3f, 0.6f, 0.9f}, rounding});
}

TEST_CASE("reinhard is x / (1 + x), which never reaches 1") {
  const Image image =
      mapped(row({{0, 1, 3}, {1000, 0.25f, 9}}), {ToneStep::reinhard});
  CHECK(image.at(0, 0) == Near{{0, 0.5f, 0.75f}, rounding});
  CHECK(image.at(1, 0) == Near{{1000.0f / 1001, 0.2f, 0.9f}, rounding});
  CHECK(image.at(1, 0).x < 1);
}

TEST_CASE("exposure counts stops: each doubles, before any step") {
  const Image image = row({{0.1f, 0.2f, 1}});
  CHECK(mapped(image, {ToneStep::clamp}, 2).at(0, 0) ==
        Near{{0.4f, 0.8f, 1}, rounding});
  CHECK(mapped(image, {ToneStep::clamp}, -1).at(0, 0) ==
        Near{{0.05f, 0.1f, 0.5f}, rounding});
  CHECK(mapped(image, {ToneStep::reinhard}, 1).at(0, 0).z ==
        doctest::Approx(2.0 / 3));
  CHECK(mapped(image, {ToneStep::equalize}, 5).at(0, 0) ==
        Near{{0.1f, 0.2f, 1}, rounding});
}

// For 4 and 1: clamp first leaves 1 and 1; equalize first 1 and 1/4. And
// equalize, gamma 2 is 1 and 1/2, gamma 2, clamp is 1 and 1.
TEST_CASE("steps are taken in the order in which they are given") {
  const Image image = row({{4, 1, 0}});
  CHECK(mapped(image, {ToneStep::clamp, ToneStep::equalize}).at(0, 0) ==
        Vec3(1, 1, 0));
  CHECK(mapped(image, {ToneStep::equalize, ToneStep::clamp}).at(0, 0) ==
        Vec3(1, 0.25f, 0));
  CHECK(mapped(image, {ToneStep::equalize, ToneStep::gamma}, 0, 2).at(0, 0) ==
        Near{{1, 0.5f, 0}, rounding});
  CHECK(mapped(image, {ToneStep::reinhard, ToneStep::equalize}).at(0, 0) ==
        Near{{1, 0.625f, 0}, rounding});
}

TEST_CASE("the slides' mapping, equalize and gamma 2.2, is the default") {
  const Image image = row({{8, 4, 0}});
  CHECK(tone_map(image, {}).at(0, 0) == Near{{1, 0.7297401f, 0}, rounding});
}

TEST_CASE("without any step the image is only cut off at 1") {
  CHECK(mapped(row({{0.5f, 2, 0}}), {}).at(0, 0) == Vec3(0.5f, 1, 0));
}

TEST_CASE("a black image stays black, by every step") {
  for (const ToneStep step : {ToneStep::clamp, ToneStep::equalize,
                              ToneStep::gamma, ToneStep::reinhard}) {
    const Image image = mapped(Image(2, 2), {step});
    CAPTURE(static_cast<int>(step));
    for (const Vec3& pixel : image.pixels) CHECK(pixel == Vec3(0));
  }
}

TEST_CASE("whatever the light, every channel ends up in [0, 1]") {
  for (const float size : {1e-44f, 1e-39f, 1e-30f, 1.0f, 1e3f, 1e30f}) {
    for (const ToneStep first : {ToneStep::clamp, ToneStep::equalize,
                                 ToneStep::gamma, ToneStep::reinhard}) {
      for (const ToneStep second : {ToneStep::equalize, ToneStep::gamma}) {
        const Image image =
            mapped(row({{size, 0, size / 3}, {0.7f * size, 2 * size, 0}}),
                   {first, second});
        CAPTURE(size);
        CAPTURE(static_cast<int>(first));
        CAPTURE(static_cast<int>(second));
        for (const Vec3& pixel : image.pixels) {
          for (int c = 0; c < 3; ++c) {
            CHECK(pixel[c] >= 0);
            CHECK(pixel[c] <= 1);
          }
        }
      }
    }
  }
}

TEST_CASE("the largest value of an image is over all channels and pixels") {
  CHECK(max_value(row({{1, 2, 3}, {7, 5, 0}})) == 7);
  CHECK(max_value(Image(3, 3)) == 0);
}
