// The shadow ray to a point light ends a little before it: by more than
// rounding, also where the light is at the origin, and by little enough to
// hit what stands before the light.

#include <doctest/doctest.h>

#include "stages/2_next_event/path_tracer.hpp"
#include "support/renders.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

Vec3 any_direction(Random& random) {
  const Vec2 u(random.uniform_2d());
  const float z = 2 * u.x - 1, r = std::sqrt(1 - z * z);
  return {r * std::cos(two_pi * u.y), r * std::sin(two_pi * u.y), z};
}

/// A white floor through `below` that faces `up`, and a light at `center`
/// with a black plane through `wall`.
struct Lit {
  Scene scene;
  Vec3 up, below;

  Lit(const Vec3& up_, const Vec3& below_, const Vec3& center,
      const Vec3& wall)
      : up(up_), below(below_) {
    Material white, black;
    white.kd = Vec3(0.5f);
    const Material* const floor = scene.add(white);
    const Material* const dark = scene.add(black);
    scene.add(Plane{up, -dot(up, below), floor});
    scene.add(Plane{-up, dot(up, wall), dark});
    scene.add(PointLight{center, Vec3(1)});
    scene.prepare();
  }

  /// Of 1000 places on the floor around `below`, how many get light.
  int places_with_light() const {
    RenderSettings settings;
    settings.max_bounces = 1;
    const stage2::PathTracer tracer(scene, settings);
    const Basis basis(up);
    int count = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
      Random random(5, 0, i);
      const Vec2 u = 4.0f * random.uniform_2d() - 2.0f;
      const Vec3 from = below + basis.to_world({u.x, u.y, 0.5f});
      count += tracer.radiance({from, -up}, random).x > 0;
    }
    return count;
  }
};

}  // namespace

TEST_SUITE_BEGIN("units");

TEST_CASE("a point light at the origin, in a wall, lights what faces it") {
  Random random(7, 0, 0);
  for (int i = 0; i < 20; ++i) {
    const Vec3 up = any_direction(random);
    const Lit lit(up, -2.0f * up, Vec3(0), Vec3(0));
    const int count = lit.places_with_light();
    CHECK_MESSAGE(count == 1000, (1000 - count),
                  " of 1000 places on the floor are dark: the wall that the "
                  "light hangs in blocks it");
  }
}

TEST_CASE("a wall one unit before a distant point light blocks its light") {
  Random random(9, 0, 0);
  for (int i = 0; i < 20; ++i) {
    const Vec3 up = any_direction(random);
    const Lit lit(up, Vec3(0), 1000.0f * up, 999.0f * up);
    const int count = lit.places_with_light();
    CHECK_MESSAGE(count == 0, count,
                  " of 1000 places on the floor get light through the wall");
  }
}

TEST_SUITE_END();
