#pragma once

// # Stage 1: diffuse surfaces
//
// A pixel shows one point of a wall. What color does it get? The light that
// leaves this point towards the camera. That light was scattered by the wall,
// so it came from somewhere else: from a lamp, or from another wall. How
// bright the other wall is depends on *its* surroundings. A path tracer
// follows this chain backwards, from the camera to a lamp, along one random
// path. Then it takes another random path, and the mean of many is the
// picture.
//
// ![](wall-and-lamp)
//
// The amount of light along a ray is its *radiance*, in W/(m^2 sr): power per
// area and per solid angle. Light here has three channels, red, green and
// blue, so a radiance is a `Vec3`. The core makes the ray of a pixel
// (`common/`); this chapter answers what radiance comes back along it.
//
// ## The rendering equation
//
// The slide "Which color do we fill each pixel with?" has the answer in one
// line. At a point $x$ of a surface, in the direction $\omega_o$ back to the
// camera:
//
// $$L_o(x, \omega_o) = L_e(x, \omega_o) + \int_\Omega L_i(x, \omega_i)\,
// f_r(x, \omega_i, \omega_o)\,|n \cdot \omega_i|\,d\omega_i$$
//
// - $L_o$ is the radiance that leaves $x$ towards $\omega_o$. It is asked
//   for.
// - $L_e$ is what the surface emits by itself. Only lamps have it.
// - $L_i$ is the radiance that arrives at $x$ from the direction $\omega_i$.
// - $f_r$ is the *BRDF*, the bidirectional reflectance distribution function.
//   It says how much of $L_i$ is scattered towards $\omega_o$.
// - $n$ is the normal, and $|n \cdot \omega_i| = \cos\theta$. Light that
//   comes in at a slant is spread over more area.
// - $\Omega$ is the hemisphere of directions above the surface.
//
// In the code `wo` and `wi` are $\omega_o$ and $\omega_i$. Both point *away*
// from the surface, whichever way the light goes.
//
// In clear air radiance does not change along a ray. So what arrives at $x$
// from $\omega_i$ is what leaves the next surface $y$ in that direction,
// backwards:
//
// $$L_i(x, \omega_i) = L_o(y, -\omega_i)$$
//
// This makes the equation recursive: $L_o$ at one wall needs $L_o$ at all the
// others. The whole chapter follows from this line.
//
#include "common/math/basis.hpp"
#include "common/math/random.hpp"
#include "common/math/sine_cosine.hpp"
#include "common/render/render_settings.hpp"
#include "common/scene/scene.hpp"
#include "common/scene/surface.hpp"

