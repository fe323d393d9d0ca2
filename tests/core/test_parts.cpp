// The parts of a failing picture, and what is said of them.

#include <doctest/doctest.h>

#include <fstream>
#include <functional>

#include "common/math/random.hpp"
#include "common/render/film.hpp"
#include "compare/part_story.hpp"
#include "tests/core/temporary_folder.hpp"

using namespace lightwalk;

namespace {

using Mean = std::function<Vec3(int x, int y)>;

/// A 32 x 32 picture of noise: the mean of samples that are uniform in
/// [0, 2 mean), which is nearly normal and here the sum of twelve numbers.
RenderResult noise(const Mean& mean, int samples, std::uint64_t seed) {
  RenderResult result{Image(32, 32), Image(32, 32), {}};
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      Random random(seed, pixel_index(32, x, y), 0);
      for (int c = 0; c < 3; ++c) {
        float normal = -6;
        for (int i = 0; i < 12; ++i) normal += random.uniform();
        const float m = mean(x, y)[c];
        const float variance = m * m / 3;
        result.variance.at(x, y)[c] = variance;
        result.radiance.at(x, y)[c] =
            m + normal * std::sqrt(variance / static_cast<float>(samples));
      }
    }
  }
  result.info.samples_per_pixel = samples;
  return result;
}

/// The ball in the middle of the picture: four times four tiles.
bool on_ball(int x, int y) {
  return x >= 8 && x < 24 && y >= 8 && y < 24;
}

/// A scene in which light comes in up to three bounces, each half as much.
Vec3 light(int bounces, int x, int) {
  const float shade = 1 + static_cast<float>(x) / 32;
  return Vec3(shade * (2 - std::pow(0.5f, static_cast<float>(bounces))));
}

PartsView view() {
  PartsView view;
  view.factors = usual_factors();
  SeenThing ball{"'glass'", std::vector<int>(64), {}};
  SeenThing wall{"'white'", std::vector<int>(64), {}};
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      const auto tile = static_cast<std::size_t>(y / 4 * 8 + x / 4);
      ++(on_ball(x, y) ? ball : wall).pixels[tile];
    }
  }
  ball.coefficients = {{"kd", {0.9, 0.6, 0.3}}};
  wall.coefficients = {{"kd", {0.8, 0.8, 0.8}}};
  view.pixels.assign(64, 16);
  view.things = {ball, wall};
  return view;
}

/// What is said where `mistake` changes the light of `bounces` at a pixel.
std::string story(
    const std::function<Vec3(int bounces, int x, int y)>& mistake,
    std::uint64_t seed = 1) {
  std::vector<Part> right;
  std::vector<PartVerdict> verdicts;
  for (int i = 0; i < 4; ++i) {
    const std::string name = bounces_name(static_cast<std::size_t>(i));
    const Mean good = [i](int x, int y) { return light(i, x, y); };
    const Mean bad = [&](int x, int y) { return mistake(i, x, y); };
    right.push_back(part_of(noise(good, 16384, 99), name));
    verdicts.push_back(judge_part(part_of(noise(bad, 1024, seed), name),
                                  part_of(noise(bad, 1024, seed + 1), name),
                                  right.back(),
                                  i > 0 ? &right[right.size() - 2] : nullptr,
                                  {tiles_of(view().things[0], view()),
                                   tiles_of(view().things[1], view())},
                                  8));
  }
  return tell_parts(verdicts, right, view());
}

bool contains(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

PartVerdict verdict(const std::string& name, bool wrong, bool right) {
  PartVerdict result;
  result.name = name;
  result.wrong = wrong;
  result.right = right;
  return result;
}

}  // namespace

TEST_CASE("parts: what is right is not called wrong") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    CHECK(story(light, 10 * seed) ==
          "With max_bounces 0, 1, 2 and 3 it is right.");
  }
}

// A tenth of what the last bounce adds is 1 % of the picture.
TEST_CASE("parts: what may be wrong is not called right") {
  const std::string text = story([](int bounces, int x, int y) {
    Vec3 all = light(std::min(bounces, 2), x, y);
    if (bounces == 3) all += 0.88f * (light(3, x, y) - all);
    return all;
  });
  CHECK(text == "With max_bounces 0, 1 and 2 it is right.");
}

