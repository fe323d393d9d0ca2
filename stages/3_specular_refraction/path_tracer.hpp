#pragma once

// # Stage 3: perfect mirrors and glass
//
// So far light forgot, at each surface, where it came from. A mirror does
// not: what arrives from one direction leaves in one direction. And glass
// lets it through, bent. This stage adds both, and mixes all three in one
// material.

#include <array>

#include "stages/2_next_event/path_tracer.hpp"

namespace lightwalk::stage3 {

using stage1::BsdfSample;
using stage1::emitted;
using stage2::direct_light;
using stage2::is_counted;

// ## A BRDF that is a spike
//
// A perfect mirror sends all light of $\omega_i$ to $\omega_r$ and none
// elsewhere. As a function of direction that is a spike without width, with
// an integral of 1: a delta (slide "Perfect specular (delta BRDF) sampling"):
//
// $$f_r(x, \omega_i, \omega_o) =
// \frac{\delta_{\omega_r}(\omega_i)}{\omega_i \cdot n}$$
//
// ![](mirror-cone)
//
// The division takes back the cosine of the rendering equation: the mirror
// shows things as bright as they are, at the rim as in the middle. Multiply
// by a cosine all the same, and mirror balls get dark rims.
//
// So the product that the equation integrates, on a diffuse surface a smooth
// $f_r\,|n \cdot \omega_i| = \frac{k_d}{\pi}\,|n \cdot \omega_i|$, is all or
// nothing here: $f_r\,|n \cdot \omega_i| = 1$, as the weight of the spike,
// for the one direction, and $f_r\,|n \cdot \omega_i| = 0$ for any other.
//
// Monte Carlo has nothing to do here. A random direction hits the spike
// with probability 0, so cosine sampling would render mirrors black. The only
// direction that counts is known: take it, with the probability
// $p(\omega_r) = 1$. Then $f_r \cos\theta / p$ is the coefficient $k_s$, and
// that is all.
//
// ## Reflection
//
// The slide has $\omega_r = \omega_o - 2n\,(\omega_o \cdot n)$. That is right
// for an $\omega_o$ that points *at* the surface, as the ray does. Here `wo`
// points away from it, and the same mirror image is its negative.

// #region reflect
/// `wo` mirrored at the normal; both point away from the surface. Units stay.
inline Vec3 reflect(const Vec3& wo, const Vec3& normal) {
  // #region exercise 3.1: mirror direction
  // #stub return Vec3(0);
  return 2 * dot(wo, normal) * normal - wo;
  // #endregion
}
// #endregion reflect

// ## Refraction
//
// Glass lets light through, into one direction $\omega_t$ on the other side:
// a spike again, and again it is taken with the probability
// $p(\omega_t) = 1$:
//
// $$f_r(x, \omega_i, \omega_o) =
// \frac{\delta_{\omega_t}(\omega_i)}{\omega_i \cdot n}$$
//
// Light goes slower in glass, by the index of refraction $\eta$, and so it
// bends where it enters. With $\eta_o$ on the side of $\omega_o$ and $\eta_i$
// on the other, Snell's law (slide "Perfect refraction") says
//
// $$\eta_i \sin\theta_i = \eta_o \sin\theta_o \quad\Rightarrow\quad
// \sin\theta_i = \frac{\eta_o}{\eta_i} \sin\theta_o$$
//
// Split `wo` into a part along the normal, $\cos\theta_o\,n$, and the rest,
// which lies in the surface. The refracted direction is on the other side, so
// its part in the surface is turned around and stretched by $\eta_o/\eta_i$,
// and its part along the normal is $-\cos\theta_i\,n$:
//
// $$\omega_i = -\frac{\eta_o}{\eta_i}(\omega_o - \cos\theta_o\,n)
// - \cos\theta_i\,n$$
//
// On the way out of glass $\eta_o/\eta_i$ is 1.5, and beyond 41.8 degrees no
// $\theta_i$ has so large a sine: no light gets out. All of it is reflected,
// and this *total internal reflection* is why glass and water glitter.
//
// ![](snell)

// #region refract
/// The direction behind the surface that `wo` is bent to, or nothing where
/// all light is reflected. `normal` is on the side of `wo`, and `eta_ratio`
/// is eta_o / eta_i, the index on the side of `wo` over the index behind.
inline std::optional<Vec3> refract(const Vec3& wo, const Vec3& normal,
                                   float eta_ratio) {
  const float cos_o = dot(wo, normal);
  const float sin2_o = std::max(0.0f, 1 - cos_o * cos_o);
  const float sin2_i = eta_ratio * eta_ratio * sin2_o;
  if (sin2_i >= 1) return std::nullopt;
  const float cos_i = std::sqrt(1 - sin2_i);
  return normalize(-eta_ratio * (wo - cos_o * normal) - cos_i * normal);
}

/// eta_o / eta_i for light that leaves towards `wo`. The shape's own normal
/// points outside, where the index is 1; inside it is the material's.
inline float relative_eta(const Surface& surface) {
  const bool outside = dot(surface.hit.normal, surface.wo) > 0;
  return outside ? 1 / surface.material.eta : surface.material.eta;
}
// #endregion refract

// ![](total-reflection)

// ## What refraction does to radiance
//
// Light that enters glass is squeezed into a narrower cone: all of the
// hemisphere outside ends up within 41.8 degrees of the normal. The same
// power in less solid angle is more radiance, by the squared ratio of the
// indices (Veach 1997, section 5.2):
//
// $$L_o = k_t \left(\frac{\eta_o}{\eta_i}\right)^2 L_i$$
//
// The slides leave the square out, and get away with it: what a path loses
// where it enters a closed ball, it gains back where it leaves. It shows when
// the camera or a light is inside the glass, where the world outside looks
// $1.5^2 = 2.25$ times as bright.
//
// The program tells it of a path through the ball, where $k_t = 0.9$. The
// weight is $0.9 / 2.25$ where it enters, and $0.9 \cdot 2.25$ where it
// leaves:
//
//     $ build/stage3 scenes/cornell_box_point.toml --max-bounces 2
//     > --pixel 170,200 --sample 3
//     ...
//     vertex 0: sphere[1] of 'glass', bounce 0
//     ...
//       goes on    (  0.2716,  -0.2781,   0.9214)  refraction
//       weight     (     0.4,      0.4,      0.4)  to vertex 3
//     ...
//       vertex 3: sphere[1] of 'glass', bounce 1
//     ...
//         goes on    (  0.4237,  -0.3605,   0.8310)  refraction
//         weight     (   2.025,    2.025,    2.025)  to vertex 5
//     ...
//
// ## The full BSDF
//
// One material may be all three at once (slide "The full BSDF"):
//
// $$f_r = k_d\,\frac{1}{\pi}
// + k_s\,\frac{\delta_{\omega_r}(\omega_i)}{n \cdot \omega_i}
// + k_t\,\frac{\delta_{\omega_t}(\omega_i)}{n \cdot \omega_i},
// \qquad k_d + k_s + k_t \le 1$$
//
// The slide's fourth coefficient is the emission $k_e$, which is the
// $L_e(x, \omega_o)$ of the rendering equation; where $k_e > 0$ the other
// three are 0.
//
// Each of the three lobes has its own way to draw a direction. `evaluate`
// stays as it was, $k_d/\pi$: for a direction that was chosen without regard
// to the spikes, such as one to a light, they are 0.

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
  if (lobe == Lobe::diffuse) {
    return stage1::sample(surface, sampling, random.uniform_2d());
  }
  if (lobe == Lobe::specular) return {reflect(wo, normal), material.ks};
  const float eta_ratio = relative_eta(surface);
  const std::optional<Vec3> wi = refract(wo, normal, eta_ratio);
  if (!wi) return {reflect(wo, normal), material.kt};
  return {*wi, eta_ratio * eta_ratio * material.kt};
}
// #endregion sample

