#pragma once

// # Stage 1: diffuse surfaces
//
// A room has a lamp and several walls. A pixel of the picture shows a small
// patch of a wall. Take one point of this patch: what color is it?
//
// Its color is the light that leaves this point toward the camera. The wall
// has no light of its own, so its light came from somewhere else. Some came
// straight from the lamp. The rest came from other walls, and how bright they
// are depends on *their* surroundings.
//
// A *path tracer* follows this chain backwards. It starts at the camera, and
// goes from wall to wall until it meets a lamp. This is one random *path*.
// Then it takes another random path. The mean of many paths is the color of
// the pixel.
//
// ![](wall-and-lamp)
//
// The figure has the names of this book. $n$ is the *normal*, perpendicular
// to the surface at the point $x$. $\omega_o$ points to where light goes out,
// here to the camera, and $\omega_i$ to where light comes in. $\theta$ is the
// angle between $n$ and $\omega_i$.
//
// $n$, $\omega_o$ and $\omega_i$ are unit vectors. In the code `wo` and `wi`
// are $\omega_o$ and $\omega_i$. Both point *away* from the surface,
// whichever way the light goes.
//
// ## The rendering equation
//
// The amount of light along a ray is its *radiance* $L$: power per solid
// angle, and per area that is held perpendicular to the ray, in W/(m² sr). A
// *solid angle* measures a set of directions. It is the area that they cover
// on a sphere of radius 1, in *steradians* (sr). The whole hemisphere above
// a surface has the solid angle $2\pi$.
//
// The *rendering equation* says which radiance leaves $x$ toward $\omega_o$
// (slide "Which color do we fill each pixel with?"):
//
// $$L_o(x, \omega_o) = L_e(x, \omega_o) + \int_\Omega L_i(x, \omega_i)\,
// f_r(x, \omega_i, \omega_o)\,|n \cdot \omega_i|\,d\omega_i$$
//
// - $L_o$ is the radiance that goes out. It is what we want.
// - $L_e$ is what the surface emits by itself. Only lamps have it.
// - $L_i$ is the radiance that arrives at $x$ from the direction $\omega_i$.
// - $f_r$ is the *BRDF*, the bidirectional reflectance distribution function.
//   It says how much of the light from $\omega_i$ leaves toward $\omega_o$.
// - $|n \cdot \omega_i|$ is $\cos\theta$. Light that comes in at a slant is
//   spread over more area.
// - The integral adds up the directions of the hemisphere $\Omega$ above the
//   surface.
//
// ![](hemisphere)
//
// The equation holds for red, green and blue separately. So a radiance is a
// `Vec3`, three numbers in the order RGB. The product of two `Vec3`
// multiplies red by red, green by green and blue by blue. A `float` times a
// `Vec3` multiplies all three. (An `int` does not: write `2.0f`, or multiply
// floats first.)
//
// ## The equation contains itself
//
// Everything on the right is known, except $L_i$. What arrives at $x$ from
// $\omega_i$? Follow this direction to the next surface, to its point $y$. In
// clear air radiance does not change along a ray. So what arrives at $x$ is
// what has left $y$, in the opposite direction:
//
// $$L_i(x, \omega_i) = L_o(y, -\omega_i)$$
//
// The equation is recursive: $L_o$ at $x$ needs $L_o$ at $y$, and that needs
// $L_o$ at further points.
//
// The obvious way is to try, say, 100 directions at each surface. Then there
// are 100 rays after one bounce, 10,000 after two, and $100^8 = 10^{16}$
// after eight. Nobody can wait for that.
//
// So a path takes **one random direction at each surface**. A single path is
// wrong, but the mean of many is right. The next sections say why, and how to
// choose the direction.
//
// ![](grid-or-path)
//
// Who makes the first ray? The *core* does, the code in `common/` that is
// given to you. The camera is in `common/scene/camera.hpp`. For each sample
// it takes a random point in the pixel, and the ray from the camera through
// that point. This chapter answers what radiance comes back along it.

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
// The material has an *albedo* $k_d$ between 0 and 1, the fraction of the
// power that it gives back. It is an RGB color too: the red wall has (0.8,
// 0.2, 0.2).
//
// Suppose the same radiance $L_i = 1$ arrives from every direction. The
// surface gives back the fraction $k_d$ of the power. The light leaves
// equally in all directions, just as it has arrived. So power is the same
// multiple of radiance both times. The surface sends out the radiance $k_d$.
// Put this into the equation. The constant comes out of the integral:
//
// $$k_d = \int_\Omega 1 \cdot f_r \cos\theta\,d\omega
// = f_r \int_\Omega \cos\theta\,d\omega = f_r\,\pi$$
//
// Why is the last integral $\pi$? Take the hemisphere with radius 1, and a
// small patch $d\omega$ on it. The patch is tilted by $\theta$, so its shadow
// on the ground, straight below, has the area $\cos\theta\,d\omega$. All
// shadows together cover a disk of radius 1 once, and its area is $\pi$.
//
// ![](disk)
//
// So the BRDF is (slide "Diffuse and specular BRDFs")
//
// $$f_r = \frac{k_d}{\pi}$$
//
// A common mistake is $f_r = k_d$. The wall then gives back $\pi k_d$ of the
// light it got. For $k_d = 0.8$ that is 2.5 times as much. Wherever $k_d$ is
// above $1/\pi = 0.32$, each bounce makes light from nothing.
//
// ![](no-pi)
//
// `evaluate` returns the BRDF. The albedo is `material.kd`, and the core has
// the constants `pi`, `two_pi` and `inverse_pi`, which is $1/\pi$. (In the
// header, comments that begin with a # and a word are marks for the book and
// the handouts. Skip them.)
//
// Below, the weight of a sample is simplified until no $f_r$ is left in it.
// So your own picture will not show a mistake in `evaluate`, but the tests
// will find it. (For the figure above, the weight was wrong, too.)

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
// The integral is over infinitely many directions, and a ray asks only one.
// *Monte Carlo integration* asks a few random ones and takes the mean.
//
// Start in one dimension, on an interval of length 1. The integral of
// $f(x) = 2x$ from 0 to 1 is 1. Draw
// four uniform random numbers, say 0.1, 0.3, 0.6 and 0.9. There $f$ is 0.2,
// 0.6, 1.2 and 1.8. The mean is 0.95, and 5 % too small. Four other numbers
// would give another mean.
//
// How far off is one sample? The *variance* $\sigma^2$ is the mean of its
// squared error. Here it is $\int_0^1 (2x - 1)^2\,dx = 1/3$. Its root is the
// *standard deviation* $\sigma = 0.58$, a typical error. In a picture this
// error is called *noise*.
//
// ![](four-numbers)
//
// How far off is the mean of $N$ samples? The variances of independent
// numbers add up, so their sum has the variance $N\sigma^2$. The mean is the
// sum divided by $N$, and that divides the variance by $N^2$:
//
// $$\frac{N\sigma^2}{N^2} = \frac{\sigma^2}{N},
// \qquad\text{a standard deviation of } \frac{\sigma}{\sqrt N}$$
//
// For four numbers it is 0.29. To halve the noise, take four times the
// samples. The option `--spp` says how many samples a pixel gets.
//
// ![](samples)
//
// ## Importance sampling
//
// Random numbers need not be uniform. The *probability density* $p(x)$, or
// *pdf*, says how often $x$ is drawn: a number between $x$ and $x + dx$ has
// the probability $p(x)\,dx$. Then the *Monte Carlo estimator* is
//
// $$\int_a^b f(x)\,dx \approx
// \frac{1}{N} \sum_{i=1}^N \frac{f(x_i)}{p(x_i)}$$
//
// The division by $p$ repairs the choice: a value that is drawn twice as
// often counts half. So the mean of $f/p$ is right, whatever $p$ is:
//
// $$\int_a^b \frac{f(x)}{p(x)}\,p(x)\,dx = \int_a^b f(x)\,dx$$
//
// Such an estimator is called *unbiased*. The one condition is that $p$ is
// above 0 wherever $f$ is not 0. (The BRDF of a mirror is not an ordinary
// function. Stage 3 will need another way.)
//
// Now draw $x$ with the density $p(x) = 2x$, as in the right half of the
// figure with the four numbers. Then $f/p$ is 1 for every sample. One sample
// is exact, and the variance is 0. If $p$ has the same shape as $f$, fewer
// samples are needed. This is *importance sampling*.
//
// Over directions it is the same estimator:
//
// $$\int_\Omega f(\omega)\,d\omega \approx
// \frac{1}{N} \sum_{i=1}^N \frac{f(\omega_i)}{p(\omega_i)}$$
//
// A path uses $N = 1$ at each bounce: one random direction (slide
// "Approximating one integral"). The mean is taken over the many paths of a
// pixel.
//
// ## Drawing a direction
//
// A direction has two angles: $\theta$ from the normal, and $\phi$ around it.
// A computer draws numbers $\xi$ that are uniform in $[0, 1)$.
//
// The obvious way is $\theta = \xi_1\,\pi/2$ and $\phi = 2\pi\xi_2$. It is
// wrong. The ring of directions at an angle $\theta$ has the radius
// $\sin\theta$: it is short near the normal, and long at the horizon. A
// uniform $\theta$ gives all rings equally many directions. So they crowd
// around the normal, as in the left column.
//
// ![](three-hemispheres)
//
// The slide "Sampling directions" has the right densities for the two angles.
// Where do they come from, and how does one draw from them?
//
// **From solid angle to angles.** A small patch of the hemisphere is
// $d\theta$ high and $\sin\theta\,d\phi$ wide. So its solid angle is
// $d\omega = \sin\theta\,d\theta\,d\phi$. A direction falls into it with the
// probability $p(\omega)\,d\omega$, and so the density of the two angles is
// $p(\theta, \phi) = p(\omega)\,\sin\theta$.
//
// **Inversion sampling.** Let $P(\theta)$ be the probability of an angle
// below $\theta$. It is called the *cumulative distribution function*, CDF:
//
// $$P(\theta) = \int_0^\theta p(t)\,dt$$
//
// Its curve grows from 0 to 1. Draw a uniform height $\xi$, go right to the
// curve, and read off the angle below: $\theta = P^{-1}(\xi)$. Where the
// curve is steep, many heights lead to nearly the same angle. It is steep
// where the density $p$ is large, so large densities get many samples.
//
// ![](inversion)
//
// ### Uniform in solid angle
//
// The hemisphere has $2\pi$ steradians. If all directions are equally likely,
// $p(\omega) = \frac{1}{2\pi}$. For the angles this is $\frac{1}{2\pi}
// \sin\theta$. It is the product of the slide's $p(\theta) =
// \sin\theta$ and $p(\phi) = \frac{1}{2\pi}$. So the two angles are
// independent, and each is drawn on its own. Integrate the first and invert
// it:
//
// $$P(\theta) = \int_0^\theta \sin t\,dt = 1 - \cos\theta = \xi
// \quad\Rightarrow\quad \cos\theta = 1 - \xi$$
//
// This is the curve of the figure above. $1 - \xi$ is as uniform as $\xi$, so
// the slide has $\theta = \arccos\xi$. Then $\cos\theta$ *is* $\xi$, and no
// arccosine is computed. The sine follows from
// $\sin\theta = \sqrt{1 - \cos^2\theta}$. The other angle is uniform,
// $\phi = 2\pi\xi$, with a random number of its own.
//
// `sample_uniform_hemisphere` gets a `normal` and two independent random
// numbers, `u.x` and `u.y`. Compute the direction as if the normal were the z
// axis: $(\sin\theta\cos\phi, \sin\theta\sin\phi, \cos\theta)$. Then turn it.
// `Basis(normal)` makes three perpendicular axes, the third of which is the
// normal. Its `to_world(v)` takes the three coordinates along these axes, and
// gives the vector in the room. `cos(phi)` and `sin(phi)` are the core's own
// and take radians, and the root is `std::sqrt`.

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
// The integrand has the factor $\cos\theta$. Directions near the horizon
// count for little. Uniform sampling takes half of its directions where the
// cosine is below 0.5, and a quarter of the light comes from there.
// Importance sampling draws fewer of them, with a density in proportion to
// the cosine. Since the cosine integrates to $\pi$, this density is
// $p(\omega) = \cos\theta/\pi$. For the angles it is
//
// $$\frac{\cos\theta}{\pi}\,\sin\theta
// = 2\sin\theta\cos\theta \cdot \frac{1}{2\pi},$$
//
// the product of the slide's $p(\theta) = 2\sin\theta\cos\theta$ and the same
// $p(\phi)$ as before. Again, integrate and invert:
//
// $$P(\theta) = \int_0^\theta 2 \sin t \cos t\,dt = \sin^2\theta = \xi$$
//
// $$\sin\theta = \sqrt{\xi},\qquad \cos\theta = \sqrt{1 - \xi}$$
//
// This is the slide's $\theta = \arccos\sqrt{1 - \xi}$.
//
// Where does the root come from? The shadow of a patch on the disk has the
// area $\cos\theta\,d\omega$. So directions with this density have shadows
// that are uniform *on the disk*. Now a circle of radius $r$ holds the
// fraction $r^2$ of the disk. Points are uniform if $r^2 = \xi$, so $r =
// \sqrt\xi$, and $r$ is $\sin\theta$. Draw a point on the disk and lift it
// onto the hemisphere: this is *Malley's method*.
//
// ![](malley)
//
// `sample_cosine_hemisphere` differs from the uniform one in two lines.
// `uniform_hemisphere_pdf` and `cosine_hemisphere_pdf` give the densities.
// Only the tests call them.

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
// Put the BRDF and a random direction into the equation, with $N = 1$. The
// light $L_i$ is then multiplied by one factor, the *weight* of the bounce.
// The slide writes the whole term in angles, for uniform and for cosine
// sampling. There $d\omega = \sin\theta\,d\theta\,d\phi$ brings a sine,
// below stands $p(\theta)$, and the $2\pi$ is $1/p(\phi)$. It says "Remember
// to simplify":
//
// $$\frac{2\pi L_i f_r \cos\theta_i \sin\theta_i}{\sin\theta_i}
// \qquad
// \frac{2\pi L_i f_r \cos\theta_i \sin\theta_i}
// {2 \sin\theta_i \cos\theta_i}$$
//
// The $\sin\theta_i$ in the numerator and in the denominator cancel. So the
// weight is $f_r \cos\theta / p$, with $p$ per solid angle, and more cancels:
//
// $$\text{uniform:}\quad \frac{k_d}{\pi}\,\cos\theta\,2\pi
// = 2 k_d \cos\theta$$
//
// $$\text{cosine:}\quad \frac{k_d}{\pi}\,\cos\theta\,\frac{\pi}{\cos\theta}
// = k_d$$
//
// With cosine sampling nothing random is left in the weight. Only $L_i$ is
// still random. And nothing is divided by a $\cos\theta$ that is nearly 0.
//
// How much does that save? Think of a lamp that fills the whole hemisphere,
// with $L_i = 1$ everywhere. With cosine sampling every sample is $k_d$, and
// the variance is 0. With uniform sampling a sample is $2 k_d \cos\theta$,
// and $\cos\theta$ is a uniform number. That is $k_d$ times the example $2x$.
// The variance is $k_d^2/3$, so each sample has a relative error of 58 %.
//
// ![](uniform-cosine)
//
// When your program runs, try it with `--sampling uniform`, the option of the
// left picture. The weight also shows why it was wrong to draw a uniform
// $\theta$. The mean of $\cos\theta$ should be 1/2, but over a uniform
// $\theta$ it is $2/\pi = 0.64$. The mean weight is then not $k_d$ but
// $4 k_d/\pi = 1.27\,k_d$, at every bounce. More samples do not help,
// because this error is not noise.
//
// ![](theta-uniform)
//
// `sample` draws a direction in the way that `sampling` asks for,
// `Sampling::uniform` or `Sampling::cosine`. It returns the direction and its
// simplified weight. It gets a `Surface`: the hit as the path sees it. Its
// `material` has the albedo `kd`. Its `normal` is on the side that the path
// comes from. A vector is multiplied by a `float` and not by an `int`: write
// `2.0f * v`, not `2 * v`.
//
// The tests compare the weights with `unsimplified_weight`, which the program
// itself does not call.

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

