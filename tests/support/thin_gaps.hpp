#pragma once

// Glass and mirrors with thin gaps between them, in a white room: however thin
// a pane is, and wherever it stands, it is invisible. A ray that starts a step
// off its surface jumps over what is thinner than the step.

#include <doctest/doctest.h>

#include "support/expectations.hpp"
#include "support/printing.hpp"
#include "support/renders.hpp"

namespace lightwalk::tests {

/// A room of ten times `size` around `center`, that shines with radiance 1,
/// and things in it that are about as large as `size`.
struct ThinGaps {
  float size;
  Vec3 center;
  Scene scene{};
  const Material *sky, *glass, *dense, *mirror;

  ThinGaps(float size_, const Vec3& center_) : size(size_), center(center_) {
    Material shining, clear, flint, silver;
    shining.ke = Vec3(1);
    clear.kt = flint.kt = silver.ks = Vec3(1);
    clear.eta = 1.3f;
    flint.eta = 1.5f;
    sky = scene.add(shining);
    glass = scene.add(clear);
    dense = scene.add(flint);
    mirror = scene.add(silver);
    for (int axis = 0; axis < 3; ++axis) {
      for (const float side : {-1.0f, 1.0f}) {
        Vec3 normal(0);
        normal[axis] = -side;
        scene.add(Plane{normal, 5 * size - dot(normal, center), sky});
      }
    }
  }

  /// A box from one corner to the other, in units of `size`.
  void add_box(const Vec3& low, const Vec3& high, const Material* material) {
    for (int axis = 0; axis < 3; ++axis) {
      const int next = (axis + 1) % 3, last = (axis + 2) % 3;
      Vec3 u(0), v(0);
      u[next] = size * (high - low)[next];
      v[last] = size * (high - low)[last];
      const Vec3 corner = center + size * low;
      Vec3 opposite = corner;
      opposite[axis] = center[axis] + size * high[axis];
      scene.add(Rectangle{corner, v, u, material});
      scene.add(Rectangle{opposite, u, v, material});
    }
  }

  void add_ball(const Vec3& middle, float radius, const Material* material) {
    scene.add(Sphere{center + size * middle, size * radius, material});
  }
};

/// Sends rays at the things, from a window in front of them. Describes the
/// first ray that sees something, that is, does not bring 1; empty if none
/// does. A ray with another radiance in one sample gets many samples: a right
/// program may end some paths by roulette, and let the others count for more.
template <class PathTracer>
std::string rays_that_see_something(const ThinGaps& things, int rays) {
  RenderSettings settings;
  settings.max_bounces = 64;
  const PathTracer tracer(things.scene, settings);
  int again = 0;
  for (int i = 0; i < rays; ++i) {
    Random random(5, 0, static_cast<std::uint64_t>(i));
    const Vec2 a = random.uniform_2d(), b = random.uniform_2d();
    const Vec3 from(0.4f * a.x - 0.2f, 0.4f * a.y - 0.2f, -2);
    const Vec3 to(0.9f * b.x - 0.45f, 0.9f * b.y - 0.45f, 0);
    const Ray ray{things.center + things.size * from, normalize(to - from)};
    const float radiance = tracer.radiance(ray, random).x;
    if (std::abs(radiance - 1) <= 1e-5f) continue;
    const Pixel pixel = estimate(tracer, ray, 2000);
    const double sigma = std::sqrt(pixel.variance(0) / pixel.samples);
    if (pixel.dropped > 0 ||
        !(std::abs(pixel.mean[0] - 1) <= max_deviations * sigma + 1e-5)) {
      return "mean " + text_of(pixel.mean[0]) + " +- " + text_of(sigma) +
             ", expected 1: " + factor_in_words(pixel.mean[0], sigma) +
             ", from " + text_of(ray.origin) + " along " +
             text_of(ray.direction);
    }
    if (++again == 20) break;  // noisy, but right for all rays so far
  }
  return "";
}

template <class PathTracer>
void check_thin_gaps() {
  for (const float size : {1e-3f, 1.0f, 1e3f}) {
    for (const float away : {0.0f, 200.0f}) {
      const Vec3 center = away * size * Vec3(0.6f, -0.64f, 0.48f);
      // 1e-4 of 1 m is six units in the last place at 200 m.
      for (const float gap : {1e-2f, 1e-3f, 1e-4f, 1e-5f, 1e-6f}) {
        if (away > 0 && gap < 1e-4f) continue;
        const auto check = [&](const char* what, auto add) {
          ThinGaps things(size, center);
          add(things);
          things.scene.prepare();
          const std::string wrong =
              rays_that_see_something<PathTracer>(things, 1000);
          if (wrong.empty()) return;
          FAIL_CHECK(std::string(what)
                     << " in a white room (size " << size << ", gap "
                     << gap * size << ", " << length(center)
                     << " from the origin): " << wrong);
        };
        const Vec3 low(-0.5f, -0.5f, 0), high(0.5f, 0.5f, 0.4f);
        check("pane", [&](ThinGaps& t) {
          t.add_box(low, {0.5f, 0.5f, gap}, t.dense);
        });
        check("two slabs", [&](ThinGaps& t) {
          t.add_box({-0.5f, -0.5f, -0.4f}, {0.5f, 0.5f, 0}, t.dense);
          t.add_box({-0.5f, -0.5f, gap}, high, t.glass);
        });
        check("mirror behind glass", [&](ThinGaps& t) {
          t.add_box({-0.5f, -0.5f, -0.4f}, {0.5f, 0.5f, 0}, t.dense);
          t.add_box({-0.5f, -0.5f, gap}, high, t.mirror);
        });
        check("cube in a cube", [&](ThinGaps& t) {
          t.add_box(Vec3(-0.5f), Vec3(0.5f), t.glass);
          t.add_box(Vec3(gap - 0.5f), Vec3(0.5f - gap), t.dense);
        });
        check("ball in a ball", [&](ThinGaps& t) {
          t.add_ball({0, 0, 0}, 0.5f, t.glass);
          t.add_ball({0, 0, 0}, 0.5f - gap, t.dense);
        });
        check("mirror in a ball", [&](ThinGaps& t) {
          t.add_ball({0, 0, 0}, 0.5f, t.glass);
          t.add_ball({0, 0, 0}, 0.5f - gap, t.mirror);
        });
        check("ball over a mirror", [&](ThinGaps& t) {
          t.add_ball({0, 0, 0}, 0.4f, t.glass);
          t.add_box({-0.5f, -0.7f, -0.5f}, {0.5f, -0.4f - gap, 0.5f},
                    t.mirror);
        });
        check("two balls", [&](ThinGaps& t) {
          t.add_ball({-0.25f, 0, 0}, 0.25f, t.glass);
          t.add_ball({0.25f + gap, 0, 0}, 0.25f, t.dense);
        });
      }
    }
  }
}

}  // namespace lightwalk::tests
