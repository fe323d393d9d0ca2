// Points on lamps: where they lie, how often, and the weight of each.

#include <doctest/doctest.h>

#include "stages/2_next_event/path_tracer.hpp"
#include "support/chi_squared.hpp"
#include "support/expectations.hpp"
#include "support/renders.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
using stage2::LightSample;
using stage2::sample_light;

TEST_SUITE_BEGIN("units");

namespace {

constexpr int samples = 100'000;

/// Counts points of the unit square; one outside fails the test.
class Square {
 public:
  void add(double s, double t) {
    const bool inside = s > -1e-3 && s < 1.001 && t > -1e-3 && t < 1.001;
    const int row = std::clamp(static_cast<int>(s * size), 0, size - 1);
    const int column = std::clamp(static_cast<int>(t * size), 0, size - 1);
    const int cell = inside ? row * size + column : size * size;
    observed_[static_cast<std::size_t>(cell)] += 1;
  }
  double p_value() const {
    std::vector<double> expected(observed_.size(),
                                 double(samples) / (size * size));
    expected.back() = 0;
    return chi_squared_test(observed_, expected).p_value;
  }
  /// The emptiest and the fullest of the cells, and what is outside.
  std::string in_words() const {
    const auto [fewest, most] =
        std::minmax_element(observed_.begin(), observed_.end() - 1);
    return "points in a cell of 12 x 12 on the lamp: " + text_of(*fewest) +
           " to " + text_of(*most) + ", expected about " +
           text_of(std::round(double(samples) / (size * size))) +
           "; outside the lamp " + text_of(observed_.back()) + ", expected 0";
  }

 private:
  static constexpr int size = 12;
  std::vector<double> observed_ = std::vector<double>(size * size + 1);
};

/// Adds up weights over the unit square, for samplers that choose some points
/// more often and give those less weight.
class WeighedSquare {
 public:
  void add(double s, double t, double weight) {
    if (weight == 0) return;  // on the far side, say
    const bool inside = s > -1e-3 && s < 1.001 && t > -1e-3 && t < 1.001;
    outside_ += !inside;
    const int row = std::clamp(static_cast<int>(s * size), 0, size - 1);
    const int column = std::clamp(static_cast<int>(t * size), 0, size - 1);
    const auto cell = static_cast<std::size_t>(row * size + column);
    sums_[cell] += weight;
    squares_[cell] += weight * weight;
    row_ += weight * s;
    column_ += weight * t;
    total_ += weight;
  }
  int outside() const { return outside_; }
  double mean_row() const { return row_ / total_; }
  double mean_column() const { return column_ / total_; }
  /// The probability of sums at least as uneven as these, where `mean` is the
  /// mean weight that a sample should have. 0 if any was outside.
  double p_value(double mean) const {
    const double expected = mean * samples / (size * size);
    double statistic = 0;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      const double variance = squares_[i] - sums_[i] * sums_[i] / samples;
      if (!(variance > 0)) return 0;
      statistic += (sums_[i] - expected) * (sums_[i] - expected) / variance;
    }
    return outside_ ? 0 : chi_squared_p_value(statistic, size * size);
  }

 private:
  static constexpr int size = 12;
  int outside_ = 0;
  double row_ = 0, column_ = 0, total_ = 0;
  std::vector<double> sums_ = std::vector<double>(size * size);
  std::vector<double> squares_ = std::vector<double>(size * size);
};

const Vec3 three_colors{4, 1, 2};
const RectangleLight slanted{
    {1, 2, 3}, {2, 0, 1}, {0.5f, 1, 0}, three_colors};

}  // namespace

// point = corner + s edge_u + t edge_v; s and t come back by the two vectors
// that are perpendicular to the other edge and to the normal.
TEST_CASE("points on a rectangle are chosen evenly") {
  const Vec3 x(-4, 5, 12);  // in front of the lamp
  const Vec3 normal = cross(slanted.edge_u, slanted.edge_v);
  const Vec3 a = cross(slanted.edge_v, normal);
  const Vec3 b = cross(normal, slanted.edge_u);
  Random random(5, 0, 0);
  Square square;
  for (int i = 0; i < samples; ++i) {
    const LightSample one = sample_light(slanted, x, random.uniform_2d());
    const Vec3 from_corner =
        x + one.distance * one.direction - slanted.corner;
    square.add(
        static_cast<double>(dot(a, from_corner) / dot(a, slanted.edge_u)),
        static_cast<double>(dot(b, from_corner) / dot(b, slanted.edge_v)));
  }
  if (square.p_value() < significance) FAIL_CHECK(square.in_words());
}

