#pragma once

// # Stage 5: Fresnel and textures
//
// So far, a material has been the same everywhere. Real materials are not. A
// floor has tiles, a globe has countries. A window reflects the sky if you
// look along it, and hardly anything if you look straight through. The
// rendering equation has always allowed this: $f_r(x, \omega_i, \omega_o)$
// depends on the place $x$ and on the direction of view $\omega_o$. So
// before a surface is used, ask for its material at $x$, seen from
// $\omega_o$. Nothing else changes.
//
// ![](floor)
//
#include "common/image/srgb.hpp"
#include "stages/4_russian_roulette/path_tracer.hpp"

namespace lightwalk::stage5 {

using stage1::BsdfSample;
using stage1::emitted;
using stage2::already_counted;
using stage2::direct_light;
using stage3::Lobe;
using stage3::relative_eta;
using stage3::sample;
using stage4::choose_lobe;
using stage4::lobe_probabilities;
using stage4::LobeChoice;

// ## How much glass reflects
//
// In stage 3 glass reflected a fixed fraction at every angle. The surface of
// real glass reflects 4 % when you look straight at it, and nearly
// everything when you look along it, at a *grazing* angle. One word in the
// scene file asks for that (`eta` is 1.5 by default):
//
//     fixed   = { ks = 0.1, kt = 0.9 }
//     fresnel = { ks = 1, kt = 1, fresnel = true }
//
// (Here $k_s + k_t$ may be 2, since Fresnel's equations will share the light
// out between the two.) Look at both balls before you read the caption, at
// their middle and at their rim. Which one is glass?
//
// ![](fresnel-or-fixed)
//
// How much is reflected depends on how the light swings. Light is a wave that
// swings across its direction. The *plane of incidence* is the plane that
// holds the ray and the normal. Light that swings perpendicular to this plane
// is called *s-polarized*, light that swings within it *p-polarized*. Glass
// reflects more of the first than of the second.
//
// ![](polarization)
//
// The *Fresnel equations* give the amplitude of each after reflection, if it
// was 1 before. Where it is negative, the wave is turned over. They follow
// from Maxwell's equations (pbrt, 4th edition, section 9.3.5). With the
// angles and indices of stage 3:
//
// $$r_s = \frac{\eta_o\cos\theta_o - \eta_i\cos\theta_i}
// {\eta_o\cos\theta_o + \eta_i\cos\theta_i}, \quad
// r_p = \frac{\eta_i\cos\theta_o - \eta_o\cos\theta_i}
// {\eta_i\cos\theta_o + \eta_o\cos\theta_i}$$
//
// Power goes with the square of the amplitude. Light from the sun or a lamp
// is *unpolarized*: half of each. So the reflected fraction is
//
// $$F = \tfrac12 (r_s^2 + r_p^2)$$
//
// Reflected light is partly polarized afterwards. This program forgets that
// between two hits, as nearly all renderers do.
//
// Check the formula where you know the answer:
//
// - Straight on, all cosines are 1. Then $F = \big(\frac{\eta_o -
//   \eta_i}{\eta_o + \eta_i}\big)^2 = (0.5/2.5)^2 = 0.04$ for glass, from
//   either side.
// - At a grazing angle $\cos\theta_o$ goes to 0. Then $r_s$ and $r_p$ both go
//   to $-1$, and $F$ to 1.
// - Inside glass beyond 41.8 degrees there is no $\theta_i$. All is
//   reflected: $F = 1$.
// - $r_p$ is 0 where $\eta_i\cos\theta_o = \eta_o\cos\theta_i$. Multiply by
//   Snell's law, $\eta_o\sin\theta_o = \eta_i\sin\theta_i$: then
//   $\sin 2\theta_o = \sin 2\theta_i$. The angles differ, so
//   $\theta_o + \theta_i$ is 90 degrees. Then $\cos\theta_i = \sin\theta_o$,
//   and $\tan\theta_o = \eta_i/\eta_o$.
//
// The last one is *Brewster's angle*. Only s-polarized light is reflected
// there. For glass of 1.5 it is 56.3 degrees from outside, and 33.7 from
// inside. For a lake, with an index of 1.33, it is 53.1. Sunglasses that
// block s-polarized light block the glare of the lake.
//
// ![](fresnel-curves)
//
// `fresnel_reflectance` gets $\cos\theta_o$ and the ratio $\eta_o/\eta_i$
// only. So divide both fractions above and below by $\eta_i$. In these two
// lines $\eta$ is this ratio, `eta_ratio` in the code:
//
// $$r_s = \frac{\eta\cos\theta_o - \cos\theta_i}
// {\eta\cos\theta_o + \cos\theta_i}
// \qquad
// r_p = \frac{\cos\theta_o - \eta\cos\theta_i}
// {\cos\theta_o + \eta\cos\theta_i}
// \qquad \eta = \frac{\eta_o}{\eta_i}$$
//
// The cosine $\cos\theta_i$ comes from Snell's law as in stage 3. If
// $\sin^2\theta_i$ is 1 or more, return 1 before you take the root.
//
// > *NaN.* The root of a negative number is a NaN, a value that is "not a
// > number", and it spoils every sum that it enters.

// #region fresnel
/// The share of unpolarized light that is reflected, 0 to 1. `cos_o` >= 0 is
/// the cosine between the normal and wo, on the side of wo; `eta_ratio` is
/// eta_o / eta_i. The same for both directions of one ray.
inline float fresnel_reflectance(float cos_o, float eta_ratio) {
  // #region exercise 5.1: Fresnel reflectance
  // #stub return 0;
  const float sin2_o = std::max(0.0f, 1 - cos_o * cos_o);
  const float sin2_i = eta_ratio * eta_ratio * sin2_o;
  if (sin2_i >= 1) return 1;
  const float cos_i = std::sqrt(1 - sin2_i);
  const float r_s = (eta_ratio * cos_o - cos_i) / (eta_ratio * cos_o + cos_i);
  const float r_p = (cos_o - eta_ratio * cos_i) / (cos_o + eta_ratio * cos_i);
  return (r_s * r_s + r_p * r_p) / 2;
  // #endregion
}
// #endregion fresnel

// ## Where on the surface
//
// An image that is wrapped around a shape is a *texture*. In a scene file it
// stands where a number could stand:
//
//     marble = { kd = { image = "textures/marble.png" } }
//
// To look up a color we need two coordinates on the shape: $u$ to the right
// and $v$ upwards in the image, each from 0 to 1.
//
// ![](uv)
//
// - A *rectangle* and a *triangle* have them along their edges. Their
//   `coordinates` returns both for a position, and is given.
// - A *plane* has no edges. There $v$ runs up: +y on a wall, +z on a floor or
//   a ceiling. `plane_coordinates` subtracts from "up" its part along the
//   normal. Then $u = n \times v$ runs to the right for someone who looks at
//   the front of the wall. (It does so because the lab's axes are
//   left-handed: in its picture x runs to the right, y up, and z away from
//   the eye.) One image covers one unit.
// - A *sphere* is a globe, with its poles up and down. The longitude gives
//   $u$, and the middle of the image looks to -z, where the lab's camera
//   stands. The latitude gives $v$, from the south pole to the north pole.
//
// Write the case for a sphere. Its unit normal $n$ is `hit.normal`. It
// points from the center to the hit, so it does not change when the ball is
// moved. Seen from above, the longitude is the angle from -z to $n$. It is
// `std::atan2(n.x, -n.z)`, from $-\pi$ to $\pi$, and becomes $u = 0.5 +
// \text{longitude}/2\pi$. The angle from the south pole is $\arccos(-n_y)$,
// by `std::acos`, and divided by $\pi$ it is $v$. Take $-n_y$ as
// `glm::clamp(-n.y, -1.0f, 1.0f)`.
//
// > *Rounding.* It may make $-n_y$ slightly larger than 1, and its arccosine
// > a NaN.
//
// The constants $\pi$ and $2\pi$ are `pi` and `two_pi`.

// #region texture-coordinates
/// (u, v) on a plane with this unit normal.
inline Vec2 plane_coordinates(const Vec3& normal, const Vec3& position) {
  const bool is_level = std::abs(normal.x) + std::abs(normal.z) < 1e-4f;
  const Vec3 up = is_level ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
  const Vec3 v = normalize(up - dot(up, normal) * normal);
  const Vec3 u = cross(normal, v);
  return {dot(u, position), dot(v, position)};
}

/// (u, v) of a hit. In [0, 1]^2 except for planes, which have no end.
inline Vec2 texture_coordinates(const Scene& scene, const Hit& hit) {
  const Geometry& shapes = scene.geometry;
  switch (hit.shape_type) {
    case ShapeType::plane:
      return plane_coordinates(hit.normal, hit.position);
    case ShapeType::sphere: {
      // #region exercise 5.2: coordinates on a sphere
      // #stub return Vec2(0);
      const Vec3& n = hit.normal;
      const float longitude = std::atan2(n.x, -n.z);
      const float from_south = std::acos(glm::clamp(-n.y, -1.0f, 1.0f));
      return {0.5f + longitude / two_pi, from_south / pi};
      // #endregion
    }
    case ShapeType::rectangle:
      return shapes.rectangles()[hit.shape_index].coordinates(hit.position);
    default:
      return shapes.triangles()[hit.shape_index].coordinates(hit.position);
  }
}
// #endregion texture-coordinates

// A map shows at once if $u$ or $v$ is wrong:
//
// ![](globe-mistakes)
//
// ## Reading an image
//
// A pixel of a texture is a *texel*. Its three bytes are not proportional to
// light. They are encoded by the *sRGB* curve. It spends most of the 256
// steps on dark colors, where the eye sees small differences. A byte $b$
// stands for the light
//
// $$\Big(\frac{b/255 + 0.055}{1.055}\Big)^{2.4}$$
//
// If $b$ is below 11 it is $b/255/12.92$ instead (IEC 61966-2-1). So byte 188
// is half as bright as 255. `srgb_to_linear` has this curve.
//
// ![](srgb-curve)
//
// Light can be mixed, bytes cannot. So `texel` decodes each byte before
// anything else happens. If you forget it, byte 188 counts as 0.74, and every
// texture looks pale.
//
// ![](texture-mistakes)
//
// The color of a texel is the color at its *center*, half a texel from its
// edge. What is the color elsewhere? The obvious answer is that of the
// nearest center. Then each texel becomes a square, and from near you see its
// edges.
//
// ![](texel-edges)
//
// The cure is *bilinear interpolation*: the color is mixed from the four
// nearest centers, and a center counts more the nearer it is.
//
// ![](bilinear)
//
// First find the point among the texels. Counted from the center of the first
// one it is at
//
// $$x = u \cdot \text{width} - 0.5 \qquad
// y = (1 - v) \cdot \text{height} - 0.5$$
//
// The $0.5$ is there because the first center is half a texel from the edge.
// The $1 - v$ is there because row 0 of an image is at the top. The whole
// part of $x$ is the column on the left. The rest is the weight of the column
// on the right. The same holds for $y$, with the upper and the lower row.
//
// Outside of 0 to 1 the image repeats: only the fraction of $u$ and $v$
// counts, `uv.x - std::floor(uv.x)`. But $v$ must not repeat on a globe, or
// the colors of one pole would be mixed into the other. So if `has_poles`,
// take $v$ as it is, and clamp $y$ to the range from 0 to height - 1 before
// you split it.
//
// Write `image_color`. The size of the image in texels is `texture.width` and
// `texture.height`. Both are `int`: convert them once, as in
// `static_cast<float>(texture.width)`. Take the whole parts with
// `std::floor`, since a cast alone would round -0.5 up to 0. Then cast them
// to `int`.
//
// `texel(texture, column, row)` is given. It returns the decoded color, and
// repeats columns and rows by itself: one column beyond the last is the
// first. This closes the seam of the globe, where $u$ jumps from 1 to 0. (At
// a pole the row beyond the last has the weight 0.) `glm::mix(a, b, weight)`
// is $a$ where the weight is 0, and $b$ where it is 1. You need it three
// times.

// #region image
/// The texel's color, linear, 0 to 1. Columns and rows repeat.
inline Vec3 texel(const Texture& texture, int column, int row) {
  const auto repeat = [](int i, int size) {
    return ((i % size) + size) % size;
  };
  const auto& bytes =
      texture.at(repeat(column, texture.width), repeat(row, texture.height));
  return {srgb_to_linear(bytes[0]), srgb_to_linear(bytes[1]),
          srgb_to_linear(bytes[2])};
}

/// The image's color at (u, v), between texels mixed. v = 0 is the lower
/// edge. `has_poles` keeps v from repeating.
inline Vec3 image_color(const Texture& texture, const Vec2& uv,
                        bool has_poles) {
  // #region exercise 5.3: reading an image
  // #stub return Vec3(0);
  const auto width = static_cast<float>(texture.width);
  const auto height = static_cast<float>(texture.height);
  const float x = (uv.x - std::floor(uv.x)) * width - 0.5f;
  const float v = has_poles ? uv.y : uv.y - std::floor(uv.y);
  float y = (1 - v) * height - 0.5f;
  if (has_poles) y = glm::clamp(y, 0.0f, height - 1);
  const float left = std::floor(x), top = std::floor(y);
  const int column = static_cast<int>(left), row = static_cast<int>(top);
  const Vec3 upper = glm::mix(texel(texture, column, row),
                              texel(texture, column + 1, row), x - left);
  const Vec3 lower = glm::mix(texel(texture, column, row + 1),
                              texel(texture, column + 1, row + 1), x - left);
  return glm::mix(upper, lower, y - top);
  // #endregion
}
// #endregion image

// ## Patterns without an image
//
// A floor of tiles needs no file. Two colors and a number are enough:
//
//     tiles = { kd = { checker = [0.8, 0.1], scale = 4 } }
//
// The coordinates $(u, v)$ are multiplied by `scale`, so there are four
// squares in a unit. Each square has two numbers, its column and its row.
// `glm::floor` gives both. If their sum is odd, the square has the second
// color.
//
// Left of 0 the numbers are negative. A cast to `int` would round -0.5 up to
// 0, and in C++ `-3 % 2` is -1. So use `glm::floor`, and call a sum $s$ odd
// if $s - 2\lfloor s/2 \rfloor$ is not 0. And it must be the sum: with one
// coordinate there are stripes.
//
// ![](checker-mistakes)
//
// On a ball such squares become narrow at the poles, as on a globe. A ball
// that is carved from a block of cubes has no poles:
//
//     cubes = { kd = { checker = [0.8, 0.2], scale = 10,
//                      over = "position" } }
//
// Now $x$, $y$ and $z$ of the hit are counted, and the sum has three numbers.
// This is why `is_odd` takes a `Vec3`. For squares the third number is 0.
//
// ![](over-position)
//
// One trap is left. A floor at $y = -1$ lies exactly on the border of two
// layers of cubes. Rounding moves some hits into the upper layer and some
// into the lower one, which has the other color. So `coefficient_at` reads
// the cube a little below the surface.
//
// The last pattern depends on the view. A table with a coat of varnish is
// bright if you look along it:
//
//     varnish = { kd = 0.3, ks = { schlick = [0.04, 0.6] } }
//
// *Schlick's approximation* begins with the color $k_0$, where you look
// straight at the surface. It rises to 1 at grazing angles ("An Inexpensive
// BRDF Model for Physically-based Rendering", Computer Graphics Forum 13(3),
// 1994). Here any color $k_{90}$ may replace the 1:
//
// $$k(\theta) = k_0 + (k_{90} - k_0)(1 - \cos\theta)^5$$
//
// Here $\theta$ is the angle of $\omega_o$. At a mirror both directions have
// the same angle, so use it for $k_s$. At a diffuse surface they differ: a
// $k_d$ that depends on one of the two alone breaks Helmholtz *reciprocity*.
// This law says that light can go the same way backwards.
//
// With $k_0 = 0.04$ and $k_{90} = 1$ it is close to the $F$ of glass, seen
// from outside. It needs two colors, and no index. That helps most with
// metals. The index of a metal is a *complex number*, another one for each
// wavelength, and its imaginary part says how fast the metal absorbs light.
//
// From inside glass the formula is wrong. At 41 degrees $F$ is 0.38, and
// Schlick's formula says 0.041. It does not know of the critical angle.
//
// ![](schlick-curves)
//
// Write `is_odd` and `schlick`, where $k_0$ is `squarely` and $k_{90}$ is
// `grazing`. The stage does not use `schlick` for glass.

// #region patterns
/// Whether the square or cube that the point `x` lies in is an odd one.
inline bool is_odd(const Vec3& x) {
  // #region exercise 5.4: checkerboards
  // #stub return false;
  const Vec3 cell = glm::floor(x);
  const float sum = cell.x + cell.y + cell.z;
  return sum - 2 * std::floor(sum / 2) != 0;
  // #endregion
}

inline Vec3 schlick(const Vec3& squarely, const Vec3& grazing,
                    float cos_theta) {
  // #region exercise 5.5: Schlick's approximation
  // #stub return squarely;
  const float x = 1 - cos_theta;
  return squarely + (grazing - squarely) * (x * x * x * x * x);
  // #endregion
}

/// What a pattern is at `hit`, seen from `wo`.
inline Vec3 coefficient_at(const VaryingCoefficient& pattern,
                           const Scene& scene, const Hit& hit,
                           const Vec3& wo) {
  switch (pattern.type) {
    case VaryingType::image:
      return image_color(*pattern.texture, texture_coordinates(scene, hit),
                         hit.shape_type == ShapeType::sphere);
    case VaryingType::checker: {
      const Vec2 uv = pattern.scale * texture_coordinates(scene, hit);
      return is_odd({uv.x, uv.y, 0}) ? pattern.second : pattern.first;
    }
    case VaryingType::position_checker: {
      const Vec3 below = hit.position - 0x1p-16f *
                                            max_abs_component(hit.position) *
                                            hit.normal;
      return is_odd(pattern.scale * below) ? pattern.second : pattern.first;
    }
    default:
      return schlick(pattern.first, pattern.second,
                     std::abs(dot(hit.normal, wo)));
  }
}
// #endregion patterns

// ## The material at a hit
//
// `material_at` returns a copy of the hit's material, with the coefficients
// that it has here. `varying_kd` is a pointer to a pattern, or null. If it is
// not null, `coefficient_at` says what `kd` is at this hit. The same holds
// for `ks` and `kt`.
//
// With `fresnel = true` in the scene file, `fresnel` in the material is true,
// and the light is shared out: $k_s$ becomes $F k_s$, and
// $k_t$ becomes $(1 - F)\,k_t$. The reflected and the refracted light add up
// to all of the light. So ideal glass has $k_s = k_t = 1$, and loses
// nothing. The diffuse $k_d$ stays as it is.
//
// ![](fresnel-mistakes)
//
// Beware of `kt = 1` without `ks`. Then $F k_s$ is 0, and what glass should
// reflect is lost. Beyond the critical angle $1 - F$ is 0, too. In stage 3
// the refraction lobe did total internal reflection, with $k_t$. Now nothing
// is left to it, and the specular lobe does it, with $k_s$. So the inside of
// the glass is black there.
//
// ![](without-ks)
//
// Stage 4 draws the event by these new coefficients. So $F$ decides how
// *often* a path is reflected. The weight is divided by the same $F$, and so
// $F$ cancels. Follow two paths of one pixel. The first meets the ball at
// $\cos\theta_o = n \cdot \omega_o = 0.71$, near 45 degrees.
//
// - Vertex 0: $F$ is 0.050. The event was refraction, and its probability was
//   $1 - F$. Of the weight $(1 - F)/2.25$ only $1/2.25 = 0.444$ is left.
// - Vertex 1: the path leaves the glass. In a ball it meets the surface from
//   inside at the same angle to which it was bent on entering. $F$ is the
//   same for both directions of one ray, so it is 0.050 again. The weight is
//   2.25.
// - Vertex 2: the throughput is 1, as if there were no glass. The weight of
//   the white floor is its 0.8 over the probability 0.8. So the path still
//   counts in full, goes on to the lamp, and brings 1.
//
//     $ build/stage5 scenes/fresnel_glass.toml --pixel 60,165
//     > --sample 22
//     ...
//     vertex 0: sphere[0] of 'fresnel', bounce 0
//     ...
//       normal     (  -0.175,    0.706,   -0.686) ...
//       wo         (   0.173,    0.096,   -0.980)
//       ks         (   0.050,    0.050,    0.050)
//       kt         (   0.950,    0.950,    0.950)
//       throughput (       1,        1,        1)
//       goes on    (  -0.044,   -0.353,    0.93)  refraction
//       weight     (   0.444,    0.444,    0.444)
//     vertex 1: sphere[0] of 'fresnel', bounce 1
//     ...
//       ks         (   0.050,    0.050,    0.050)
//       kt         (   0.950,    0.950,    0.950)
//       throughput (   0.444,    0.444,    0.444)
//     ...
//       weight     (    2.25,     2.25,     2.25)
//     vertex 2: plane[2] of 'white', bounce 2
//     ...
//       throughput (       1,        1,        1)
//     ...
//     radiance of this sample = (1.000, 1.000, 1.000)
//
// Another sample of the same pixel meets the ball at another point, close to
// the first. It is one of the 5 in 100 that are reflected. Its probability
// was $F$, and its weight is $F/F = 1$. It counts in full, too, and sees the
// red wall.
//
//     $ build/stage5 scenes/fresnel_glass.toml --pixel 60,165
//     > --sample 24
//     ...
//     vertex 0: sphere[0] of 'fresnel', bounce 0
//     ...
//       ks         (   0.051,    0.051,    0.051)
//     ...
//       goes on    (  -0.415,    0.909,    0.027)  specular
//       weight     (       1,        1,        1)
//     vertex 1: plane[0] of 'red', bounce 1
//     ...
//     radiance of this sample = (1.000, 0.250, 0.250)
//
// Of 100 paths of this pixel about 95 are refracted and 5 reflected. No path
// was split, and none was made darker. That is why stage 4 came first.
//
// Write `material_at`. The patterns come first, so that $F$ shares out what
// they say. With your copy `m`, `Surface(hit, m, wo)` is the surface as it is
// seen from `wo`: its `normal` is on the side of `wo`. `relative_eta` of
// stage 3 takes it, and returns $\eta_o/\eta_i$. Then `dot(surface.normal,
// wo)` is $\cos\theta_o$, which is never negative.

// #region material-at
/// The material with the coefficients that it has at `hit`, seen from `wo`.
inline Material material_at(const Scene& scene, const Hit& hit,
                            const Vec3& wo) {
  // #region exercise 5.6: the material here
  // #stub return *hit.material;
  Material m = *hit.material;
  if (m.varying_kd) m.kd = coefficient_at(*m.varying_kd, scene, hit, wo);
  if (m.varying_ks) m.ks = coefficient_at(*m.varying_ks, scene, hit, wo);
  if (m.varying_kt) m.kt = coefficient_at(*m.varying_kt, scene, hit, wo);
  if (m.fresnel) {
    const Surface surface(hit, m, wo);
    const float f =
        fresnel_reflectance(dot(surface.normal, wo), relative_eta(surface));
    m.ks *= f;
    m.kt *= 1 - f;
  }
  return m;
  // #endregion
}
// #endregion material-at

// ## The path
//
// Stage 4's loop, with one new line: the material. Direct light, the event
// and the direction all use it, since it is the one in `surface`.

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
      const Material material = material_at(scene_, *hit, -ray.direction);
      const Surface surface(*hit, material, -ray.direction);
      log_vertex(surface, throughput, sum, bounce);

