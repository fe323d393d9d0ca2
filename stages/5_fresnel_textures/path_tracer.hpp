#pragma once

// # Stage 5: Fresnel and textures
//
// A material has had the same coefficients everywhere. Real ones do not: a
// floor has tiles, a globe has countries, and a window reflects the sky when
// you look along it and hardly anything when you look through. The rendering
// equation has always allowed it: $f_r(x, \omega_i, \omega_o)$ depends on the
// place $x$ and on the direction of view $\omega_o$. So before a surface is
// used, ask what it is here, seen from there. Nothing else changes.

#include "common/image/srgb.hpp"
#include "stages/4_russian_roulette/path_tracer.hpp"

namespace lightwalk::stage5 {

using stage1::BsdfSample;
using stage1::emitted;
using stage2::direct_light;
using stage2::is_counted;
using stage3::Lobe;
using stage3::relative_eta;
using stage3::sample;
using stage4::choose_lobe;
using stage4::lobe_probabilities;
using stage4::LobeChoice;

// ## How much glass reflects
//
// At the border of two transparent materials some light is reflected and the
// rest goes through. How much, Maxwell's equations settle, and Fresnel had
// found it before them. Light that swings across the plane of incidence (s)
// and light that swings within it (p) are reflected differently:
//
// $$r_s = \frac{\eta_o\cos\theta_o - \eta_i\cos\theta_i}
// {\eta_o\cos\theta_o + \eta_i\cos\theta_i}, \quad
// r_p = \frac{\eta_i\cos\theta_o - \eta_o\cos\theta_i}
// {\eta_i\cos\theta_o + \eta_o\cos\theta_i}$$
//
// These are amplitudes; power goes with their squares. Light without a
// preferred swing is half of each (pbrt, 4th edition, section 9.3.5):
//
// $$F = \tfrac12 (r_s^2 + r_p^2)$$
//
// Glass of 1.5 seen squarely reflects 4 %, from either side. At 56.3 degrees
// $r_p$ is 0: what is reflected from a lake there is all s, and sunglasses
// that block s block the glare. At grazing angles $F$ is 1. From inside it is
// 1 already beyond the 41.8 degrees of total internal reflection.
//
// ![](fresnel-curves)

// #region fresnel
/// The share of unpolarised light that is reflected, 0 to 1. `cos_o` >= 0 is
/// the cosine between the normal and wo, on the side of wo; `eta_ratio` is
/// eta_o / eta_i. The same for both directions of one ray.
inline float fresnel_reflectance(float cos_o, float eta_ratio) {
  const float sin2_o = std::max(0.0f, 1 - cos_o * cos_o);
  const float sin2_i = eta_ratio * eta_ratio * sin2_o;
  if (sin2_i >= 1) return 1;
  const float cos_i = std::sqrt(1 - sin2_i);
  const float r_s = (eta_ratio * cos_o - cos_i) / (eta_ratio * cos_o + cos_i);
  const float r_p = (cos_o - eta_ratio * cos_i) / (cos_o + eta_ratio * cos_i);
  return (r_s * r_s + r_p * r_p) / 2;
}
// #endregion fresnel

// ![](fresnel-or-fixed)

// ## Where on the surface
//
// A picture that is wrapped around a shape needs two coordinates on it, $u$
// along its lower edge and $v$ upwards, both from 0 to 1.
//
// - A rectangle has them by its edges, and so has a triangle.
// - A plane has no edges. There $v$ runs upwards, which is +y along a wall
//   and +z along a floor or a ceiling, and $u$ to the right of somebody who
//   stands before the wall, on the side of its normal. One picture a unit.
// - A sphere is a globe with its poles up and down: $u$ is the longitude,
//   with the middle of the picture towards -z, where the lab's camera stands,
//   and $v$ is the latitude.

// #region texture-coordinates
/// (u, v) on a plane with this unit normal.
inline Vec2 plane_coordinates(const Vec3& normal, const Vec3& position) {
  const bool is_level = std::abs(normal.x) + std::abs(normal.z) < 1e-4f;
  const Vec3 up = is_level ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
  const Vec3 v = normalize(up - dot(up, normal) * normal);
  const Vec3 u = cross(normal, v);
  return {dot(u, position), dot(v, position)};
}

/// (u, v) of a hit. In [0, 1]^2 but for planes, which have no end.
inline Vec2 texture_coordinates(const Scene& scene, const Hit& hit) {
  const Geometry& shapes = scene.geometry;
  switch (hit.shape_type) {
    case ShapeType::plane:
      return plane_coordinates(hit.normal, hit.position);
    case ShapeType::sphere: {
      const Vec3& n = hit.normal;
      const float longitude = std::atan2(n.x, -n.z);
      const float from_south = std::acos(glm::clamp(-n.y, -1.0f, 1.0f));
      return {0.5f + longitude / two_pi, from_south / pi};
    }
    case ShapeType::rectangle:
      return shapes.rectangles()[hit.shape_index].coordinates(hit.position);
    default:
      return shapes.triangles()[hit.shape_index].coordinates(hit.position);
  }
}
// #endregion texture-coordinates

// ## Reading a picture
//
// Pixels have their color at their center, half a pixel from the edge.
// Between four centers it is mixed in proportion (bilinear). Beyond the edge
// the picture repeats, which also closes the seam of the globe, where $u$
// jumps from 1 to 0. Over the poles it must not: the north would shine
// through in the south.
//
// The file's bytes are not proportional to light: by the sRGB curve, byte 188
// is half as bright as 255. Decode each before mixing. Forget it, and every
// texture looks pale.

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

/// The picture's color at (u, v), between texels mixed. v = 0 is the lower
/// edge. `has_poles` keeps v from repeating.
inline Vec3 image_color(const Texture& texture, const Vec2& uv,
                        bool has_poles) {
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
}
// #endregion image

// ![](globe)

// ## Patterns without a picture
//
// A checkerboard needs no file: count the squares, and odd ones have the
// other color. Counted over $(u, v)$ the squares follow the surface; counted
// over the position $x$ they are cubes that the surface is carved from. A
// floor at a whole number would lie just between two layers of cubes, and
// rounding would pick one by chance, so the cubes are read a little below the
// surface.
//
// The last pattern depends on the view. Schlick's curve goes from the color
// that a surface has when seen squarely to the one at grazing angles
// ("An Inexpensive BRDF Model", Computer Graphics Forum 13(3), 1994):
//
// $$k(\theta) = k_0 + (k_{90} - k_0)(1 - \cos\theta)^5$$
//
// It follows Fresnel's $F$ closely, and works for metals and for varnish,
// which have no single index.

// #region patterns
/// Whether the square or cube with these coordinates is an odd one.
inline bool is_odd(const Vec3& x) {
  const Vec3 cell = glm::floor(x);
  const float sum = cell.x + cell.y + cell.z;
  return sum - 2 * std::floor(sum / 2) != 0;
}

inline Vec3 schlick(const Vec3& squarely, const Vec3& grazing,
                    float cos_theta) {
  const float x = 1 - cos_theta;
  return squarely + (grazing - squarely) * (x * x * x * x * x);
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

// ![](floor)

// ## The material, here and from there
//
// With `fresnel`, what is reflected is taken from what goes through: $k_s$
// becomes $F k_s$, and $k_t$ becomes $(1 - F) k_t$. Both of them 1 is ideal
// glass, which loses nothing. The event probabilities are computed from the
// modulated values, so $F$ decides how often a path is reflected, and cancels
// in its weight: glass seen squarely refracts 96 paths of 100, and each of
// them counts in full.

// #region material-at
/// The material with the coefficients that it has at `hit`, seen from `wo`.
inline Material material_at(const Scene& scene, const Hit& hit,
                            const Vec3& wo) {
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
}
// #endregion material-at

// ## The path
//
// Stage 4's loop, and one line of it is new: the material.

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
        if (!is_counted(surface, direct_light_added)) {
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

}  // namespace lightwalk::stage5
