#pragma once

// # Stage 3: perfect mirrors and glass
//
// A diffuse wall scatters light in all directions, wherever it came from. A
// mirror does not: what arrives from one direction leaves in one direction.
// Glass lets light through, and bends it. This stage adds both, and materials
// that are several things at once.
//
// ![](glass-and-lights)
//
// Each way in which a material sends light on is called a *lobe*. There are
// three now: diffuse, specular (the mirror), and refraction (the glass).
//
#include <array>

#include "stages/2_next_event/path_tracer.hpp"

namespace lightwalk::stage3 {

using stage1::BsdfSample;
using stage1::emitted;
using stage2::direct_light;
using stage2::is_counted;

// ## A mirror is a very thin cone
//
// What is the BRDF of a mirror? Begin with a surface that is not quite one.
// It shows all directions within a thin cone around the mirror direction
// $\omega_r$. The cone has the solid angle $\varepsilon$. Inside it the BRDF
// is a large constant, outside it is 0.
//
// ![](mirror-cone)
//
// The surface gives back the fraction $k_s$ of the light. Let $L_i = 1$, and
// $\theta$ nearly constant in the thin cone:
//
// $$k_s = \int_\Omega f_r \cos\theta\,d\omega = f_r \cos\theta\,\varepsilon
// \quad\Rightarrow\quad f_r = \frac{k_s}{\varepsilon \cos\theta}$$
//
// Sample a direction uniformly in this cone. The density is $p =
// 1/\varepsilon$, and the weight of the bounce is
//
// $$\frac{f_r \cos\theta}{p}
// = \frac{k_s}{\varepsilon\cos\theta}\,\cos\theta\,\varepsilon = k_s$$
//
// The solid angle $\varepsilon$ cancels, and so does the cosine. Now let
// $\varepsilon$ go to 0. The cone becomes one direction, and the weight stays
// $k_s$. That is all of a mirror: compute $\omega_r$, and multiply by $k_s$.
//
// A function that is 0 except in one direction, and yet has the integral 1,
// is called a *Dirac delta*. The slide "Perfect specular (delta BRDF)
// sampling" writes the limit with it:
//
// $$f_r(x, \omega_i, \omega_o) = k_s\,
// \frac{\delta_{\omega_r}(\omega_i)}{\omega_i \cdot n},
// \qquad p(\omega_r) = 1$$
//
// The 1 is a *probability*, not a density: the direction is certain. The
// cosine below the delta cancels the one of the rendering equation. So a
// mirror shows things as bright as they are, at the rim as in the middle.
// Multiply by the cosine all the same, and mirror balls get dark rims.
//
// ![](mirror-mistakes)
//
// Two things follow from the limit. A direction that is drawn at random never
// lies in the cone of size 0: cosine sampling would render mirrors black. And
// the direction to a light never does either: at a mirror, next-event
// estimation brings nothing.
//
// ## The mirror direction
//
// Split `wo` into two parts: the part along the normal, $(\omega_o \cdot
// n)\,n$, and the rest, which lies in the surface. A mirror keeps the first
// and turns the second around:
//
// $$\omega_r
// = (\omega_o \cdot n)\,n - \big(\omega_o - (\omega_o \cdot n)\,n\big)
// = 2n\,(\omega_o \cdot n) - \omega_o$$
//
// ![](mirror-parts)
//
// The slide has $\omega_r = \omega_o - 2n\,(\omega_o \cdot n)$. There
// $\omega_o$ points *at* the surface, as the ray does. Here `wo` points away
// from it, so the sign is the other one. With the wrong sign the ray goes on
// through the mirror.

// #region reflect
/// `wo` mirrored at the normal; both point away from the surface. Units stay.
inline Vec3 reflect(const Vec3& wo, const Vec3& normal) {
  // #region exercise 3.1: mirror direction
  // #stub return normal;
  return 2 * dot(wo, normal) * normal - wo;
  // #endregion
}
// #endregion reflect

// ## Refraction
//
// Glass lets light through, into one direction $\omega_t$ on the other side.
// It is a delta again:
//
// $$f_r(x, \omega_i, \omega_o) =
// k_t\,\frac{\delta_{\omega_t}(\omega_i)}{|\omega_i \cdot n|}$$
//
// The bars matter now, because $\omega_t$ is behind the surface and $\omega_i
// \cdot n$ is negative. The integral runs over the whole sphere.
//
// Light is slower in glass, by the *index of refraction* $\eta$: 1 for air,
// 1.5 for window glass. So it bends. Let $\eta_o$ be the index on the side of
// `wo`, and $\eta_i$ the one behind. *Snell's law* (slide "Perfect
// refraction") is
//
// $$\eta_i \sin\theta_i = \eta_o \sin\theta_o \quad\Rightarrow\quad
// \sin\theta_i = \frac{\eta_o}{\eta_i} \sin\theta_o$$
//
// ![](refraction-parts)
//
// The new direction has two parts again. The part in the surface is that of
// `wo`, turned around and scaled: its length was $\sin\theta_o$ and must be
// $\sin\theta_i$, so the factor is $\eta_o/\eta_i$. The part along the normal
// is $-\cos\theta_i\,n$, since it goes down:
//
// $$\omega_t = -\frac{\eta_o}{\eta_i}\,(\omega_o - \cos\theta_o\,n)
// - \cos\theta_i\,n, \qquad \cos\theta_i = \sqrt{1 - \sin^2\theta_i}$$
//
// This has unit length by its formula. Rounding spoils that a little with
// every bounce, so it is normalized.
//
// On the way *out* of glass the ratio is 1.5. Where $\sin\theta_o$ is above
// $1/1.5$, which is beyond 41.8 degrees, $\sin\theta_i$ would be above 1. No
// such direction exists. All light is reflected, and this is *total internal
// reflection*. The angle is the *critical angle*.
//
// ![](snell)
//
// Write `refract`. It returns nothing (`std::nullopt`) where all is
// reflected. Use $\sin^2\theta_o = 1 - \cos^2\theta_o$. It may come out a
// little below 0 by rounding, so take the larger of it and 0.
//
// `relative_eta` gives $\eta_o/\eta_i$. The shape's own normal,
// `surface.hit.normal`, points outside, where the index is 1. If `surface.wo`
// is on its side, the path is outside: the ratio is $1/\eta$. Otherwise it is
// inside, and the ratio is $\eta$.

// #region refract
/// The direction behind the surface that `wo` is bent to, or nothing where
/// all light is reflected. `normal` is on the side of `wo`, and `eta_ratio`
/// is eta_o / eta_i, the index on the side of `wo` over the index behind.
inline std::optional<Vec3> refract(const Vec3& wo, const Vec3& normal,
                                   float eta_ratio) {
  // #region exercise 3.2: refracted direction
  // #stub return std::nullopt;
  const float cos_o = dot(wo, normal);
  const float sin2_o = std::max(0.0f, 1 - cos_o * cos_o);
  const float sin2_i = eta_ratio * eta_ratio * sin2_o;
  if (sin2_i >= 1) return std::nullopt;
  const float cos_i = std::sqrt(1 - sin2_i);
  return normalize(-eta_ratio * (wo - cos_o * normal) - cos_i * normal);
  // #endregion
}

/// eta_o / eta_i for light that leaves towards `wo`. The shape's own normal
/// points outside, where the index is 1; inside it is the material's.
inline float relative_eta(const Surface& surface) {
  // #region exercise 3.3: inside or outside
  // #stub return 1;
  const bool outside = dot(surface.hit.normal, surface.wo) > 0;
  return outside ? 1 / surface.material.eta : surface.material.eta;
  // #endregion
}
// #endregion refract

// ![](eta-mistakes)
//
// ## What refraction does to radiance
//
// Light that enters glass is squeezed into a narrower cone. All of the
// hemisphere outside ends up within 41.8 degrees of the normal. The same
// power in a narrower cone is a larger radiance. By how much?
//
// What counts for power is solid angle times cosine. Over the hemisphere
// outside its integral is $\pi$, as in stage 1. Over the cone inside, with
// the critical angle $\theta_c$,
//
// $$\int_0^{2\pi}\!\!\int_0^{\theta_c} \cos\theta \sin\theta\,d\theta\,d\phi
// = \pi \sin^2\theta_c = \frac{\pi}{1.5^2} = \frac{\pi}{2.25}$$
//
// ![](critical-cone)
//
// The power is the same, so the radiance inside is 2.25 times the one
// outside. In general (Veach 1997, section 5.2), seen along the path,
//
// $$L_o = k_t \left(\frac{\eta_o}{\eta_i}\right)^2 L_i$$
//
// Think of the camera. If it is *in* the glass and looks out, $\eta_o = 1.5$,
// and the world looks 2.25 times as bright. If a lamp is in the glass and the
// camera outside, the lamp looks 2.25 times darker. A path that enters a ball
// and leaves it gets both factors, and they cancel. This is why the slides
// can leave the square out.
//
// ![](total-reflection)
//
// One path of the program shows it. The ball has $k_t = 0.9$. Where the path
// enters, the weight is $0.9/2.25 = 0.4$. Where it leaves, it is $0.9 \cdot
// 2.25 = 2.025$. The product of both is $0.81$, the throughput at vertex 5.
//
//     $ build/stage3 scenes/cornell_box_point.toml --max-bounces 2
//     > --pixel 170,200 --sample 3
//     ...
//     vertex 0: sphere[1] of 'glass', bounce 0
//     ...
//       goes on    ( -0.8064,   0.5273,  -0.2677)  specular
//       weight     (     0.1,      0.1,      0.1)  to vertex 1
//       goes on    (  0.2716,  -0.2781,   0.9214)  refraction
//       weight     (     0.4,      0.4,      0.4)  to vertex 3
//     ...
//       vertex 3: sphere[1] of 'glass', bounce 1
//     ...
//         goes on    (  0.4237,  -0.3605,   0.8310)  refraction
//         weight     (   2.025,    2.025,    2.025)  to vertex 5
//     ...
//         vertex 5: plane[2] of 'white', bounce 2
//     ...
//           throughput (    0.81,     0.81,     0.81)
//     ...
//
// ## The full BSDF
//
// One material may be all three at once (slide "The full BSDF"; with
// transmission the BRDF is called *BSDF*, S for scattering):
//
// $$f_r = k_d\,\frac{1}{\pi}
// + k_s\,\frac{\delta_{\omega_r}(\omega_i)}{|n \cdot \omega_i|}
// + k_t\,\frac{\delta_{\omega_t}(\omega_i)}{|n \cdot \omega_i|},
// \qquad k_d + k_s + k_t \le 1$$
//
// The slide's fourth coefficient, $k_e$, is the emission. Where $k_e > 0$ the
// other three are 0.
//
// Each lobe has its own way to find a direction, and its own weight:
//
// - diffuse: as in stage 1;
// - specular: the mirror direction, and $k_s$;
// - refraction: the refracted direction, and $k_t\,(\eta_o/\eta_i)^2$;
// - refraction, with total internal reflection: the mirror direction. The
//   light stays in the glass, so the weight is $k_t$ without the ratio.

// #region sample
enum class Lobe { diffuse, specular, refraction };
inline constexpr std::array all_lobes = {Lobe::diffuse, Lobe::specular,
                                         Lobe::refraction};

/// The lobe's coefficient: kd, ks or kt.
inline const Vec3& coefficient(const Material& material, Lobe lobe) {
  switch (lobe) {
    case Lobe::diffuse:
      return material.kd;
    case Lobe::specular:
      return material.ks;
    default:
      return material.kt;
  }
}

/// A direction of one lobe, and f_r cos(theta) / p of that lobe for it.
inline BsdfSample sample(Lobe lobe, const Surface& surface, Sampling sampling,
                         Random& random) {
  const auto& [hit, material, wo, normal] = surface;
  // #region exercise 3.4: a direction of each lobe
  // #stub return {normal, Vec3(0)};
  if (lobe == Lobe::diffuse) {
    return stage1::sample(surface, sampling, random.uniform_2d());
  }
  if (lobe == Lobe::specular) return {reflect(wo, normal), material.ks};
  const float eta_ratio = relative_eta(surface);
  const std::optional<Vec3> wi = refract(wo, normal, eta_ratio);
  if (!wi) return {reflect(wo, normal), material.kt};
  return {*wi, eta_ratio * eta_ratio * material.kt};
  // #endregion
}
// #endregion sample

// ## Lights and deltas
//
// At a surface that is a mirror only, the lights are not asked. Then the path
// goes on, and may hit a lamp. That lamp was not asked at the surface before,
// so by the rule of stage 2 it counts: this is how a lamp appears in a
// mirror. So the flag "direct light added" must be true after a *diffuse*
// bounce only, also where the material is both, like plastic.
//
// Two things look like bugs and are not:
//
// - Under a *point* light a glass ball has a black shadow. The straight
//   shadow ray is stopped by the glass. The light that really gets there is
//   bent, into a bright spot called a *caustic*. Its paths would have to hit
//   a point.
// - The point light has no image in a mirror, for the same reason.
//
// Under a lamp with an area both are there. The caustic is noisy, since a
// diffuse bounce has to find the lamp through the glass by chance.
//
// ## Which way to go on
//
// Plastic has $k_d > 0$ and $k_s > 0$ (slide "Combining coefficients").
// Follow one lobe only, and the light of the other is missing.
//
// ![](plastic-lobes)
//
// So follow both: one ray for each lobe that has a coefficient. The path
// becomes a tree. A branch is followed just as the whole is, so the loop of
// stage 2 becomes a function that calls itself. What it must hand on is a
// `Branch`: the ray, the throughput, how many bounces lie behind it, and the
// flag.

// #region branch
/// One branch of the tree, where it begins.
struct Branch {
  Ray ray;
  Vec3 throughput{1};
  int bounce = 0;                   ///< how many bounces lie behind it
  bool direct_light_added = false;  ///< at the surface that it comes from
};

/// More bounces than this would never end anyhow: 2^64 rays.
inline constexpr int most_bounces = 64;
// #endregion branch

// What does the tree cost? With two lobes at every hit there are $2^n$ rays
// of the $n$-th bounce. Together with the camera's ray that is $1 + 2 +
// \dots + 2^n = 2^{n+1} - 1$. Each surface but those of the last bounce also
// sends a shadow ray: $2^n - 1$ of them, with one light. In all
//
// $$3 \cdot 2^n - 2$$
//
// ![](tree)
//
// In `scenes/plastic.toml` everything is plastic. The program counts a few
// rays less than the formula, since a light below the horizon is not asked:
//
// | `--max-bounces` | 1 | 2 | 4 | 8 | 12 |
// |---|---|---|---|---|---|
// | $3 \cdot 2^n - 2$ | 4 | 10 | 46 | 766 | 12,286 |
// | counted | 4 | 10 | 45 | 760 | 12,200 |
//
// Most of those rays carry next to nothing. So the number of bounces must be
// small, and then the picture is too dark. With two lobes at every hit, more
// than `most_bounces` bounces would not end in a lifetime, so that is the
// limit.
//
// ## The path
//
// One turn of stage 2's loop is one call here. Write how the path goes on:
// ask the lights if there is a diffuse lobe, then follow each lobe that has a
// coefficient. `is_black(color)` is true if all three channels are 0. A
// bounce at a mirror counts as a bounce.

// #region path
class PathTracer {
 public:
  PathTracer(const Scene& scene, const RenderSettings& settings)
      : scene_(scene),
        max_bounces_(std::min(settings.max_bounces, most_bounces)),
        sampling_(settings.sampling) {}