TEST_CASE("parts: a constant factor in the second bounce") {
  const std::string text = story([](int bounces, int x, int y) {
    Vec3 all = light(std::min(bounces, 1), x, y);
    if (bounces >= 2) all += (light(bounces, x, y) - all) / 3.14159265f;
    return all;
  });
  CAPTURE(text);
  CHECK(contains(text,
                 "With max_bounces 0 and 1 it is right, and wrong from "
                 "2 on, everywhere; the light of 2 bounces: it is 0.3"));
  CHECK(contains(text,
                 "times what it should be, in all channels (that is "
                 "1/pi)."));
}

TEST_CASE("parts: a factor that is nothing in particular gets no name") {
  const std::string text = story(
      [](int bounces, int x, int y) { return 1.37f * light(bounces, x, y); });
  CAPTURE(text);
  CHECK(contains(text, "wrong with max_bounces 0 already, everywhere"));
  CHECK(
      contains(text, "it is 1.37 times what it should be, in all channels."));
}

TEST_CASE("parts: only where one thing is seen, and in one channel") {
  const std::string text = story([](int bounces, int x, int y) {
    const bool wrong = bounces > 0 && on_ball(x, y);
    return light(bounces, x, y) * (wrong ? Vec3(1, 2, 1) : Vec3(1));
  });
  CAPTURE(text);
  CHECK(contains(text, "wrong from 1 on, only where 'glass' is seen"));
  CHECK(contains(text, "in green for sure"));
  CHECK_FALSE(contains(text, "red"));
}

TEST_CASE("parts: no thing is blamed for what is wrong beside it too") {
  const std::string text = story([](int bounces, int x, int y) {
    return light(bounces, x, y) * (y > 16 ? 1.5f : 1.0f);
  });
  CAPTURE(text);
  CHECK_FALSE(contains(text, "seen"));
  CHECK_FALSE(contains(text, "everywhere"));
  CHECK(contains(text, "in all tiles together it is 23 % too bright"));
}

TEST_CASE("parts: a factor for each thing") {
  const std::string text = story([](int bounces, int x, int y) {
    return light(bounces, x, y) * (on_ball(x, y) ? 0.5f : 0.7f);
  });
  CAPTURE(text);
  CHECK(contains(text,
                 "it is 0.5 times what it should be where 'glass' is "
                 "seen, 0.7 times what it should be where 'white' is "
                 "seen, in all channels"));
}

TEST_CASE("parts: a factor that changes from tile to tile") {
  const std::string text = story([](int bounces, int x, int y) {
    return light(bounces, x, y) * (1.2f + static_cast<float>(x) / 16);
  });
  CAPTURE(text);
  CHECK(contains(text, "everywhere"));
  CHECK(contains(text, "by no constant factor"));
}

TEST_CASE("parts: a picture is not right while a thing in it may be wrong") {
  const auto picture = [](float ball) {
    return part_of(
        noise([ball](int x,
                     int y) { return Vec3(on_ball(x, y) ? ball : 1.0f); },
              16384, 1),
        "kd");
  };
  const Part right = picture(0.05f), wrong = picture(0.04f);
  const std::vector<Tiles> ball = {tiles_of(view().things[0], view())};
  CHECK(surely_right(wrong, right, nullptr, std::vector<Tiles>{}));
  CHECK_FALSE(surely_right(wrong, right, nullptr, ball));
  CHECK(surely_right(right, right, nullptr, ball));
}

TEST_CASE("parts: a coefficient too many, of each thing its own") {
  const std::string text = story([](int bounces, int x, int y) {
    const Vec3 kd = on_ball(x, y) ? Vec3(0.9f, 0.6f, 0.3f) : Vec3(0.8f);
    return light(bounces, x, y) * kd;
  });
  CAPTURE(text);
  CHECK(
      contains(text, "it has the factor kd of what is seen once too often"));
}

TEST_CASE("parts: light that is missing") {
  const std::string text = story([](int bounces, int x, int y) {
    return bounces == 0 ? light(0, x, y) : Vec3(light(0, x, y));
  });
  CAPTURE(text);
  CHECK(contains(text, "the light of one bounce: it is missing"));
}