      // An emitter ends the path, and counts if it has not been counted.
      if (surface.material.emits()) {
        if (!already_counted(surface, direct_light_added)) {
          sum += throughput * emitted(surface);
        }
        return sum;
      }
      if (bounce == max_bounces_) return sum;

      // Ask the lights, for the diffuse lobe.
      if (!is_black(surface.material.kd)) {
        sum += throughput * direct_light(scene_, surface, random);
      }

      // Draw an event.
      const std::optional<LobeChoice> choice = choose_lobe(
          lobe_probabilities(surface.material, bounce), random.uniform());
      if (!choice) return sum;

      // Go on in a direction of the event's lobe.
      const BsdfSample next =
          sample(choice->lobe, surface, sampling_, random);
      throughput *= next.weight / choice->probability;
      ray = spawn_ray(*hit, next.wi);
      direct_light_added = choice->lobe == Lobe::diffuse;
    }
  }

 private:
  const Scene& scene_;
  int max_bounces_;
  Sampling sampling_;
};
// #endregion path

// Render the three scenes of this chapter:
//
//     build/stage5 scenes/checkered_floor.toml -o floor.png
//     build/stage5 scenes/textured_globe.toml -o globe.png
//     build/stage5 scenes/fresnel_glass.toml -o glass.png
//
// Add 0.25 to the globe's $u$, and say before you render which way the map
// turns. (Its east comes to the front.) Then take a room with a glass ball,
// and give its glass `ks = 1`, `kt = 1` and `fresnel = true`. Which parts of
// the ball become darker, and which brighter?
//
// ![](lab-glass)
//
// What remains? Rough metals and cloth need lobes that are neither diffuse
// nor a delta. Fog scatters light between the surfaces. Many lights need a
// choice among them. Each of these needs one more random choice: of a
// direction, a distance or a light. And each divides by the density or the
// probability of its choice. You can read about all of these now.
//
}  // namespace lightwalk::stage5
