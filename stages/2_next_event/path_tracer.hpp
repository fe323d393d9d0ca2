#pragma once

// # Stage 2: next-event estimation
//
// The paths of stage 1 grope about in the dark until they happen to hit a
// lamp. A point light is never hit at all: its picture is black. But where
// the lights are is no secret. So at each surface ask them directly: draw a
// line to the light, and if nothing is in the way, add what arrives along it.
// The rest of the light, what comes over other surfaces, is found as before.
//
// The integral over directions is split in two, light that comes straight
// from a lamp and light that does not, and each part gets the estimator that
// suits it. Every lamp must then be counted by one of the two, not by both.
//
// ![](next-event)

#include "stages/1_diffuse/path_tracer.hpp"

namespace lightwalk::stage2 {

using stage1::BsdfSample;
using stage1::emitted;
using stage1::evaluate;
using stage1::sample;

// ## What arrives from a light
//
// From each light one point is chosen. `direction` leads to it, and `weight`
// is what a surface square to that direction would receive from this light,
// in W/m^2, had it only this one sample to go by: the light's radiance over
// the density of the choice, per solid angle.
//
// A light is seen if it is the first thing that the shadow ray meets. The
// point is only known to rounding, so the ray is followed a little farther
// than the light is away. What it meets there may be the light itself.

// #region light-sample
struct LightSample {
  Vec3 direction;  ///< unit, from the surface to the light
  Vec3 weight;     ///< W/m^2 on a surface that faces the light
  float distance;  ///< how far nothing but the light may be met
};

/// More than rounding may change a distance by.
inline constexpr float distance_rounding = 0x1p-18f;
// #endregion light-sample

// ## A point light
//
// There is nothing to choose. A light of intensity $I$, in watts per
// steradian, gives $I/d^2$ at distance $d$: the same steradian covers four
// times the area at twice the distance. The slides call $I$ the light's power
// $p$ and use it in just this way, so there is no $4\pi$ in it.
//
// A point cannot be met. If it hangs in a ceiling, the ceiling must not be in
// its way, so here the shadow ray ends a little before the light.

// #region point-light
inline LightSample sample_light(const PointLight& light, const Vec3& x,
                                const Vec2&) {
  const Vec3 to_light = light.center - x;
  const float squared_distance = dot(to_light, to_light);
  const float distance = std::sqrt(squared_distance);
  const float size = distance + max_abs_component(light.center);
  return {to_light / distance, light.intensity / squared_distance,
          distance - distance_rounding / 2 * size};
}
// #endregion point-light

// ## A rectangle that shines
//
// Choose a point uniformly on its area $A$, so with density $1/A$ per area.
// The integral is over solid angle, and a piece of area $dA$ at distance $d$,
// tilted by $\theta'$ against the line of sight, covers
// $d\omega = \cos\theta'\,dA / d^2$. So the density per solid angle is
// $d^2 / (A \cos\theta')$, and the weight
//
// $$\frac{L_e}{p(\omega)} = L_e\,\frac{A \cos\theta'}{d^2}$$
//
// Forget $A$ and the scene's brightness depends on the units it was drawn in.
// Behind the rectangle $\cos\theta'$ is negative, and no light comes.
//
// ![](area-to-angle)

// #region rectangle-light
inline LightSample sample_light(const RectangleLight& light, const Vec3& x,
                                const Vec2& u) {
  const Vec3 point = light.corner + u.x * light.edge_u + u.y * light.edge_v;
  const Vec3 area_vector = cross(light.edge_u, light.edge_v);
  const float area = length(area_vector);
  const Vec3 normal = area_vector / area;
  const Vec3 to_light = point - x;
  const float squared_distance = dot(to_light, to_light);
  const float distance = std::sqrt(squared_distance);
  const Vec3 direction = to_light / distance;
  const float cos_light = std::max(0.0f, -dot(normal, direction));
  return {direction, light.radiance * (area * cos_light / squared_distance),
          distance * (1 + distance_rounding)};
}
// #endregion rectangle-light

// ![](lamp-mistakes)

// ## A sphere that shines
//
// Points on its area would do here too, but half of them are on the far side
// and bring nothing. From outside, a sphere of radius $r$ at distance $d$
// fills a cone of half-angle $\theta_{max}$, $\sin\theta_{max} = r/d$. Choose
// a direction uniformly in this cone: its solid angle is
//
// $$\Omega = 2\pi\,(1 - \cos\theta_{max})$$
//
// and so the density $1/\Omega$ and the weight $L_e \Omega$ (Shirley, Wang
// and Zimmerman, "Monte Carlo Techniques for Direct Lighting Calculations",
// ACM TOG 15(1), 1996). Every direction in the cone meets the lamp, so the
// only noise left is in the cosine at the surface and in the shadow's edge.
//
// Far away $\cos\theta_{max}$ is 1 to all digits, and $1 - \cos\theta_{max}$
// is 0. With $s = \sin^2\theta_{max}$ it is also
// $s / (1 + \sqrt{1 - s})$, which keeps its digits.
//
// The chosen direction, at an angle $\theta$ with the axis, meets the sphere
// first at distance $d\cos\theta - \sqrt{r^2 - d^2 \sin^2\theta}$. Inside the
// lamp there is no light: it shines outwards.

// #region sphere-light
inline LightSample sample_light(const SphereLight& light, const Vec3& x,
                                const Vec2& u) {
  const Vec3 to_center = light.center - x;
  const float squared_distance = dot(to_center, to_center);
  const float squared_radius = light.radius * light.radius;
  if (squared_distance <= squared_radius) return {{0, 0, 1}, Vec3(0), 0};
  const float distance = std::sqrt(squared_distance);
  const float sin2_max = squared_radius / squared_distance;
  const float one_minus_cos_max = sin2_max / (1 + std::sqrt(1 - sin2_max));

  const float one_minus_cos = u.x * one_minus_cos_max;
  const float cos_theta = 1 - one_minus_cos;
  const float sin2_theta = one_minus_cos * (1 + cos_theta);
  const float sin_theta = std::sqrt(sin2_theta);
  const float phi = two_pi * u.y;
  const Vec3 direction =
      Basis(to_center / distance)
          .to_world({sin_theta * cos(phi), sin_theta * sin(phi), cos_theta});

  const float half_chord = std::sqrt(
      std::max(0.0f, squared_radius - squared_distance * sin2_theta));
  return {direction, light.radiance * (two_pi * one_minus_cos_max),
          (distance * cos_theta - half_chord) * (1 + distance_rounding)};
}
// #endregion sphere-light

// ## Direct light
//
// One light's share is the term of the sum once more, $f_r \cos\theta$ times
// the weight, or nothing if something is in the way. A light below the
// horizon is not asked: with $|\cos\theta|$ instead, light would glow
// through thin walls. As on the slides, the lights are simply added up.

// #region direct-light
/// A point on any light, as seen from `x`. `u` is uniform in [0, 1)^2.
inline LightSample sample_light(const Light& light, const Vec3& x,
                                const Vec2& u) {
  return std::visit(
      [&](const auto& form) { return sample_light(form, x, u); }, light.form);
}

/// Radiance towards `wo` that the lights cause here by themselves.
inline Vec3 direct_light(const Scene& scene, const Surface& surface,
                         Random& random) {
  const Vec3 x = leave(surface.hit, surface.normal);
  Vec3 sum(0);
  for (const Light& light : scene.lights) {
    const LightSample to_light = sample_light(light, x, random.uniform_2d());
    const float cos_theta = dot(surface.normal, to_light.direction);
    if (cos_theta <= 0 || is_black(to_light.weight)) continue;

    // Is anything in the way?
    const Ray shadow_ray = spawn_ray(surface.hit, to_light.direction);
    if (!scene.reaches(shadow_ray, to_light.distance, light)) continue;
    sum += evaluate(surface.material) * cos_theta * to_light.weight;
  }
  return sum;
}
// #endregion direct-light

// ## Counted once
//
// The path still runs into lamps. Has their light been counted already? It
// has if direct light was added at the surface before, and this lamp is one
// of the scene's lights. It has not
//
// - if there was no surface before: the camera looks straight at the lamp;
// - if the lamp is one that cannot be asked: a plane has no end, so no point
//   on it can be chosen uniformly, and triangles are not asked either.
//
// Count it in both places and every lamp is twice as bright in the walls as
// in itself. Count it in neither and the lamps are black holes in the
// picture.

// #region counted-once
/// Whether `direct_light`, added at the surface before, has this emission in
/// it already.
inline bool is_counted(const Surface& surface, bool direct_light_added) {
  return direct_light_added && surface.hit.light != nullptr;
}
// #endregion counted-once

// ## The path
//
// The loop is stage 1's, with a sum beside the throughput. Direct light is a
// bounce too, of a path whose last direction was joined to a light instead of
// being drawn. So it stands behind the test of `max_bounces`, and equal
// bounds give equal pictures in both stages, but for the noise.

// #region path
class PathTracer {
 public:
  PathTracer(const Scene& scene, const RenderSettings& settings)
      : scene_(scene),
        max_bounces_(settings.max_bounces),
        sampling_(settings.sampling) {}