TEST_CASE("parts: the bound is off by one, or does nothing") {
  CHECK(contains(story([](int bounces, int x, int y) {
                   return light(bounces + 1, x, y);
                 }),
                 "the right one of N + 1: the bound is off by one"));
  CHECK(contains(story([](int bounces, int x, int y) {
                   return light(std::max(0, bounces - 1), x, y);
                 }),
                 "the right one of N - 1: the bound is off by one"));
}

TEST_CASE("parts: lobes alone") {
  const auto told = [](std::vector<PartVerdict> verdicts) {
    return tell_parts(verdicts, {}, view());
  };
  CHECK(told({verdict("kd", true, false), verdict("ks", false, true),
              verdict("kt", false, true)}) ==
        "With kd alone it is wrong, with ks alone and kt alone it is right.");
  CHECK(told({verdict("kd", false, true), verdict("ks", false, true)}) ==
        "With kd alone and ks alone it is right.");
  CHECK(told({verdict("kd", false, true), verdict("ks", false, false)})
            .empty());
  CHECK(told({verdict("ks", true, false), verdict("kt", false, false)}) ==
        "With ks alone it is wrong.");
}

TEST_CASE("parts: a file is read again, and only for its scene") {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "parts.txt";
  const Part part = part_of(
      noise([](int x, int y) { return light(1, x, y); }, 64, 1), "bounces-1");
  std::ofstream(path) << "abc\n" << part_line(part) << '\n';
  const std::vector<Part> parts = load_parts(path, "abc");
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].name == "bounces-1");
  CHECK(parts[0].samples == 64);
  REQUIRE(parts[0].mean.size() == part.mean.size());
  CHECK(parts[0].mean[100] == doctest::Approx(part.mean[100]).epsilon(1e-3));
  CHECK(same_parts(part, parts[0], 8));
  CHECK(load_parts(path, "abd").empty());
  CHECK(load_parts(path + "none", "abc").empty());
}

TEST_CASE("a known mistake is named if its picture and its parts agree") {
  const RenderResult golden =
      noise([](int, int) { return Vec3(1); }, 1024, 1);
  const Mean half = [](int x, int) { return Vec3(x < 16 ? 1.0f : 0.5f); };
  const RenderResult test = noise(half, 256, 2);
  Signature same = signature_of(noise(half, 256, 3), "half");
  same.wrong_parts = "bounces-1,kd";
  Signature other = signature_of(golden, "other");
  const auto named = [&](const std::string& parts,
                         const std::vector<Signature>& known) {
    return known_mistakes(test, golden, parts, known);
  };
  using Names = std::vector<std::string>;  // compared, not printed
  CHECK(named("bounces-1,kd", {same, other}) == Names{"half"});
  CHECK(named("bounces-1", {same, other}) == Names{"half"});
  CHECK(named("bounces-2,kt", {same, other}).empty());
  Signature old = same;
  old.wrong_parts.clear();
  CHECK(named("bounces-1,kd", {old}).empty());
  CHECK(named("", {same, same, same}).empty());
  // Hardly wrong: agrees with much, and says little.
  const RenderResult hardly =
      noise([](int, int) { return Vec3(1.002f); }, 256, 4);
  CHECK(known_mistakes(hardly, golden, "", {signature_of(hardly, "x")})
            .empty());
}

TEST_CASE("signatures are read with their parts and without") {
  const tests::TemporaryFolder folder;
  const Signature plain = signature_of(
      noise([](int, int) { return Vec3(1); }, 4, 1), "warm-light");
  Signature parts = plain;
  parts.wrong_parts = "bounces-1,kd";
  std::ofstream(folder / "stage4_box.txt") << signature_line(plain) << '\n'
                                           << signature_line(parts) << '\n';
  const auto known = load_signatures(
      std::filesystem::path(folder / "x").parent_path().string(), 4, "box");
  REQUIRE(known.size() == 2);
  CHECK(known[0].mistake == "warm-light");
  CHECK(known[0].wrong_parts.empty());
  CHECK(known[1].wrong_parts == "bounces-1,kd");
  CHECK(known[0].mean.size() == plain.mean.size());
  CHECK(known[0].mean == known[1].mean);
}