TEST_CASE("the direction to a lamp's point has unit length and leads there") {
  const SphereLight ball{{3, 4, 0}, 2, Vec3(1)};
  const PointLight point{{3, 4, 0}, Vec3(1)};
  const Vec3 x(0.5f, -1, 6);
  Random random(5, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 u(random.uniform_2d());
    for (const LightSample& one :
         {sample_light(slanted, x, u), sample_light(ball, x, u),
          sample_light(point, x, u)}) {
      require_value("length of a direction to a light",
                    static_cast<double>(length(one.direction)), 1, 1e-5);
      INFO("the distance of a light is ", one.distance,
           ", expected more than 1");
      REQUIRE(one.distance > 1);
    }
  }
}

TEST_CASE(
    "the direction leads to a point light, and the distance ends before it") {
  const Vec3 x(0.5f, -1, 2);
  for (const Vec3& center : {Vec3(3, 4, 0), Vec3(0.5f, -0.9f, 2),
                             Vec3(0, 0, -300), Vec3(1000, 2000, 2)}) {
    const LightSample one =
        sample_light(PointLight{center, Vec3(1)}, x, Vec2(0.5f));
    const float distance = length(center - x);
    const Vec3 expected = (center - x) / distance;
    const std::string light =
        "a light at " + text_of(center) + ", seen from " + text_of(x) + ": ";
    if (!(length(one.direction - expected) < 1e-5f)) {
      FAIL_CHECK(light << "the direction is " << one.direction
                       << ", expected " << expected);
    }
    // Rounding is in proportion to the coordinates, and so is the margin.
    const float size = distance + max_abs_component(center);
    const float gap = distance - one.distance;
    if (!(gap > 1e-7f * size && gap < 1e-5f * size)) {
      FAIL_CHECK(light << "the distance is " << gap
                       << " less than d = " << distance << ", expected about "
                       << stage2::distance_rounding / 2 * size);
    }
  }
}