  /// Radiance that comes back along the ray, as one path sees it.
  Vec3 radiance(Ray ray, Random& random) const {
    Vec3 sum(0);
    Vec3 throughput(1);
    bool direct_light_added = false;
    for (int bounce = 0;; ++bounce) {
      // Find the next surface.
      const std::optional<Hit> hit = scene_.nearest_hit(ray);
      if (!hit) return sum;
      const Surface surface(*hit, *hit->material, -ray.direction);
      log_vertex(surface, throughput, sum, bounce);

      // An emitter ends the path, and counts if it has not been counted.
      if (surface.material.emits()) {
        if (!is_counted(surface, direct_light_added)) {
          sum += throughput * emitted(surface);
        }
        return sum;
      }
      if (bounce == max_bounces_) return sum;

      // Ask the lights.
      sum += throughput * direct_light(scene_, surface, random);
      direct_light_added = true;

      // Go on in a random direction.
      const Vec2 u = random.uniform_2d();
      const BsdfSample next = sample(surface, sampling_, u);
      throughput *= next.weight;
      ray = spawn_ray(*hit, next.wi);
    }
  }

 private:
  const Scene& scene_;
  int max_bounces_;
  Sampling sampling_;
};
// #endregion path

// ![](stage-1-or-2)

// ![](direct-and-all)

}  // namespace lightwalk::stage2
