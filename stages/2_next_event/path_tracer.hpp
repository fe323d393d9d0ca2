#pragma once

// # Stage 2: next-event estimation
//
// The paths of stage 1 find a lamp only by chance. A small lamp is found
// rarely, and a *point light* is never found: it has no size, and its picture
// is black. But where the lights are is no secret. So at each surface, ask
// them directly. Draw a line to the light, and if nothing is in the way, add
// what arrives along it. This is *next-event estimation*, and the line is a
// *shadow ray*.
//
// ![](stage-1-or-2)
//
// ## The integral in two parts
//
// Look from $x$ along $\omega_i$ at the next surface $y$. What arrives from
// there is what $y$ emits, plus what $y$ scatters:
//
// $$L_i(x, \omega_i) = L_e(y, -\omega_i) + L_s(y, -\omega_i)$$
//
// So the integral of the rendering equation is a sum of two integrals:
//
// $$\int_\Omega L_i\,f_r \cos\theta\,d\omega
// = \underbrace{\int_\Omega L_e\,f_r \cos\theta\,d\omega}_{\text{direct}}
// + \underbrace{\int_\Omega L_s\,f_r \cos\theta\,d\omega}_{\text{indirect}}$$
//
// Each part gets an estimator of its own. For direct light $L_e$ is 0 except
// towards the lights, so choose directions to the lights only. For indirect
// light go on as in stage 1. Then one thing must be watched: a path that
// happens to hit a lamp must not count its light a second time.
//
// ![](split)
//
#include "stages/1_diffuse/path_tracer.hpp"