/// A direction on the side of `surface.wo`, and its weight with all that
/// cancels left out. `u` is uniform in [0, 1)^2.
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
// A lamp has an emission $k_e$, a radiance. It shines on the side that its
// normal points to, and its back is black. On the front it has the same
// radiance in all directions. There is no cosine here.
//
// A shape has one normal, `surface.hit.normal`, which may point to either
// side. `surface.normal` is turned, if needed, to the side of `wo`. So only
// `surface.hit.normal` tells front from back.
//
// ![](lamp-front)

// #region emitted
/// Radiance that the surface emits toward `surface.wo`.
inline Vec3 emitted(const Surface& surface) {
  const bool front = dot(surface.hit.normal, surface.wo) > 0;
  return front ? surface.material.ke : Vec3(0);
}
// #endregion emitted

// ## The path
//
// Now put the pieces together. With one direction at each surface the
// recursion is a chain: $L_o$ is the weight times the next $L_o$. So a path
// that meets a lamp after two bounces brings
//
// $$\text{weight}_0 \cdot \text{weight}_1 \cdot L_e$$
//
// The path begins as the camera's ray. At each surface it takes one random
// direction and goes on; `throughput` is the product of the weights so far.
// It starts as 1. If the path finds light, that light times the throughput
// is what reaches the camera.
//
// The path ends
//
// - where it leaves the scene. It brings nothing, since all is black outside;
// - at a lamp. It brings the emission times the throughput;
// - after `max_bounces` bounces. It brings nothing.
//
// Why does it end at a lamp, when the equation has $L_e$ *plus* the integral?
// In this course a material either emits or scatters, and the core refuses a
// scene where one does both. At a lamp $k_d = 0$, so the integral is 0.
//
// Here is a path of the program, printed by the options `--pixel` and
// `--sample`. It meets the white floor, the red wall, and then the ceiling,
// which is the lamp and emits (1, 1, 1). The weights are (0.8, 0.8, 0.8) and
// (0.8, 0.2, 0.2). Their product is what the path brings: light that has
// turned red at the wall.
//
// ![](followed-path)
//
//     $ build/stage1 scenes/cornell_box_ceiling_diffuse.toml
//     > --pixel 70,240 --sample 8
//     ...
//     vertex 0: plane[2] of 'white', bounce 0
//     ...
//       throughput (       1,        1,        1)
//     ...
//       weight     (     0.8,      0.8,      0.8)
//
//     vertex 1: plane[0] of 'red', bounce 1
//     ...
//       throughput (     0.8,      0.8,      0.8)
//     ...
//       weight     (     0.8,      0.2,      0.2)
//
//     vertex 2: plane[3] of 'ceiling', bounce 2
//     ...
//       throughput (    0.64,     0.16,     0.16)
//       adds       (    0.64,     0.16,     0.16)  emission
//     ...
//     radiance of this sample = (0.64, 0.16, 0.16)
//
// Other samples of the same pixel go other ways. One goes from the floor
// straight to the ceiling. Another meets no lamp within eight bounces and
// brings nothing. The pixel gets the mean of them all.
//
//     $ build/stage1 scenes/cornell_box_ceiling_diffuse.toml
//     > --pixel 70,240 --sample 0
//     ...
//     vertex 1: plane[3] of 'ceiling', bounce 1
//     ...
//     radiance of this sample = (0.8, 0.8, 0.8)
//     $ build/stage1 scenes/cornell_box_ceiling_diffuse.toml
//     > --pixel 70,240 --sample 6
//     ...
//       ends       at the bound of 8 bounces
//     radiance of this sample = (0, 0, 0)
//
// ### How many bounces?
//
// A *bounce* is one scattering at a surface. With `--max-bounces 0` the
// picture shows the lamps alone. With 1 it also shows what they light
// directly. Each further bounce adds light that was scattered once more.
// The default bound is 8.
//
// The bound makes the picture too dark, because longer paths are missing.
// Such an error is a *bias*, and more samples do not remove it. With
// $k_d = 0.8$ everywhere, a path still has the throughput $0.8^8 = 0.17$
// after eight bounces. Stage 4 will do without the bound.
//
// ![](diffuse-bounces)
//
// ### Leaving a surface
//
// The next ray starts where the path is, and must not hit the same surface
// at once. But the computed position is rounded, so it may lie a little
// *below* the surface. Then the next ray hits the wall that it has just
// left: a false bounce, and the wall has dark spots all over. This is
// *shadow acne*.
//
// `spawn_ray(hit, direction)` prevents it. It makes the ray that leaves the
// surface at `hit` in the unit vector `direction`. The ray starts a little
// off the surface and knows which shape it leaves.
//
// ![](acne)
//
// ### The loop
//
// `radiance` follows the path. It has the members `scene_`, `max_bounces_`
// and `sampling_`, and needs from the core:
//
// - `scene_.nearest_hit(ray)` gives a `std::optional<Hit>`, the first surface
//   on the ray. It is empty where the ray leaves the scene. After
//   `const auto hit = scene_.nearest_hit(ray);` ask `if (!hit)` whether it is
//   empty. If it is not, `*hit` is the `Hit`, and `hit->position` is one of
//   its members.
// - `Surface(*hit, *hit->material, -ray.direction)` is the hit as the path
//   sees it. The last argument becomes `wo`.
// - `surface.material.emits()` says whether it is a lamp.
// - `random.uniform_2d()` draws two independent uniform numbers, a `Vec2`.
//   Draw new ones at each bounce.
// - `log_vertex(surface, throughput, Vec3(0), bounce)` tells `--pixel` where
//   the path is, and changes nothing. Call it once at each surface, before
//   anything is decided. Its third value is the light that was added before,
//   here none yet. The program works out weights and emission by itself.
//
// Count the bounces from 0. After the test for a lamp the path ends if their
// number *is* `max_bounces_`. So a lamp that the last bounce leads to still
// counts, and with a bound of 0 there is no bounce at all.

// #region path
class PathTracer {
 public:
  PathTracer(const Scene& scene, const RenderSettings& settings)
      : scene_(scene),
        max_bounces_(settings.max_bounces),
        sampling_(settings.sampling) {}

  /// Radiance that comes back along the ray, as one path sees it. Its mean
  /// over many paths solves the rendering equation, except for light of more
  /// than `max_bounces` bounces.
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

// Build it and paint the box:
//
//     make stage1
//     build/stage1 scenes/cornell_box_ceiling_diffuse.toml -o box.png
//
// Then change one thing at a time: `--spp 4`, `--sampling uniform`,
// `--max-bounces 1`. The figures above show what to expect.
//
// What remains? A path finds a lamp only by chance. The ceiling is large, so
// it is found soon. A small lamp is found by few paths, and each of these
// brings much: the picture is full of bright dots. Its mean radiance is
// right. But the screen cannot show a dot brighter than white, so the
// picture looks too dark. Try `scenes/cornell_box_sphere_lamp_diffuse.toml`.
// Stage 2 fixes it.
//
// ![](small-lamp)
//
}  // namespace lightwalk::stage1