/// The solid angle of a triangle seen from x (Van Oosterom and Strackee 1983).
double solid_angle(const Vec3& x, const Vec3& p, const Vec3& q,
                   const Vec3& r) {
  const DoubleVec3 a = normalize(DoubleVec3(p) - DoubleVec3(x));
  const DoubleVec3 b = normalize(DoubleVec3(q) - DoubleVec3(x));
  const DoubleVec3 c = normalize(DoubleVec3(r) - DoubleVec3(x));
  const double volume = std::abs(dot(a, cross(b, c)));
  return 2 * std::atan2(volume, 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

/// The weights of a lamp's samples at x.
template <class Lamp>
Pixel weights_at(const Lamp& lamp, const Vec3& x) {
  Random random(9, 0, 0);
  Pixel weights;
  for (int i = 0; i < samples; ++i) {
    weights.add(sample_light(lamp, x, random.uniform_2d()).weight);
  }
  return weights;
}

/// Each channel has its own L_e.
void check_mean_weight(const std::string& what, const Pixel& weights,
                       double solid_angle_seen, double rounding = 1e-6) {
  for (int c = 0; c < 3; ++c) {
    const auto radiance = static_cast<double>(three_colors[c]);
    check_mean(what + ", L_e = " + text_of(radiance) + " in channel " +
                   std::to_string(c),
               weights, c, radiance * solid_angle_seen, rounding);
  }
}

// The mean of L_e / p is L_e times the solid angle, however points are
// chosen. All lengths times a hundredth give the same solid angle.
TEST_CASE("a rectangle's mean weight is L_e times its solid angle") {
  const Vec3& a = slanted.corner;
  const Vec3 b = a + slanted.edge_u, c = b + slanted.edge_v,
             d = a + slanted.edge_v;
  const Vec3 normal = normalize(cross(slanted.edge_u, slanted.edge_v));
  for (const Vec3& off : {Vec3(0.2f, 0, 0), Vec3(3, -2, 1), Vec3(-8, 1, 5)}) {
    Vec3 x = a + off;
    if (dot(x - a, normal) < 0) x -= 2 * dot(x - a, normal) * normal;
    x += 0.5f * normal;
    INFO("seen from ", x);
    const double seen = solid_angle(x, a, b, c) + solid_angle(x, a, c, d);
    check_mean_weight("the mean of L_e A cos'/d^2", weights_at(slanted, x),
                      seen);
    const float size = 0.01f;
    const RectangleLight small{size * a, size * slanted.edge_u,
                               size * slanted.edge_v, three_colors};
    check_mean_weight("the mean of L_e A cos'/d^2, the lamp being " +
                          text_of(double(size * length(off))) +
                          " long and away",
                      weights_at(small, size * x), seen, 1e-4);
    const Vec3 behind = x - 2 * dot(x - a, normal) * normal;
    const Pixel back = weights_at(slanted, behind);
    INFO("behind the lamp, where it is black, the mean weight is ",
         back.mean[0], ", expected 0");
    CHECK(back.mean[0] == 0);
    CHECK(back.variance(0) == 0);
  }
}

// 2 pi (1 - cos) of the cone with the sine r/d: for small r/d, pi (r/d)^2.
TEST_CASE("a sphere's mean weight is L_e times its solid angle") {
  for (const float distance : {1.1f, 2.0f, 30.0f, 3000.0f, 1e5f}) {
    const SphereLight ball{{0, distance, 0}, 1, three_colors};
    const double s = 1 / (static_cast<double>(distance) * distance);
    INFO("a ball of radius 1 at the distance ", distance, ": (r/d)^2 is ", s);
    check_mean_weight(
        "L_e times the cone's solid angle", weights_at(ball, Vec3(0)),
        2 * std::numbers::pi * s / (1 + std::sqrt(1 - s)), 1e-5);
  }
}

// I/d^2, and no 4 pi: the lab calls the intensity the light's power.
TEST_CASE("a point light gives I/d^2 to what faces it, near or far") {
  const Vec3 x(1, 2, 2);  // 3 from the origin, and 6 from (5, 6, 4)
  const Vec3 power(9, 18, 36);
  const Vec2 u(0.3f, 0.6f);
  check_color("I/d^2 at d = 3",
              sample_light(PointLight{Vec3(0), power}, x, u).weight,
              power / 9.0f);
  check_color("I/d^2 at d = 6",
              sample_light(PointLight{{5, 6, 4}, power}, x, u).weight,
              power / 36.0f);
  // 3/64 away, where I/d^2 is more than I.
  check_color(
      "I/d^2 at d = 3/64",
      sample_light(PointLight{x + Vec3(1, 2, 2) / 64.0f, power}, x, u).weight,
      power * (64 * 64 / 9.0f));
}

// Far away all points have the same distance and angle, and A = |u x v| = 6.
TEST_CASE("a slanted lamp has the area of its parallelogram") {
  const RectangleLight lamp{{0, 1000, 0}, {2, 0, 0}, {1, 0, 3}, Vec3(4)};
  const LightSample one = sample_light(lamp, Vec3(0), Vec2(0.3f, 0.6f));
  check_value("ke A cos'/d^2 with A = |u x v| = 6 at d = 1000",
              red(one.weight), 4 * 6 / 1e6);
}

// Equal solid angles about the axis are equal steps of 1 - cos(theta), up to
// that of the cone, and equal steps of the azimuth. They have equal shares of
// the weight, whose mean is ke times the cone's solid angle. Points may be
// chosen in other ways, too, with other weights.
TEST_CASE("directions to a sphere fill its cone evenly") {
  for (const SphereLight& lamp : {SphereLight{{0, 2, 0}, 1, Vec3(3)},
                                  SphereLight{{3, 4, 0}, 2, Vec3(3)},
                                  SphereLight{{-1, 0, -9}, 0.5f, Vec3(3)}}) {
    const Vec3 axis = normalize(lamp.center);
    const Vec3 x = normalize(cross(axis, Vec3(0.1f, 0.2f, 1)));
    const Vec3 y = cross(axis, x);
    const double ratio = static_cast<double>(lamp.radius) /
                         static_cast<double>(length(lamp.center));
    const double cone = 1 - std::sqrt(1 - ratio * ratio);
    const double mean = 3 * 2 * std::acos(-1.0) * cone;
    Random random(5, 0, 0);
    WeighedSquare square;
    Pixel weights;
    for (int i = 0; i < samples; ++i) {
      const LightSample one =
          sample_light(lamp, Vec3(0), random.uniform_2d());
      weights.add(one.weight);
      // |d - axis|^2 = 2 (1 - cos), without cancellation.
      const Vec3 aside = one.direction - axis;
      const double turn = static_cast<double>(
          std::atan2(dot(aside, y), dot(aside, x)) / two_pi + 0.5f);
      square.add(static_cast<double>(dot(aside, aside)) / 2 / cone, turn,
                 static_cast<double>(one.weight.x));
    }
    const std::string ball = " of a ball of radius " +
                             text_of(static_cast<double>(lamp.radius)) +
                             " at " + text_of(lamp.center);
    check_mean("the weight ke 2 pi (1 - cos theta_max)" + ball, weights, 0,
               mean, 1e-4);
    if (square.p_value(mean) >= significance) continue;
    FAIL_CHECK("directions do not fill the cone"
               << ball << " evenly: of " << samples << ", "
               << square.outside()
               << " are outside of it; the mean of (1 - cos theta) / "
                  "(1 - cos theta_max) is "
               << square.mean_row() << ", expected 0.5, and of phi / (2 pi) "
               << square.mean_column() << ", expected 0.5");
  }
}

TEST_CASE("within a sphere that shines outwards no light comes from it") {
  const SphereLight light{Vec3(1, 2, 3), 2, Vec3(5)};
  for (const Vec3 x : {Vec3(1, 2, 3), Vec3(1.5f, 1, 4), Vec3(1, 3.99f, 3)}) {
    check_color("the weight for a surface within the lamp",
                sample_light(light, x, Vec2(0.3f, 0.6f)).weight, Vec3(0));
  }
}

// The tangents from x touch the sphere at distance sqrt(d^2 - r^2): what is
// nearer is on the near side.
TEST_CASE("a shadow ray ends on the near side of the sphere") {
  const SphereLight lamp{{3, 4, 0}, 2, Vec3(1)};
  Random random(5, 0, 0);
  for (int i = 0; i < 1000; ++i) {
    const LightSample one = sample_light(lamp, Vec3(0), random.uniform_2d());
    if (is_black(one.weight)) continue;  // chosen there, and not counted
    require_value(
        "from the ball's center to the end of the shadow ray, the radius",
        static_cast<double>(
            length(one.distance * one.direction - lamp.center)),
        2, 1e-3);
    INFO("the shadow ray ends at ", one.distance,
         ", on the far side; the near side is at most 4.583 away");
    REQUIRE(one.distance < std::sqrt(25.0f - 4.0f) + 1e-3f);
  }
}

// At the rim of the cone half the chord is the root of nearly 0, which rounding
// makes negative in some places.
TEST_CASE("a shadow ray ends on the near side at the sphere's very rim") {
  constexpr float largest = 1 - 0x1p-24f;
  Random random(5, 0, 0);
  for (int i = 0; i < 100'000; ++i) {
    const Vec2 u(random.uniform_2d()), v(random.uniform_2d());
    const SphereLight lamp{{3 + u.x, 4 * u.y, v.x}, 2, Vec3(1)};
    const LightSample one = sample_light(lamp, Vec3(0), Vec2(largest, v.y));
    INFO("the distance is ", one.distance, " and the weight ", one.weight,
         " for u.x just below 1 and a ball of radius 2 at ", lamp.center);
    REQUIRE(is_finite(one.weight));
    REQUIRE(is_finite(Vec3(one.distance)));
  }
}

// Nothing else is in the scene, so every point of the lamp that faces x is
// seen from x, wherever the lamp is.
TEST_CASE("no lamp shades itself") {
  Scene scene;
  Material shining;
  shining.ke = Vec3(1);
  const Material* lamp = scene.add(shining);
  scene.add(Rectangle({300, 200, -100}, {2, 0, 1}, {0.5f, 1, 0}, lamp));
  scene.add(Sphere{{-70, 40, 90}, 3, lamp});
  scene.prepare();
  Random random(5, 0, 0);
  int facing = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec2 a = random.uniform_2d(), u = random.uniform_2d();
    const Vec3 x(100 * a.x - 50, 100 * a.y - 50, 100 * random.uniform());
    for (const auto& light : scene.lights) {
      const LightSample one = sample_light(light, x, u);
      if (is_black(one.weight)) continue;
      ++facing;
      INFO("from ", x, " to ", x + one.distance * one.direction,
           ": the shadow ray to an unobstructed lamp is blocked");
      REQUIRE(scene.reaches({x, one.direction}, one.distance, light));
    }
  }
  INFO(facing, " of 40000 samples have a weight, expected half at least");
  CHECK(facing >= 20'000);
}

TEST_SUITE_END();