namespace lightwalk::stage2 {

using stage1::BsdfSample;
using stage1::emitted;
using stage1::evaluate;
using stage1::sample;

// ## What a light sample holds
//
// To ask a light, choose a direction to it with some density $p(\omega)$. The
// estimate of the direct light is, as always, the integrand over the density:
//
// $$\frac{L_e\,f_r \cos\theta}{p(\omega)} = f_r \cos\theta \cdot
// \frac{L_e}{p(\omega)}$$
//
// The first two factors belong to the surface. The last one belongs to the
// light, and is the `weight` of its sample. Its unit is W/m^2. A
// `LightSample` is this weight with the `direction` and the distance.
//
// A computed distance is only right up to rounding. So the shadow ray is
// followed a little farther than the light is away, by the factor `1 +
// distance_rounding`. What it meets there may be the light itself, but
// nothing else.

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
// Take a small lamp of area $A$ that faces $x$ from the distance $d$. The
// next section shows that it brings $L_e A/d^2$. Now let it shrink, and make
// it brighter, so that $I = L_e A$ stays the same. In the limit it is a point
// with the *intensity* $I$, in watts per steradian:
//
// $$\frac{L_e A}{d^2} \to \frac{I}{d^2}$$
//
// At twice the distance the same steradian covers four times the area. There
// is nothing to choose and no density. The slides call $I$ the light's power
// $p$ and use it in just this way, so no $4\pi$ appears.
//
// ![](shrinking-lamp)
//
// A point cannot be hit. If it hangs in a ceiling, the ceiling must not be in
// its way, so here the shadow ray ends a little *before* the light. A
// coordinate of size $s$ is rounded by about $s$ times `distance_rounding`,
// so the larger of distance and coordinates decides how much.
//
// Write the direction to the light, of unit length, and the weight $I/d^2$.
// The distance is given: `distance - distance_rounding / 2 * size`.

// #region point-light
inline LightSample sample_light(const PointLight& light, const Vec3& x,
                                const Vec2&) {
  // #region exercise 2.1: point light
  // #stub return {Vec3(0, 0, 1), Vec3(0), 0};
  const Vec3 to_light = light.center - x;
  const float squared_distance = dot(to_light, to_light);
  const float distance = std::sqrt(squared_distance);
  const float size = distance + max_abs_component(light.center);
  return {to_light / distance, light.intensity / squared_distance,
          distance - distance_rounding / 2 * size};
  // #endregion
}
// #endregion point-light

// ## A rectangle that shines
//
// It is easy to choose a point on a rectangle: `corner + u.x * edge_u + u.y *
// edge_v` is uniform on its area $A$. So the density is $p_A = 1/A$, per
// *area*. The integral is over *solid angle*. How do the two go together?
//
// A small piece $dA$ of the lamp is seen from $x$ under the solid angle
// $d\omega$. Put a sphere of radius $d$ around $x$, through the piece. If the
// piece faces $x$, it covers the area $dA$ of this sphere. If it is tilted by
// $\theta'$, the angle between its normal $n'$ and the line back to $x$, it
// covers only $\cos\theta'\,dA$. Scaled down to the unit sphere, areas are
// $d^2$ times smaller:
//
// $$d\omega = \frac{\cos\theta'\,dA}{d^2}$$
//
// ![](area-to-angle)
//
// The probability of the piece is the same either way, $p(\omega)\,d\omega =
// p_A\,dA$. Hence
//
// $$p(\omega) = \frac{1}{A}\,\frac{dA}{d\omega} = \frac{d^2}{A \cos\theta'}
// \qquad
// \frac{L_e}{p(\omega)} = L_e\,\frac{A \cos\theta'}{d^2}$$
//
// Three factors, and each can be forgotten.
//
// ![](lamp-mistakes)
//
// The cross product of the two edges, `cross(edge_u, edge_v)`, is square to
// the rectangle, and its length is the area, for a parallelogram too. Divided
// by its length it is the lamp's normal. The lamp shines on that side only:
// behind it $\cos\theta'$ is negative, and no light comes. The distance of
// the sample is `distance * (1 + distance_rounding)`.

// #region rectangle-light
inline LightSample sample_light(const RectangleLight& light, const Vec3& x,
                                const Vec2& u) {
  // #region exercise 2.2: rectangle light
  // #stub return {Vec3(0, 0, 1), Vec3(0), 0};
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
  // #endregion
}
// #endregion rectangle-light

// ## A sphere that shines
//
// Points on its area would do, but more than half of them lie on the far
// side. The visible share of the area is $(1 - r/d)/2$. So choose
// *directions* instead. Seen from outside, a sphere of radius $r$ at the
// distance $d$ fills a cone of half-angle $\theta_{max}$, with
// $\sin\theta_{max} = r/d$. All directions in the cone hit the lamp.
//
// ![](lamp-cone)
//
// The cone's rule is the one of the hemisphere, with another end. The CDF of
// $\theta$ is $1 - \cos\theta$, and it must be 1 at $\theta_{max}$:
//
// $$\frac{1 - \cos\theta}{1 - \cos\theta_{max}} = \xi \quad\Rightarrow\quad
// 1 - \cos\theta = \xi\,(1 - \cos\theta_{max})$$
//
// The cone has the solid angle $\Omega_c = 2\pi\,(1 - \cos\theta_{max})$. So
// the density is $1/\Omega_c$, and the weight is $L_e\,\Omega_c$ (Shirley,
// Wang and Zimmerman, "Monte Carlo Techniques for Direct Lighting
// Calculations", ACM TOG 15(1), 1996). The lamp itself adds no noise to this;
// only the cosine at the surface and the edge of the shadow do.
//
// One trap: the lamp may be far away. Then $\cos\theta_{max}$ is 1 in
// `float`, and $1 - \cos\theta_{max}$ is 0. Compute the difference without
// the subtraction. With $c = \cos\theta$ and $\sin^2\theta = (1 - c)(1 + c)$,
//
// $$1 - \cos\theta_{max} = \frac{\sin^2\theta_{max}}{1 + \cos\theta_{max}}
// \qquad \sin^2\theta = (1 - c)(1 + c)$$
//
// The direction hits the sphere where? The line of sight comes closest to the
// center after $d\cos\theta$. There it is $d\sin\theta$ beside the center.
// Half the chord in the sphere is $\sqrt{r^2 - d^2\sin^2\theta}$, and the
// near end is that much earlier. Inside the lamp there is no light, since it
// shines outwards: the weight is 0.
//
// Given are the first lines, up to `one_minus_cos_max`. Write the direction
// and the sample. `Basis(to_center / distance)` has the cone's axis as z.

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