namespace lightwalk::stage1 {

// ## The material
//
// A *diffuse* surface, such as chalk or a painted wall, scatters light
// equally in all directions. So its BRDF is a constant. Which one?
//
// The material has an *albedo* $k_d$ for each channel: the fraction of the
// power that it gives back, between 0 and 1. Suppose the same radiance $L_i =
// 1$ arrives from every direction. Then the surface must send out $k_d$. Put
// this into the equation:
//
// $$k_d = \int_\Omega 1 \cdot f_r \cos\theta\,d\omega
// = f_r \int_\Omega \cos\theta\,d\omega = f_r\,\pi
// \quad\Rightarrow\quad f_r = \frac{k_d}{\pi}$$
//
// Why is the last integral $\pi$? Look straight down on the hemisphere. Its
// radius is 1. A small patch $d\omega$ on it is seen foreshortened, with the
// area $\cos\theta\,d\omega$ on the ground. All patches together cover the
// disk, and the area of the disk is $\pi$.
//
// ![](disk)
//
// Without the division a wall scatters $\pi\,k_d$ times what it got. With
// $k_d = 0.8$ that is 2.5 times, and every bounce makes more light.
//
// ![](no-pi)
//
// `evaluate` returns the BRDF. The albedo is `material.kd`, and the core has
// the constants `pi`, `two_pi` and `inverse_pi`, which is $1/\pi$.

// #region evaluate
/// The BRDF, in 1/sr, for `wo` and `wi` on the same side of the surface.
inline Vec3 evaluate(const Material& material) {
  // #region exercise 1.1: diffuse BRDF
  // #stub return Vec3(0);
  return material.kd * inverse_pi;
  // #endregion
}
// #endregion evaluate

// ## Monte Carlo
//
// The integral has infinitely many directions. A ray can ask one. *Monte
// Carlo integration* asks a few random ones and takes the mean. Say a random
// number generator gives $x$ with the *probability density* $p(x)$, or *pdf*.
// Then
//
// $$\int_a^b f(x)\,dx \approx
// \frac{1}{N} \sum_{i=1}^N \frac{f(x_i)}{p(x_i)}$$
//
// (slide "Approximating one integral"). The division by $p$ repairs the
// choice: a value that is drawn twice as often counts half.
//
// An example in one dimension. The integral of $f(x) = 2x$ from 0 to 1 is 1.
// Draw four uniform numbers, with $p = 1$: 0.1, 0.3, 0.6 and 0.9. Then $f/p$
// is 0.2, 0.6, 1.2 and 1.8, and the mean is 0.95. Each number alone is far
// off. How far, is the *variance*, the mean of the squared error. Here it is
// $\int_0^1 (2x - 1)^2\,dx = 1/3$, so a typical error is $\sqrt{1/3} = 0.58$.
// In a picture this error is the *noise*.
//
// ![](four-numbers)
//
// The variance of a mean of $N$ numbers is $N$ times smaller, and its root,
// the error, $\sqrt N$ times: 0.29 for four numbers. So half the noise costs
// four times the samples.
//
// ![](samples)
//
// Now draw $x$ with the density $p(x) = 2x$, in proportion to $f$. Every
// single $f/p$ is 1. One sample is exact, and the variance is 0. Any density
// gives the right mean if it is above 0 where $f$ is. A density that is like
// $f$ needs fewer samples. This is *importance sampling*.
//
// Over directions it is the same estimator:
//
// $$\int_\Omega f(\omega)\,d\omega \approx
// \frac{1}{N} \sum_{i=1}^N \frac{f(\omega_i)}{p(\omega_i)}$$
//
// A path uses $N = 1$ at each bounce: one random direction. The mean is taken
// over the many paths of a pixel.
//
// ## Drawing a direction
//
// A direction has two angles: $\theta$ from the normal, and $\phi$ around it.
// The slide "Sampling directions" gives a density for each. Two questions:
// where do the densities come from, and how does one draw from them?
//
// **From solid angle to angles.** A patch of the hemisphere between $\theta$
// and $\theta + d\theta$, $\phi$ and $\phi + d\phi$ has the size $d\omega =
// \sin\theta\,d\theta\,d\phi$. The ring at the rim is long, the one near the
// normal is short. So a density per solid angle becomes one per angle:
// $p(\theta, \phi) = p(\omega)\,\sin\theta$.
//
// **Inversion.** The random numbers $\xi$ are uniform in $[0, 1)$. To draw
// $\theta$ with a density $p(\theta)$, first sum the density up: the
// *cumulative distribution function* (CDF) $P(\theta) = \int_0^\theta
// p(t)\,dt$ is the probability of an angle below $\theta$. It grows from 0
// to 1. Draw a height $\xi$, and read off the angle where the curve has this
// height: $\theta = P^{-1}(\xi)$. Where the curve is steep, many heights
// lead to nearly the same angle, and there the density is large.
//
// ![](inversion)
//
// ### Uniform in solid angle
//
// The hemisphere has $2\pi$ steradians. If every direction is as likely as
// any other, $p(\omega) = \frac{1}{2\pi}$. In angles this is $\frac{1}{2\pi}
// \sin\theta$, the product of the slide's $p(\theta) = \sin\theta$ and
// $p(\phi) = \frac{1}{2\pi}$. Sum up and invert:
//
// $$P(\theta) = \int_0^\theta \sin t\,dt = 1 - \cos\theta = \xi
// \quad\Rightarrow\quad \cos\theta = 1 - \xi$$
//
// Since $1 - \xi$ is as uniform as $\xi$, the slide has $\theta =
// \arccos\xi$. So $\cos\theta$ *is* $\xi$, and no arccosine is computed: only
// $\cos\theta$ and $\sin\theta = \sqrt{1 - \cos^2\theta}$ are needed. The
// angle $\phi = 2\pi\xi$ takes a random number of its own.
//
// The obvious way is wrong: draw $\theta$ itself uniformly from 0 to $\pi/2$.
// Then the short rings near the normal get as many directions as the long
// ones at the rim.
//
// ![](three-hemispheres)
//
// `sample_uniform_hemisphere` gets a `normal` and two random numbers, `u.x`
// and `u.y`. Compute the direction about the z axis, $(\sin\theta\cos\phi,
// \sin\theta\sin\phi, \cos\theta)$. Then `Basis(normal).to_world(v)` turns it
// so that z becomes the normal. `cos` and `sin` of a `float` are the core's
// own.

// #region uniform-sampling
/// A unit vector about `normal`, with density 1/(2 pi) per solid angle.
/// `u` is uniform in [0, 1)^2. Never below the surface.
inline Vec3 sample_uniform_hemisphere(const Vec3& normal, const Vec2& u) {
  // #region exercise 1.2: uniform hemisphere sampling
  // #stub return normal;
  const float cos_theta = u.x;
  const float sin_theta = std::sqrt(1 - u.x * u.x);
  const float phi = two_pi * u.y;
  return Basis(normal).to_world(
      {sin_theta * cos(phi), sin_theta * sin(phi), cos_theta});
  // #endregion
}

/// Density per solid angle of `sample_uniform_hemisphere`, in 1/sr.
inline float uniform_hemisphere_pdf() {
  return 1 / two_pi;
}
// #endregion uniform-sampling

// ### In proportion to the cosine
//
// The integrand has the factor $\cos\theta$: directions near the horizon
// count for little. Draw fewer of them, with $p(\omega) = \cos\theta/\pi$. In
// angles $p(\theta) = 2\sin\theta\cos\theta$, and
//
// $$P(\theta) = \int_0^\theta 2 \sin t \cos t\,dt = \sin^2\theta = \xi$$
//
// $$\sin\theta = \sqrt{\xi},\qquad \cos\theta = \sqrt{1 - \xi}$$
//
// This is the slide's $\theta = \arccos\sqrt{1 - \xi}$.
//
// Where does the root come from? Look down on the hemisphere once more. Areas
// on the disk are $\cos\theta\,d\omega$, so directions with this density are
// uniform dots *on the disk*. A circle of radius $r$ holds the fraction $r^2$
// of the disk. So $r = \sqrt\xi$ gives uniform dots, and above the disk $r =
// \sin\theta$. This is *Malley's method*.
//
// ![](malley)
//
// `sample_cosine_hemisphere` differs from the uniform one in two lines.

// #region cosine-sampling
/// A unit vector about `normal`, with density cos(theta)/pi per solid angle.
/// `u` is uniform in [0, 1)^2. Never below the surface.
inline Vec3 sample_cosine_hemisphere(const Vec3& normal, const Vec2& u) {
  // #region exercise 1.3: cosine hemisphere sampling
  // #stub return normal;
  const float cos_theta = std::sqrt(1 - u.x);
  const float sin_theta = std::sqrt(u.x);
  const float phi = two_pi * u.y;
  return Basis(normal).to_world(
      {sin_theta * cos(phi), sin_theta * sin(phi), cos_theta});
  // #endregion
}

/// Density per solid angle of `sample_cosine_hemisphere`, in 1/sr.
inline float cosine_hemisphere_pdf(float cos_theta) {
  return cos_theta * inverse_pi;
}
// #endregion cosine-sampling

// ## The weight of a bounce
//
// A bounce multiplies the path by one term of the sum. The slide writes it in
// angles, for uniform and for cosine sampling, and says "Remember to
// simplify":
//
// $$\frac{2\pi L_i f_r \cos\theta_i \sin\theta_i}{\sin\theta_i}
// \qquad
// \frac{2\pi L_i f_r \cos\theta_i \sin\theta_i}
// {2 \sin\theta_i \cos\theta_i}$$
//
// Per solid angle the factor of $L_i$ is $f_r \cos\theta / p$, and most of it
// cancels:
//
// $$\text{uniform:}\quad \frac{k_d}{\pi}\,\cos\theta\,2\pi
// = 2 k_d \cos\theta \qquad
// \text{cosine:}\quad \frac{k_d}{\pi}\,\cos\theta\,\frac{\pi}{\cos\theta}
// = k_d$$
//
// With cosine sampling the weight is a constant. The only thing that is still
// random is $L_i$. Under a sky of one color even that is constant, and every
// single sample is exact. Uniform sampling has the weight $2 k_d \cos\theta$,
// and $\cos\theta$ is uniform in $[0, 1)$. That is the example $2x$ from
// above: a relative error of 58 % in each sample.
//
// ![](uniform-cosine)
//
// `sample` draws a direction, in the way that `sampling` asks for, and gives
// its simplified weight. `surface.normal` is the normal on the side of `wo`.
// The tests compare with `unsimplified_weight`, which the program itself does
// not need.

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
  // #region exercise 1.4: diffuse weight
  // #stub return {surface.normal, Vec3(0)};
  const Vec3& kd = surface.material.kd;
  if (sampling == Sampling::uniform) {
    const Vec3 wi = sample_uniform_hemisphere(surface.normal, u);
    return {wi, 2 * dot(surface.normal, wi) * kd};
  }
  return {sample_cosine_hemisphere(surface.normal, u), kd};
  // #endregion
}
// #endregion weight