// ## Lights and spikes
//
// A direction to a light is never on the spike, so next-event estimation
// returns 0 for the two new lobes (slide "Next-event estimation and delta
// BRDF"), and is not tried. Their share of a lamp's light comes by the path
// that hits it: the rule of stage 2, "counted once", now has its second case.
// A lamp met behind a mirror has not been asked, and counts.
//
// Two things follow that look like errors and are none. Under a *point* light
// a glass ball casts a black shadow: the light that the ball would gather
// into a bright spot, a caustic, arrives by paths that would have to hit a
// point. And the point light itself has no image in the mirror. Under a lamp
// with an area both are there, though the caustic is noisy, since a diffuse
// bounce has to find the lamp through the glass by chance.
//
// ![](glass-and-lights)
//
// ## Which way to go on
//
// A matt wall has $k_d > 0$, a mirror $k_s > 0$, and plastic $k_d, k_s > 0$:
// it is both (slide "Combining coefficients"). Follow only one lobe, and the
// other's light is missing. So follow both: one ray for each lobe that has a
// coefficient. The path becomes a tree. Each of its branches is followed like
// the whole, so what was a loop becomes a function that calls itself.
//
// The price: with two lobes at every hit, each bounce doubles the rays. In
// `scenes/plastic.toml`, where every surface is plastic, a sample costs
//
// | `--max-bounces` | 1 | 2 | 4 | 6 | 8 | 10 | 12 |
// |---|---|---|---|---|---|---|---|
// | rays | 4 | 10 | 45 | 188 | 760 | 3,050 | 12,200 |
//
// and most of those rays carry next to nothing. Hence a bound on the bounces,
// which makes the picture too dark; and it cannot be set high. Both will have
// to be mended.
//
// ![](plastic-lobes)

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

// ## The path
//
// One turn of stage 2's loop is one call here. A bounce at a mirror counts as
// a bounce.

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
  }

  const Scene& scene_;
  int max_bounces_;
  Sampling sampling_;
};
// #endregion path

// ![](glass-bounces)

}  // namespace lightwalk::stage3
