#pragma once

// # Stage 1: diffuse surfaces
//
// A room has one thing that shines and walls that scatter. How bright is the
// wall that a pixel looks at? As bright as the light that reaches it from
// everywhere, and that light comes from other walls, which are as bright as
// the light that reaches *them*. The rendering equation says it in one line
// (slide "Which color do we fill each pixel with?"):
//
// $$L_o(x, \omega_o) = L_e(x, \omega_o) + \int_\Omega L_i(x, \omega_i)\,
// f_r(x, \omega_i, \omega_o)\,|n \cdot \omega_i|\,d\omega_i$$
//
// $L_o$ leaves the point $x$ towards $\omega_o$, $L_e$ is what the surface
// emits, $L_i$ is what arrives from $\omega_i$, and the integral runs over
// all directions of the hemisphere $\Omega$ above the surface. All three are
// *radiance*: power per area and solid angle, W/(m^2 sr). Radiance does not
// change along a ray, so the $L_i$ here is the $L_o$ of the wall over there.
//
// In the code `wo` and `wi` are $\omega_o$ and $\omega_i$. Both point *away*
// from the surface, whichever way the light goes.
//
// ![](hemisphere)

#include "common/math/basis.hpp"
#include "common/math/random.hpp"
#include "common/math/sine_cosine.hpp"
#include "common/render/render_settings.hpp"
#include "common/scene/scene.hpp"
#include "common/scene/surface.hpp"

