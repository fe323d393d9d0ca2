#pragma once

// # Stage 3: perfect mirrors and glass
//
// So far, light has forgotten at each surface where it came from. A mirror
// does not forget: what arrives from one direction leaves in one direction.
// Glass lets light through, and bends it. This stage adds both, and
// materials that do several of these things at once.
//
// Each way in which a material sends light on is called a *lobe*. Stage 1 had
// one, the diffuse lobe. Now there are three: diffuse, *specular* (the
// mirror), and *refraction* (the glass). At the end of the chapter your
// program paints the left picture:
//
//     make stage3 && build/stage3 scenes/cornell_box_point.toml -o box.png
//
// ![](glass-and-lights)

#include <array>

#include "stages/2_next_event/path_tracer.hpp"

namespace lightwalk::stage3 {

using stage1::BsdfSample;
using stage1::emitted;
using stage2::already_counted;
using stage2::direct_light;

// ## A mirror is the limit of a thin cone
//
// A diffuse bounce draws $\omega_i$ at random. At a perfect mirror this
// fails. Light reaches $\omega_o$ from one direction only, the *mirror
// direction* $\omega_r$, and a random direction is never exactly that one. So
// $f_r$ is 0 in every sample, and the mirror is black.
//
// Begin with a surface that is nearly a mirror. It reflects light from a thin
// cone of directions around $\omega_r$. The cone has the solid angle
// $\varepsilon$. Inside it $f_r$ is a constant, outside it $f_r$ is 0.
//
// ![](mirror-cone)
// How large is the constant? The surface returns the fraction $k_s$ of the
// light. Let $L_i = 1$ from everywhere, as for $k_d/\pi$ in stage 1. Then
// every $\omega_o$ sees the same: its own cone, filled with the radiance 1.
// So the surface sends out $k_s$ in all directions. In a thin cone
// $\cos\theta$ hardly changes, so it can be taken out of the integral:
//
// $$k_s = \int_\Omega f_r \cos\theta\,d\omega = f_r \cos\theta\,\varepsilon
// \quad\Rightarrow\quad f_r = \frac{k_s}{\varepsilon \cos\theta}$$
//
// Cosine sampling finds this cone with the probability $\varepsilon
// \cos\theta / \pi$. For $\varepsilon = 0.001$ that is at most one path in
// 3,142, and for $\varepsilon = 0$ it is none. But we know where the cone is.
// Draw the direction uniformly *in the cone*, with the density
// $p = 1/\varepsilon$:
//
// $$\frac{f_r \cos\theta}{p}
// = \frac{k_s}{\varepsilon\cos\theta}\,\cos\theta\,\varepsilon = k_s$$
//
// Solid angle and cosine cancel. Let $\varepsilon$ go to 0: the cone shrinks
// to $\omega_r$, and the weight stays $k_s$. So a mirror needs no random
// number. Compute $\omega_r$, and multiply by $k_s$.
//
// ## The Dirac delta
//
// In the limit $f_r$ is 0 except in one direction, and its integral stays
// what it was. The name for such a limit is *Dirac delta*,
// $\delta_{\omega_r}$. It is defined by what it does in an integral: $\int
// g(\omega)\, \delta_{\omega_r}(\omega)\,d\omega = g(\omega_r)$. The slide
// "Perfect specular (delta BRDF) sampling" writes the mirror with it, for
// $k_s = 1$:
//
// $$f_r(x, \omega_i, \omega_o) =
// \frac{\delta_{\omega_r}(\omega_i)}{\omega_i \cdot n},
// \qquad p(\omega_r) = 1$$
//
// The delta stands for the cone's $1/\varepsilon$. The 1 is not a density:
// the density grew without bound and canceled. What is left is a
// *probability*. The direction is certain.
//
// The slide "Diffuse and specular BRDFs" has the product of BRDF and cosine.
// A diffuse surface has
// $f_r\,|n \cdot \omega_i| = \frac{k_d}{\pi}\,|n \cdot \omega_i|$. A mirror
// has $f_r\,|n \cdot \omega_i| = 1$ in one direction, and
// $f_r\,|n \cdot \omega_i| = 0$ in all others. This 1 is what the delta
// gives when it is integrated. It is not a value of the delta.
//
// The cosine in the denominator, below the delta, cancels the cosine of the
// rendering equation. So a mirror shows things as bright as they are, at its
// rim as in its middle. If you multiply by the cosine anyway, mirror balls
// get dark rims. If you draw by cosine sampling with the weight $k_s$, the
// ball is not a mirror at all. The last picture has a wrong sign, which the
// next section explains.
//
// ![](mirror-mistakes)
//
// ## The mirror direction
//
// Split `wo` into two parts: the part along the normal,
// $(\omega_o \cdot n)\,n$, and the rest, which lies in the surface. A mirror
// keeps the first part and turns the second around:
//
// $$\begin{aligned} \omega_r
// &= (\omega_o \cdot n)\,n - \big(\omega_o - (\omega_o \cdot n)\,n\big)
// \\ &= 2\,(\omega_o \cdot n)\,n - \omega_o \end{aligned}$$
//
// ![](mirror-parts)
// The slide has $\omega_r = \omega_o - 2n\,(\omega_o \cdot n)$. There
// $\omega_o$ points *at* the surface, as the ray does. Here `wo` points away
// from it, so the sign is the other one. With the slide's sign the ray goes
// on through the mirror.

// #region reflect
/// `wo` mirrored at the normal: both unit vectors, away from the surface.
inline Vec3 reflect(const Vec3& wo, const Vec3& normal) {
  // #region exercise 3.1: mirror direction
  // #stub return normal;
  return 2 * dot(wo, normal) * normal - wo;
  // #endregion
}
// #endregion reflect

// ## Refraction
//
// Light is slower in glass, and so it bends where it enters. The *index of
// refraction* $\eta$ says how much slower: 1 for air, 1.5 for window glass.
// The path goes on behind the surface, in one direction $\omega_t$. So this
// lobe is a delta, too:
//
// $$f_r(x, \omega_i, \omega_o) =
// \frac{\delta_{\omega_t}(\omega_i)}{|\omega_i \cdot n|},
// \qquad p(\omega_t) = 1$$
//
// (So say the slides. A factor is missing, which comes below.) The bars are
// new: behind the surface $\omega_i \cdot n$ is negative. The
// integral of the rendering equation now runs over the whole sphere.
//
// Let $\eta_o$ be the index on the side of `wo`, and $\theta_o$ the angle
// between `wo` and $n$. Let $\eta_i$ be the index behind the surface, and
// $\theta_i$ the angle between $\omega_t$ and $-n$. *Snell's law* (slide
// "Perfect refraction (delta BTDF) sampling") is
//
// $$\eta_i \sin\theta_i = \eta_o \sin\theta_o \quad\Rightarrow\quad
// \sin\theta_i = \frac{\eta_o}{\eta_i} \sin\theta_o$$
//
// ![](refraction-parts)
// Split `wo` as before. The part in the surface, $\omega_o - \cos\theta_o\,
// n$, has the length $\sin\theta_o$. It is turned around, and its length must
// become $\sin\theta_i$, so it is scaled by $\eta_o/\eta_i$. The part along
// the normal points down and has the length $\cos\theta_i$:
//
// $$\omega_t = -\frac{\eta_o}{\eta_i}\,(\omega_o - \cos\theta_o\,n)
// - \cos\theta_i\,n, \qquad \cos\theta_i = \sqrt{1 - \sin^2\theta_i}$$
//
// Rounding may change its length a little, so use `normalize(v)`.
//
// ## Total internal reflection
//
// Follow the path from the camera on. Where it goes *into* glass,
// $\eta_o/\eta_i$ is $1/1.5$, and there is always a $\theta_i$. Where it goes
// *out* the ratio is 1.5. Beyond 41.8 degrees $\sin\theta_o$ is above
// $1/1.5$, and $\sin\theta_i$ would be above 1. No such direction exists.
//
// ![](snell)
// So the path cannot leave. It goes on in the mirror direction and stays in
// the glass: *total internal reflection*. These 41.8 degrees are the
// *critical angle*. An eye in the glass sees everything outside within a
// cone around the normal. The critical angle is its half-angle.
//
// ![](critical-cone)
// A tracer that ends the path there paints black glass. A ball hides this
// mistake. A path that enters it meets the surface from inside at the same
// angle to which it was bent on entering. That is below the critical angle,
// so it gets out. A cube shows the mistake.
//
// ![](cube-mistakes)
// `relative_eta` returns $\eta_o/\eta_i$. The shape's normal,
// `surface.hit.normal`, points outside, where the index is 1. If `wo` is on
// the same side as this normal, the path is outside. Do not use
// `surface.normal`: it is always turned to `wo`, so every path would seem to
// be outside. The index $\eta$ inside is `surface.material.eta`.

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

/// eta_o / eta_i for light that leaves toward `wo`. The shape's own normal
/// points outside, where the index is 1; inside it is the material's.
inline float relative_eta(const Surface& surface) {
  // #region exercise 3.3: inside or outside
  // #stub return 1;
  const bool outside = dot(surface.hit.normal, surface.wo) > 0;
  return outside ? 1 / surface.material.eta : surface.material.eta;
  // #endregion
}
// #endregion refract

// If the two ratios are exchanged, or if every path is outside, rays bend the
// wrong way:
//
// ![](eta-mistakes)
//
// ## What refraction does to radiance
//
// Put the camera in the glass. The hemisphere outside appears in the critical
// cone. The same light comes from fewer directions, so each must bring more
// radiance. A first guess divides the solid angles, $2\pi$ by $2\pi\,(1 -
// \cos 41.8^\circ) = 1.60$. The ratio is 3.93, and it is wrong.
//
// Power counts solid angle *times cosine*, because a tilted beam is spread
// over more surface. Stage 1 has the picture: seen from above, a direction is
// a point on a disk, $\sin\theta$ from the center, and areas on the disk are
// $\cos\theta\,d\omega$. Snell's law multiplies the sine, so it scales the
// disk. The hemisphere fills radius 1 and the area $\pi$. The cone fills
// radius $1/1.5$ and the area $\pi/1.5^2 = \pi/2.25$.
//
// ![](radiance-disks)
// The same holds for each small piece of the disk:
//
// $$\begin{aligned} \cos\theta_i\,d\omega_i
// &= \cos\theta_i \sin\theta_i\,d\theta_i\,d\phi
// = \tfrac{1}{2}\,d(\sin^2\theta_i)\,d\phi \\ &=
// \left(\frac{\eta_o}{\eta_i}\right)^2 \cos\theta_o\,d\omega_o
// \end{aligned}$$
//
// The first step is stage 1's $d\omega$. The last is Snell's law squared,
// $\sin^2\theta_i = (\eta_o/\eta_i)^2 \sin^2\theta_o$, with the same $d\phi$
// on both sides, since nothing turns around the normal. An area of the
// surface passes on the power that it gets, times $k_t$: $L_o
// \cos\theta_o\,d\omega_o = k_t\,L_i \cos\theta_i\,d\omega_i$. Divide (Veach
// 1997, section 5.2):
//
// $$L_o = k_t \left(\frac{\eta_o}{\eta_i}\right)^2 L_i$$
//
// So a lamp looks 2.25 times as bright if the camera alone is in the glass.
// If the lamp alone is in the glass, its radiance is divided by 2.25. If both
// are outside, the path goes in and out, and the factors cancel. The slides
// leave the square out, and are right for this case. Total internal
// reflection stays on one side, so its weight is $k_t$ without the square.
//
// One warning for later. The square belongs to *radiance*, which a path
// carries from the light to the camera. A program that shoots power from the
// lamps, as photon mapping does, must leave it out (Veach 1997, chapter 5).
//
// ![](total-reflection)
//
// ## One path with numbers
//
// This stage will follow *every* lobe at each hit. So the program prints a
// tree, and what comes by a branch is indented. The ball has $k_t = 0.9$ and
// $k_s = 0.1$. At vertex 0 the mirrored branch has the vertices 1 to 3, left
// out here. The refracted one goes on at vertex 4, where it splits again.
// Vertices 5 to 7 are the branch that is mirrored inside the ball, left out,
// too. The refracted branch leaves the ball, and meets the floor at vertex
// 8.
//
//     $ build/stage3 scenes/cornell_box_point.toml --max-bounces 3
//     > --pixel 170,200 --sample 3
//     ...
//     vertex 0: sphere[1] of 'glass', bounce 0
//     ...
//       normal     ( -0.5382,   0.4187,  -0.7315)  the path is outside
//       wo         ( -0.1091,   0.1851,  -0.9766)
//     ...
//       goes on    (  0.2716,  -0.2781,   0.9214)  refraction
//       weight     (     0.4,      0.4,      0.4)  to vertex 4
//     ...
//       vertex 4: sphere[1] of 'glass', bounce 1
//     ...
//         goes on    (  0.4237,  -0.3605,   0.8310)  refraction
//         weight     (   2.025,    2.025,    2.025)  to vertex 8
//     ...
//         vertex 8: plane[2] of 'white', bounce 2
//     ...
//           throughput (    0.81,     0.81,     0.81)
//           light      ( -0.4413,   0.8195,  -0.3656)  at 1.83: reached
//           adds       ( 0.05046,  0.05046,  0.05046)  direct light
//     ...
//     radiance of this sample = (0.06553, 0.05423, 0.05423)
//
// At vertex 0 the dot product of `wo` and the normal is 0.8506, so
// $\sin\theta_o = 0.526$. Snell's law divides it by 1.5: 0.351. The refracted
// direction has $\omega_t \cdot n = -0.937$, and $0.351^2 + 0.937^2 \approx
// 1$. The weight is $0.9/2.25 = 0.4$. On the way out it is $0.9 \cdot 2.25 =
// 2.025$, and the product is 0.81.
//
// The floor has $k_d = 0.8$, and the light the intensity 1. Direct light adds
// $0.81 \cdot (0.8/\pi) \cdot 0.8195 / 1.83^2 = 0.0505$. The rest of the sum,
// 0.0151 in red, comes by the branch that was mirrored at vertex 0.
//
// ## The full BSDF
//
// With refraction the BRDF is called *BSDF*: S is for scattering. One
// material may have all three lobes (slide "The full BSDF"):
//
// $$f_r = k_d\,\frac{1}{\pi}
// + k_s\,\frac{\delta_{\omega_r}(\omega_i)}{n \cdot \omega_i}
// + k_t\,\frac{\delta_{\omega_t}(\omega_i)}{|n \cdot \omega_i|}$$
//
// with $k_d + k_s + k_t \le 1$ in each channel. As on the slides, the last
// term is without $(\eta_o/\eta_i)^2$; `sample` has it.
//
// The slide "Material coefficients" has a fourth, $k_e$: the emission
// $L_e(x, \omega_o)$. Where $k_e > 0$ the other three are 0.
//
// `sample` finds a direction of one lobe, and its weight. It returns stage
// 1's `BsdfSample`, made as `{wi, weight}`. The diffuse lobe is stage 1's own
// `sample(surface, sampling, u)`, with two random numbers `u`. Both functions
// have the same name, so here it is called as `stage1::sample`.

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

// ## Lights, mirrors and glass
//
// Next-event estimation picks a direction to a light. The probability that
// it is exactly $\omega_r$ or $\omega_t$ is 0. So at the two new lobes it
// always returns 0 (slide "Next-event estimation and delta BRDF"). The
// lights are asked for the diffuse lobe alone, and `evaluate` stays
// $k_d/\pi$.
//
// A mirror gets a lamp's light by the path that goes on and hits the lamp.
// "Counted once" asked what happened at the previous vertex. There is a new
// answer: the path left it by a delta lobe. No light was asked for that
// lobe, so the lamp counts. `direct_light_added` is true only after a
// *diffuse* bounce. That also holds for plastic, where the lights were
// asked, but for the diffuse lobe alone.
//
// ![](mirrored-lamps)
// Two things look like bugs, but are not. Under a *point* light a glass ball
// has a shadow, as if it were opaque. The shadow ray goes straight, and the
// glass stops it. Real glass bends the light and gathers it in a bright
// spot, a *caustic*. But a path from the floor through the ball would have
// to hit a point. For the same reason a mirror shows no image of a point
// light.
//
// ![](glass-shadow)
// Under a lamp with an area you see both the caustic and the lamp's image.
// The caustic is noisy: a diffuse bounce must find the lamp through the glass
// by chance.
//
// ## Follow every lobe
//
// Plastic has $k_d, k_s > 0$. Matte walls have only $k_d > 0$, and mirrors
// only $k_s > 0$ (slide "Combining coefficients"). If the path follows one
// lobe only, the light of the other is missing.
//
// ![](plastic-lobes)
// So follow all: one ray for each lobe that has a coefficient. The path
// becomes a tree. Each branch is followed as the whole tree is, so stage 2's
// loop becomes a function, `follow`, that calls itself. The loop's variables
// become its argument, a `Branch`. All branches add to the same `sum`.

// #region branch
/// One branch of the tree, where it begins.
struct Branch {
  Ray ray;
  Vec3 throughput{1};
  int bounce = 0;                   ///< how many bounces lie behind it
  bool direct_light_added = false;  ///< for the lobe that it left by
};

/// No path gets more bounces than this, even if `max_bounces` is larger.
inline constexpr int bounce_limit = 64;
// #endregion branch

// What does the tree cost? Let all surfaces have two lobes, one of them
// diffuse, and count with one light and $b$ bounces. The camera's ray meets
// a surface, and 2, 4, 8 rays follow: together $1 + 2 + \dots + 2^b =
// 2^{b+1} - 1$. Each surface, except in the last row, also sends a shadow
// ray. These are $2^b - 1$ in all. The sum is
//
// $$(2^{b+1} - 1) + (2^b - 1) = 3 \cdot 2^b - 2$$
//
// ![](tree)
// In `scenes/plastic.toml` every surface has two lobes. The program counts a
// little less: some rays leave by the open front, and a light below the
// horizon gets no shadow ray.
//
// ![](tree-counts)
// So with two lobes the bound must be low, 8 or less. Mirrors alone have one
// ray per bounce and no such trouble. For them you can ask for a bound of up
// to 64, `bounce_limit`. It cuts off little: with $k_s = 0.9$ only
// $0.9^{64} = 0.0012$ of the light is still on its way.
//
// ## The path
//
// One turn of stage 2's loop is one call of `follow`. The steps are the
// same, in the same order. A bounce at a mirror counts as a bounce. Only a
// surface whose $k_d$ is not black asks the lights, by stage 2's
// `direct_light(scene_, surface, random)`. The rays of the lobes start by
// `spawn_ray`, on the side that their direction points to. So this also
// works for a ray that goes into the glass.

// #region path
class PathTracer {
 public:
  PathTracer(const Scene& scene, const RenderSettings& settings)
      : scene_(scene),
        max_bounces_(std::min(settings.max_bounces, bounce_limit)),
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
      if (!already_counted(surface, path.direct_light_added)) {
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
// Paint `scenes/mirror_corridor.toml` with `--max-bounces 2`, `4` and `8`:
// how many images of the lamp do you see? Paint `scenes/plastic.toml` with
// `--spp 4` and `--max-bounces 1`, then 2, 3 and so on, and watch the clock.
//
// ![](corridor-bounces)
// Two things remain. The rays double with each bounce, and most carry next to
// nothing. And the bound makes pictures too dark. Stage 4 fixes both.

}  // namespace lightwalk::stage3