  /// Radiance that comes back along the ray, as one tree of paths sees it.
  Vec3 radiance(const Ray& ray, Random& random) const {
    Vec3 sum(0);
    follow({ray}, sum, random);
    return sum;
  }

 private:
  /// Adds to the sum what comes back along a branch.
  void follow(const Branch& path, Vec3& sum, Random& random) const {
    // Find the next surface.
    const std::optional<Hit> hit = scene_.nearest_hit(path.ray);
    if (!hit) return;
    const Surface surface(*hit, *hit->material, -path.ray.direction);
    log_vertex(surface, path.throughput, sum, path.bounce);

    // An emitter ends the path, and counts if it has not been counted.
    if (surface.material.emits()) {
      if (!is_counted(surface, path.direct_light_added)) {
        sum += path.throughput * emitted(surface);
      }
      return;
    }
    if (path.bounce == max_bounces_) return;

    // #region exercise 3.5: every lobe followed
    // #stub return;
    // Ask the lights, for the diffuse lobe.
    if (!is_black(surface.material.kd)) {
      sum += path.throughput * direct_light(scene_, surface, random);
    }

    // Go on in a direction of every lobe.
    for (const Lobe lobe : all_lobes) {
      if (is_black(coefficient(surface.material, lobe))) continue;
      const BsdfSample next = sample(lobe, surface, sampling_, random);
      follow({spawn_ray(*hit, next.wi), path.throughput * next.weight,
              path.bounce + 1, lobe == Lobe::diffuse},
             sum, random);
    }
    // #endregion
  }

  const Scene& scene_;
  int max_bounces_;
  Sampling sampling_;
};
// #endregion path

// ![](glass-bounces)
//
// Watch the clock while the bound grows, and count the lamps in the corridor:
//
//     build/stage3 scenes/plastic.toml -o p.png --spp 4 --max-bounces 8
//     build/stage3 scenes/mirror_corridor.toml -o c.png --max-bounces 4
//
// What remains? The tree doubles with each bounce, and the bound makes
// pictures too dark. Stage 4 mends both with one idea.
//
}  // namespace lightwalk::stage3