namespace lightwalk::stage1 {

// ## The material
//
// A diffuse surface scatters light alike in all directions, so its $f_r$ is a
// constant. Which one? It returns the share $k_d$ of the power that it gets.
// Under light that is the same from all directions, $L_i = 1$, it must
// send out $k_d$; and $\int_\Omega \cos\theta\,d\omega = \pi$. Hence the
// division (slide "Diffuse and specular BRDFs"):
//
// $$f_r = \frac{k_d}{\pi}$$
//
// Without the $\pi$ every bounce would make three times the light it got, and
// the picture would grow brighter with each bounce that is allowed.

// #region evaluate
/// The BRDF, in 1/sr, for `wo` and `wi` on the same side of the surface.
inline Vec3 evaluate(const Material& material) {
  return material.kd * inverse_pi;
}
// #endregion evaluate

// ## One random direction
//
// There are infinitely many directions $\omega_i$, and only rays can tell
// what arrives from one. Monte Carlo's answer: take $N$ random ones with a
// density $p$, and average. Over one variable (slide "Approximating one
// integral") and over directions it is the same estimator:
//
// $$\int_a^b f(x)\,dx \approx
// \frac{1}{N} \sum_{i=1}^N \frac{f(x_i)}{p(x_i)}$$
//
// $$\int_\Omega f(\omega)\,d\omega \approx
// \frac{1}{N} \sum_{i=1}^N \frac{f(\omega_i)}{p(\omega_i)}$$
//
// The division repairs the choice: a direction that is drawn twice as often
// counts half. A path uses $N = 1$ at each bounce, one random direction, and
// the average is taken over the many paths of a pixel.
//
// Any $p$ gives the right mean as long as it is above 0 wherever $f$ is. A
// good one gives it sooner. Two are on the slides.
//
// ### Uniform in solid angle
//
// The hemisphere has $2\pi$ steradians, so $p(\omega) = 1/2\pi$. The slide
// writes densities in the two angles, $p(\theta) = \sin\theta$ and
// $p(\phi) = \frac{1}{2\pi}$; their product is $\sin\theta/2\pi$ because
// $d\omega = \sin\theta\,d\theta\,d\phi$: there is more hemisphere near its
// rim than around its pole. To draw $\theta$, invert its distribution
// $\int_0^\theta \sin t\,dt = 1 - \cos\theta = \xi$. As $1 - \xi$ is as
// uniform as $\xi$, the slide has $\theta = \arccos\xi$. So $\cos\theta$
// is $\xi$ itself, and no arccosine is ever computed. The other angle is
// uniform, $\phi = 2\pi\xi$, with a $\xi$ of its own.
//
// Drawing $\theta$ uniformly from $[0, \pi/2]$ would look nearly right, and
// would be wrong: too many directions crowd about the pole.

// #region uniform-sampling
/// A unit vector about `normal`, with density 1/(2 pi) per solid angle.
/// `u` is uniform in [0, 1)^2. Never below the surface.
inline Vec3 sample_uniform_hemisphere(const Vec3& normal, const Vec2& u) {
  const float cos_theta = u.x;
  const float sin_theta = std::sqrt(1 - u.x * u.x);
  const float phi = two_pi * u.y;
  return Basis(normal).to_world(
      {sin_theta * cos(phi), sin_theta * sin(phi), cos_theta});
}

/// Density per solid angle of `sample_uniform_hemisphere`, in 1/sr.
inline float uniform_hemisphere_pdf() {
  return 1 / two_pi;
}
// #endregion uniform-sampling

// ### In proportion to the cosine
//
// The integrand carries a factor $\cos\theta$, so directions near the horizon
// count for little. Draw fewer of them: $p(\omega) = \cos\theta/\pi$, in
// angles $p(\theta) = 2\sin\theta\cos\theta$. The distribution of $\theta$ is
// $\int_0^\theta 2 \sin t \cos t\,dt = \sin^2\theta = \xi$, and the slide's
// form of its inverse is $\theta = \arccos\sqrt{1 - \xi}$: so $\sin\theta =
// \sqrt{\xi}$ and $\cos\theta = \sqrt{1 - \xi}$.
//
// ![](two-densities)

// #region cosine-sampling
/// A unit vector about `normal`, with density cos(theta)/pi per solid angle.
/// `u` is uniform in [0, 1)^2. Never below the surface.
inline Vec3 sample_cosine_hemisphere(const Vec3& normal, const Vec2& u) {
  const float cos_theta = std::sqrt(1 - u.x);
  const float sin_theta = std::sqrt(u.x);
  const float phi = two_pi * u.y;
  return Basis(normal).to_world(
      {sin_theta * cos(phi), sin_theta * sin(phi), cos_theta});
}

/// Density per solid angle of `sample_cosine_hemisphere`, in 1/sr.
inline float cosine_hemisphere_pdf(float cos_theta) {
  return cos_theta * inverse_pi;
}
// #endregion cosine-sampling

// ## Remember to simplify
//
// What a bounce is worth is the term of the sum. The slide writes it in
// angles, where a $\sin\theta_i$ stands above and below, for uniform and for
// cosine sampling:
//
// $$\frac{2\pi L_i f_r \cos\theta_i \sin\theta_i}{\sin\theta_i}
// \qquad
// \frac{2\pi L_i f_r \cos\theta_i \sin\theta_i}
// {2 \sin\theta_i \cos\theta_i}$$
//
// Per solid angle the factor of $L_i$ is $f_r \cos\theta / p$, and then much
// cancels (slide "Sampling directions"):
//
// $$\text{uniform:}\quad \frac{k_d}{\pi}\,\cos\theta\,2\pi
// = 2 k_d \cos\theta \qquad
// \text{cosine:}\quad \frac{k_d}{\pi}\,\cos\theta\,\frac{\pi}{\cos\theta}
// = k_d$$
//
// With cosine sampling nothing random is left, and with it goes the noise
// that the factor $\cos\theta$ made. On a floor under a sky of one color,
// every single sample is exact. Nor is there a division that a $\cos\theta$
// of nearly 0 could spoil.

// #region weight
/// A direction to follow, and f_r cos(theta) / p for it.
struct BsdfSample {
  Vec3 wi;
  Vec3 weight;
};

/// The weight as the estimator has it, for any direction and density.
inline Vec3 unsimplified_weight(const Material& material, float cos_theta,
                                float pdf) {
  return evaluate(material) * cos_theta / pdf;
}

/// A direction on the side of `wo`, and its weight with all that cancels left
/// out.
inline BsdfSample sample(const Surface& surface, Sampling sampling,
                         const Vec2& u) {
  const Vec3& kd = surface.material.kd;
  if (sampling == Sampling::uniform) {
    const Vec3 wi = sample_uniform_hemisphere(surface.normal, u);
    return {wi, 2 * dot(surface.normal, wi) * kd};
  }
  return {sample_cosine_hemisphere(surface.normal, u), kd};
}
// #endregion weight

// ![](uniform-cosine)

// ## Light that a surface emits
//
// A lamp shines on the side that its normal points to, and its back is black.

// #region emitted
/// Radiance that the surface emits towards `wo`.
inline Vec3 emitted(const Surface& surface) {
  const bool front = dot(surface.hit.normal, surface.wo) > 0;
  return front ? surface.material.ke : Vec3(0);
}
// #endregion emitted

// ## The path
//
// A path starts at the camera and goes against the light. At each surface it
// picks one direction and moves on; `throughput` is the product of the
// weights so far, the share of what it may find that would reach the camera.
// It ends
//
// - when it leaves the scene: it adds nothing, for outside it is black;
// - at a surface that emits: it adds the emission times the throughput;
// - after `max_bounces` bounces, one at each surface that scatters.
//
// So `max_bounces` 0 shows the lamps alone, 1 what they light directly, and
// each further one adds the light that took one more turn. Cutting paths off
// makes the picture too dark. How much light goes missing depends on the
// walls: with $k_d = 0.8$ the eighth bounce still carries a sixth.
//
// What the path needs to know of the place where it is, is a `Surface`: the
// hit, the material, the direction `wo` back along the path, and the normal.
// The wall's own normal may point to either side; the path is on the side it
// came from, so a surface's normal is turned there. `log_vertex` changes
// nothing: it tells the option `--pixel` where the path is.
//
// Rays that find the lamp only by chance find it seldom when it is small: a
// few paths bring much, most bring nothing, and the picture is full of
// specks. This stage is at its best when the whole ceiling shines.

// #region path
class PathTracer {
 public:
  PathTracer(const Scene& scene, const RenderSettings& settings)
      : scene_(scene),
        max_bounces_(settings.max_bounces),
        sampling_(settings.sampling) {}

  /// Radiance that comes back along the ray, as one path sees it: its mean
  /// over many paths is what the rendering equation asks for.
  Vec3 radiance(Ray ray, Random& random) const {
    Vec3 throughput(1);
    for (int bounce = 0;; ++bounce) {
      // Find the next surface.
      const std::optional<Hit> hit = scene_.nearest_hit(ray);
      if (!hit) return Vec3(0);
      const Surface surface(*hit, *hit->material, -ray.direction);
      log_vertex(surface, throughput, Vec3(0), bounce);

      // An emitter ends the path.
      if (surface.material.emits()) return throughput * emitted(surface);
      if (bounce == max_bounces_) return Vec3(0);

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

// ![](samples)

// ![](diffuse-bounces)

}  // namespace lightwalk::stage1
