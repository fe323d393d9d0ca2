// A light may hang in a surface, lie on it or touch it. Then the surface does
// not block it: the floor below is as bright as without the surface, in every
// sample. A light just behind a surface does not shine through it at all.

#include <doctest/doctest.h>

#include "stages/2_next_event/path_tracer.hpp"
#include "support/renders.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

TEST_SUITE_BEGIN("analytic scenes");

namespace {

enum class Cover { none, plane, ball, rectangle, triangle };
enum class Lamp { point, rectangle, ball };

constexpr float lamp_radius = 0.2f;

/// A frame that is turned and moved: y points from the floor to the surface.
struct Place {
  Basis basis;
  Vec3 origin;

  Vec3 direction(const Vec3& v) const { return basis.to_world(v); }
  Vec3 position(const Vec3& v) const { return origin + direction(v); }
  Plane plane(const Vec3& at, const Vec3& normal,
              const Material* material) const {
    const Vec3 n = direction(normal);
    return {n, -dot(n, position(at)), material};
  }
};

/// A floor at y = -1, a black surface at y = 1 over it, and a light that is
/// `above` the surface: its center, or for a ball its point nearest to the
/// surface. A ball with `above` = 0 hangs below it and touches it.
Scene lit_floor(const Place& place, Cover cover, Lamp lamp, float above) {
  Scene scene;
  Material matte, black, shining;
  matte.kd = Vec3(0.5f);
  shining.ke = Vec3(3);
  const Material* white = scene.add(matte);
  const Material* dark = scene.add(black);
  const Material* bright = scene.add(shining);
  scene.add(place.plane({0, -1, 0}, {0, 1, 0}, white));

  const Vec3 right = place.direction({4, 0, 0});
  const Vec3 onward = place.direction({0, 0, 4});
  if (cover == Cover::plane) {
    scene.add(place.plane({0, 1, 0}, {0, -1, 0}, dark));
  } else if (cover == Cover::ball) {
    scene.add(Sphere{place.position({0, 4, 0}), 3, dark});
  } else if (cover == Cover::rectangle) {
    scene.add(
        Rectangle{place.position({-2.1f, 1, -1.7f}), right, onward, dark});
  } else if (cover == Cover::triangle) {
    scene.add(
        Triangle{place.position({-1.3f, 1, -1.1f}), right, onward, dark});
  }

  const Vec3 center = place.position({0, 1 + above, 0});
  if (lamp == Lamp::point) {
    scene.add(PointLight{center, Vec3(5)});
  } else if (lamp == Lamp::rectangle) {
    const Vec3 u = 0.1f * right, v = 0.1f * onward;
    scene.add(Rectangle{center - 0.5f * (u + v), u, v, bright});
  } else {
    const float side = above > 0 ? 1.0f : -1.0f;
    scene.add(Sphere{center + side * lamp_radius * place.direction({0, 1, 0}),
                     lamp_radius, bright});
  }
  scene.prepare();
  return scene;
}

template <class Test>
void for_each_place(Test test) {
  Random random(3, 0, 0);
  for (const float away : {0.0f, 1.0f, 100.0f}) {
    for (int i = 0; i < 8; ++i) {
      const auto direction = [&] {
        const Vec2 u(random.uniform_2d());
        const float z = 2 * u.x - 1, r = std::sqrt(1 - z * z);
        return Vec3(r * std::cos(two_pi * u.y), r * std::sin(two_pi * u.y),
                    z);
      };
      Place place{Basis(i == 0 ? Vec3(0, 0, 1) : direction()),
                  away * direction()};
      INFO("the scene is ", away, " from the origin");
      test(place);
    }
  }
}

/// The direct light of the lamps at the floor, sample by sample.
std::vector<float> floor_samples(const Scene& scene, const Place& place) {
  RenderSettings settings;
  settings.max_bounces = 1;
  const stage2::PathTracer tracer(scene, settings);
  std::vector<float> result;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Random random(11, 0, i);
    const Vec2 u = 6.0f * random.uniform_2d() - 3.0f;
    const Vec3 target = place.position({u.x, -1, u.y});
    const Vec3 origin = place.position({0.5f * u.x, 0, 0.5f * u.y});
    result.push_back(
        tracer.radiance({origin, normalize(target - origin)}, random).x);
  }
  return result;
}

constexpr Cover covers[] = {Cover::plane, Cover::ball, Cover::rectangle,
                            Cover::triangle};
const char* name(Lamp lamp) {
  return lamp == Lamp::point  ? "a point light"
         : lamp == Lamp::ball ? "a ball"
                              : "a rectangle";
}

const char* name(Cover cover) {
  return cover == Cover::plane       ? "a plane"
         : cover == Cover::ball      ? "a ball"
         : cover == Cover::rectangle ? "a rectangle"
         : cover == Cover::triangle  ? "a triangle"
                                     : "nothing";
}

constexpr Lamp lamps[] = {Lamp::point, Lamp::rectangle, Lamp::ball};

}  // namespace

TEST_CASE("a surface does not shade the light that lies in it") {
  for_each_place([](const Place& place) {
    for (const Lamp lamp : lamps) {
      const std::vector<float> alone =
          floor_samples(lit_floor(place, Cover::none, lamp, 0), place);
      for (const Cover cover : covers) {
        const std::vector<float> samples =
            floor_samples(lit_floor(place, cover, lamp, 0), place);
        std::size_t dark = 0;  // a point on a lamp's far side is, too
        int differ = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
          dark += alone[i] == 0;
          differ += samples[i] != alone[i];
        }
        INFO(std::string(name(lamp)), " in ", std::string(name(cover)), ": ",
             dark, " of 1000 samples are dark even without the surface, and ",
             differ, " are not the same with it, expected at most 750 and 0");
        CHECK(dark * 4 <= samples.size() * 3);
        CHECK(differ == 0);
      }
    }
  });
}

TEST_CASE("no light shines through the surface that it is just behind") {
  for_each_place([](const Place& place) {
    for (const Lamp lamp : lamps) {
      for (const Cover cover : covers) {
        // The ball is 0.02 higher where the rectangle's corners are.
        const bool bulges = cover == Cover::ball && lamp == Lamp::rectangle;
        const float behind =
            1e-5f * (10 + length(place.origin)) + (bulges ? 0.02f : 0);
        const std::vector<float> samples =
            floor_samples(lit_floor(place, cover, lamp, behind), place);
        int lit = 0;
        for (const float sample : samples) lit += sample != 0;
        INFO(std::string(name(lamp)), " ", behind, " behind ",
             std::string(name(cover)), " lights ", lit,
             " of 1000 samples, expected 0");
        CHECK(lit == 0);
      }
    }
  });
}

TEST_SUITE_END();