  // #region exercise 2.3: sphere light
  // #stub return {to_center / distance, Vec3(0), 0};
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
  // #endregion
}
// #endregion sphere-light

// ## Direct light
//
// Now ask all lights. The share of one is $f_r \cos\theta$ times its weight,
// or 0 if something is in the way. The shares are added up, as on the slides.
//
// - `leave(surface.hit, surface.normal)` is the place from which the light is
//   seen.
// - `sample_light(light, x, random.uniform_2d())` asks a light of any kind.
// - `dot(surface.normal, to_light.direction)` is $\cos\theta$. If it is not
//   positive, the light is below the horizon and brings nothing. With
//   $|\cos\theta|$ instead, thin walls would glow.
// - `scene.reaches(shadow_ray, to_light.distance, light)` is true if the ray,
//   made by `spawn_ray`, meets nothing but this light up to that distance.
//
// ![](no-shadow)

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
  // #region exercise 2.4: direct light
  // #stub return Vec3(0);
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
  // #endregion
}
// #endregion direct-light

// ## Counted once
//
// The path still runs into lamps. Has their light been counted already? It
// has if both are true: direct light was added at the surface before, and
// this lamp is one of the lights that were asked.
//
// ![](who-counts)
//
// - The camera may look straight at a lamp. There was no surface before, so
//   nothing was added, and the lamp counts.
// - Some lamps cannot be asked. A plane has no end, so no point on it can be
//   chosen uniformly, and triangles are not asked here either. They count.
//
// If a lamp counts in both places, the direct light doubles. If a lamp that
// was asked never counts when it is hit, the camera sees a black lamp.
//
// ![](counted)
//
// `surface.hit.light` points to the scene's light that was hit, and is null
// where the shape is none of them.

// #region counted-once
/// Whether `direct_light`, added at the surface before, has this emission in
/// it already.
inline bool is_counted(const Surface& surface, bool direct_light_added) {
  // #region exercise 2.5: counted once
  // #stub return false;
  return direct_light_added && surface.hit.light != nullptr;
  // #endregion
}
// #endregion counted-once

// ## The path
//
// The loop is stage 1's, with a `sum` beside the throughput. At each surface
// it adds the direct light, times the throughput. Direct light is a bounce
// too: that of a path whose last direction leads to the light. So it comes
// after the test of `max_bounces`. Then equal bounds give equal pictures in
// stages 1 and 2, up to noise, wherever the lights can be hit.
//
// ![](next-event)
//
// Why the flag `direct_light_added`, and not simply `bounce > 0`? From stage
// 3 on there are surfaces at which the lights are not asked.
//
// One path of the program, as before. At the first wall the lamp is reached,
// and (0.137, 0.123, 0.109) is added. At the second the light comes from
// behind. At the third the bound ends the path.
//
//     $ build/stage2 scenes/cornell_box_lamp_diffuse.toml
//     > --max-bounces 2 --pixel 60,150 --sample 1
//     ...
//     vertex 0: plane[4] of 'white', bounce 0
//     ...
//       light      (  0.3068,   0.7229,  -0.6191)  at 1.733: reached
//       adds       (   0.137,    0.123,    0.109)  direct light
//     ...
//     vertex 1: plane[3] of 'white', bounce 1
//     ...
//       throughput (     0.8,      0.8,      0.8)
//     ...
//     vertex 2: plane[0] of 'red', bounce 2
//     ...
//       ends       at the bound of 2 bounces
//     ...
//
// Write the part of the loop between the log and the next direction: what an
// emitter adds, where the path ends, and the direct light.

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

      // #region exercise 2.6: the loop with direct light
      // #stub return sum;
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
      // #endregion

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

// ![](direct-and-all)
//
// Check it: stage 1 and stage 2 must differ by noise alone. This command
// renders both and says so.
//
//     make diff A=stage1 B=stage2 SCENE=scenes/cornell_box_lamp_diffuse.toml
//
// What remains? Every material is diffuse. Mirrors and glass come next.
//
}  // namespace lightwalk::stage2