// ## Light that a surface emits
//
// A lamp has an emission $k_e$. It shines on the side that its normal points
// to, equally bright in all directions; its back is black.

// #region emitted
/// Radiance that the surface emits towards `wo`.
inline Vec3 emitted(const Surface& surface) {
  const bool front = dot(surface.hit.normal, surface.wo) > 0;
  return front ? surface.material.ke : Vec3(0);
}
// #endregion emitted

// ## The path
//
// Now put the pieces together. The path begins as the camera's ray. At each
// surface it takes one random direction and goes on. Its `throughput` is the
// product of all weights so far: the fraction of the light found here that
// would reach the camera. It starts as 1.
//
// The path ends
//
// - where it leaves the scene. It brings nothing, since outside it is black;
// - at a lamp. It brings the emission times the throughput;
// - after `max_bounces` bounces. It brings nothing.
//
// Why does it end at a lamp, when the equation has $L_e$ *plus* the integral?
// In this course a material either emits or scatters. At a lamp $k_d = 0$, so
// the integral is 0.
//
// ![](one-path)
//
// A real path of the program: a white wall, the red wall, and then the
// ceiling, which is the lamp. The weights are 0.8 and (0.8, 0.2, 0.2), and
// their product is what the path brings.
//
//     $ build/stage1 scenes/cornell_box_ceiling_diffuse.toml
//     > --pixel 60,150 --sample 10
//     ...
//     vertex 0: plane[4] of 'white', bounce 0
//     ...
//       throughput (       1,        1,        1)
//     ...
//     vertex 1: plane[0] of 'red', bounce 1
//     ...
//       throughput (     0.8,      0.8,      0.8)
//     ...
//     vertex 2: plane[3] of 'ceiling', bounce 2
//     ...
//       throughput (    0.64,     0.16,     0.16)
//       adds       (    0.64,     0.16,     0.16)  emission
//     ...
//     radiance of this sample = (0.64, 0.16, 0.16)
//
// The bound makes the mean too dark, since longer paths are missing: with
// $k_d = 0.8$ everywhere, a path still has the throughput $0.8^8 = 0.17$
// after eight bounces.
//
// ![](diffuse-bounces)
//
// A ray that leaves a surface must not hit the same surface again. Its origin
// is rounded, so it may lie a little *below* the surface. Then the wall
// shades itself, in dark spots all over, the famous *shadow acne*.
// `spawn_ray(hit, direction)` makes a ray that knows which surface it leaves.
//
// ![](acne)
//
// `radiance` follows the path. It needs from the core:
//
// - `scene_.nearest_hit(ray)` is a `std::optional<Hit>`, empty where the ray
//   leaves the scene. A hit has a position, a normal and a material.
// - `Surface(*hit, *hit->material, -ray.direction)` is the hit as the path
//   sees it, with `material`, `wo` and the `normal` on the side of `wo`.
// - `surface.material.emits()` says whether it is a lamp.
// - `random.uniform_2d()` draws two uniform numbers. Draw new ones at each
//   bounce.
// - `log_vertex(surface, throughput, Vec3(0), bounce)` tells `--pixel` where
//   the path is. Call it once at each surface, before anything is decided.
//
// The loop counts bounces from 0. With `max_bounces_` 0 the picture shows the
// lamps alone; with 1, what they light directly.

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
    // #region exercise 1.5: path loop
    // #stub return Vec3(0);
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
    // #endregion
  }

 private:
  const Scene& scene_;
  int max_bounces_;
  Sampling sampling_;
};
// #endregion path

// Paint it, and change the number of samples and of bounces:
//
//     make stage1
//     build/stage1 scenes/cornell_box_ceiling_diffuse.toml -o box.png
//
// What remains? A path finds a lamp only by chance. The ceiling is large, so
// it is found soon. A small lamp is found by few paths, and these bring much:
// the picture is full of bright dots. Try
// `scenes/cornell_box_sphere_lamp_diffuse.toml`. Stage 2 mends it.
//
// ![](small-lamp)
//
}  // namespace lightwalk::stage1
