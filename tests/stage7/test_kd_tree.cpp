// The k-d tree finds what a look at every point finds.

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "stages/7_photon_mapping/path_tracer.hpp"
#include "support/expectations.hpp"
#include "support/renders.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

struct Point {
  Vec3 position;
  int number;
};

/// Points in a cube, on a plane, or all in one place.
std::vector<Point> points(int count, const Vec3& size, std::uint64_t seed) {
  std::vector<Point> result;
  Random random(seed, 0, 0);
  for (int i = 0; i < count; ++i) {
    const Vec2 u = random.uniform_2d();
    result.push_back({size * Vec3(u.x, u.y, random.uniform()), i});
  }
  return result;
}

float squared_distance(const Point& point, const Vec3& x) {
  const Vec3 away = point.position - x;
  return dot(away, away);
}

const auto every_point = [](const Point&) { return true; };

}  // namespace

TEST_SUITE_BEGIN("units");

TEST_CASE("the tree visits just the points within a radius, each once") {
  for (const Vec3& size : {Vec3(1), Vec3(1, 0, 1), Vec3(0)}) {
    for (const int count : {0, 1, 7, 8, 9, 17, 1000}) {
      const std::vector<Point> all = points(count, size, 1);
      const KdTree<Point> tree(all);
      REQUIRE(tree.points().size() == all.size());
      for (int i = 0; i < 50; ++i) {
        Random random(2, 0, static_cast<std::uint64_t>(i));
        const Vec2 u = random.uniform_2d();
        const Vec3 x = size * Vec3(u.x, u.y, random.uniform());
        const float limit = 0.1f * random.uniform();
        std::vector<int> expected, found;
        for (const Point& p : all) {
          if (squared_distance(p, x) < limit) expected.push_back(p.number);
        }
        tree.walk(x, limit, [&](const Point& p, float d2) {
          found.push_back(p.number);
          if (d2 != squared_distance(p, x)) FAIL_CHECK("wrong distance");
          return limit;
        });
        std::sort(found.begin(), found.end());
        REQUIRE(found == expected);
      }
    }
  }
}

TEST_CASE("the distance to the k-th nearest is that of a sorted list") {
  const std::vector<Point> all = points(1000, Vec3(1), 3);
  const KdTree<Point> tree(all);
  const auto is_even = [](const Point& p) { return p.number % 2 == 0; };
  for (int i = 0; i < 50; ++i) {
    Random random(4, 0, static_cast<std::uint64_t>(i));
    const Vec2 u = random.uniform_2d();
    const Vec3 x(u.x, u.y, random.uniform());
    std::vector<float> sorted, of_even;
    for (const Point& p : all) {
      sorted.push_back(squared_distance(p, x));
      if (is_even(p)) of_even.push_back(squared_distance(p, x));
    }
    std::sort(sorted.begin(), sorted.end());
    std::sort(of_even.begin(), of_even.end());
    for (const std::size_t k : {1u, 2u, 10u, 100u, 500u}) {
      CAPTURE(k);
      CHECK(tree.squared_distance_to(k, x, infinity, every_point) ==
            sorted[k - 1]);
      CHECK(tree.squared_distance_to(k, x, infinity, is_even) ==
            of_even[k - 1]);
    }
    // Where there are too few: the limit, or the farthest of all.
    CHECK(tree.squared_distance_to(900, x, 0.01f, every_point) == 0.01f);
    CHECK(tree.squared_distance_to(2000, x, infinity, every_point) ==
          sorted.back());
  }
  const KdTree<Point> empty;
  CHECK(empty.squared_distance_to(5, Vec3(0), infinity, every_point) == 0);
}

TEST_SUITE_END();
