#pragma once

// # Stage 6: many paths at once
//
// A processor has registers that hold up to 16 floats side by side. One
// instruction adds 16 floats to 16 others, in the time of one addition.
// Stages 1 to 5 follow one path. Only their search for the nearest shape
// tries eight shapes at once. In the rest of a path most of the register is
// empty.
//
// This stage follows 16 paths together. All of them take one step, then all
// take the next. The method does not change. The estimator is
// stage 5's, and so are the random numbers. Even the picture is the same, to
// the last bit. In the lab's box, with its seven shapes, stage 6 makes it
// four to six times as fast. With a thousand shapes it gains little.
//
// ![](one-and-sixteen)
//
// The name for this is *SIMD*: single instruction, multiple data. A graphics
// card works in the same way, with 32 or 64. This chapter has no exercises.

#include <array>
#include <atomic>
#include <memory>
#include <variant>

#include "common/geometry/inlining.hpp"
#include "stages/5_fresnel_textures/path_tracer.hpp"
#include "stages/6_many_paths/rows/material_table.hpp"
#include "stages/6_many_paths/rows/sample_queue.hpp"
#include "stages/6_many_paths/rows/shape_table.hpp"

#ifdef LIGHTWALK_ROWS

namespace lightwalk::stage6 {

// ## A number for each path
//
// Where stage 5 has a number, this stage has a *row*: 16 numbers, one for
// each path. The place of a path in the rows is its *lane*. `Floats` stands
// for `float`, and `Vec3s` for `Vec3`: three rows, for x, y and z. The
// plural is the rule: `Ints`, `Rays`, `Hits`, `Materials`. Each holds one
// thing for each lane. A single number beside a row applies to all lanes.
//
// The operators work lane by lane. With rows, `a * b + c` is 16 products and
// 16 sums. So a formula stays as it is; only `a *= b` is written `a = a * b`.
// Here are three, from stages 1 and 3. Beside the types, `sqrt` replaces
// `std::sqrt`, and 1 is `1.0f`. `Bases` has a basis for each lane.
//
// What is behind the operators? A library, Highway, knows the instructions
// of each processor, and `rows/row.hpp` defines operators for them.
//
// Four words are for the compiler alone, and you may skip them. `HWY_INLINE`
// puts a function into its caller, and `LIGHTWALK_NOINLINE` keeps it out.
// `LIGHTWALK_FLATTEN` puts all that a function calls into it. `HWY_ATTR`
// says for which instructions a lambda with rows in it is
// compiled. `LIGHTWALK_ROWS` is defined where Highway is installed and the
// processor has the instructions that rows need. Elsewhere the end of this
// file makes stage 6 the same as stage 5.

// #region formulas
HWY_INLINE Vec3s sample_uniform_hemisphere(const Vec3s& normal,
                                           const Vec2s& u) {
  const Floats cos_theta = u.x;
  const Floats sin_theta = sqrt(1.0f - u.x * u.x);
  const Floats phi = two_pi * u.y;
  return Bases(normal).to_world(
      {sin_theta * cos(phi), sin_theta * sin(phi), cos_theta});
}

HWY_INLINE Vec3s sample_cosine_hemisphere(const Vec3s& normal,
                                          const Vec2s& u) {
  const Floats cos_theta = sqrt(1.0f - u.x);
  const Floats sin_theta = sqrt(u.x);
  const Floats phi = two_pi * u.y;
  return Bases(normal).to_world(
      {sin_theta * cos(phi), sin_theta * sin(phi), cos_theta});
}

HWY_INLINE Vec3s reflect(const Vec3s& wo, const Vec3s& normal) {
  return 2.0f * dot(wo, normal) * normal - wo;
}
// #endregion formulas

// ## No path can take its own branch
//
// What changes is `if`. One path is in glass, its neighbor is on a wall, and
// the next instruction is the same for both. So both branches are worked out
// for all lanes, and then each lane takes the result that is its own.
//
// ![](both-branches)
//
// The comparison of two rows is a `Mask`: yes or no for each lane. `select`
// takes from one row where the mask is set, and from the other where it is
// not. This is how most of stage 5 is translated:
//
//     one path                 sixteen paths
//
//     if (c) x = y;            x = select(c, y, x);
//     return c ? a : b;        return select(c, a, b);
//     if (c) return sum;       on = on & !c;
//     if (c) change(x);        if (any(c)) change(x, c);
//     *hit.material            materials.at(number)
//
// `&`, `|` and `!` work on masks lane by lane. The usual `&&` will
// not do: it takes a `bool`, and a mask has 16. `any(mask)` is true if one
// lane at least is set, and `count(mask)` says how many are.
//
// A path that would return stays in its lane, but it is no longer `on`. Its
// `sum` is not changed anymore, because each sum is selected by a mask of
// lanes that are on. Its ray and its throughput may become nonsense, even a
// NaN. Nothing that comes of them is used, and the next path replaces them.
// A lane that is on may also take the root of a negative number, in the
// branch that is not its own. There `select` leaves the NaN out.
//
// The line with `any` saves time: a branch that no lane takes is left out.
// Otherwise only its own lanes may change: the mask is passed to the
// function, or used in a `select`. With 16 lanes a branch is seldom left out:
// if one path in ten is in glass, $1 - 0.9^{16}$ of the rows, 81 %, need it.
//
// Refraction returned nothing where all light is reflected. A row cannot
// return nothing. So `refract` always gives directions, and a mask of the
// lanes in which they mean nothing. Fresnel's early return is a `select`.
// `relative_eta` takes a hit: `material_at` makes no surface here.

// #region refract
/// eta_o / eta_i for light that leaves toward `wo`.
HWY_INLINE Floats relative_eta(const Hits& hit, const Floats& eta,
                               const Vec3s& wo) {
  const Mask outside = dot(hit.normal, wo) > 0.0f;
  return select(outside, 1.0f / eta, eta);
}

struct Refracted {
  Vec3s wi;
  Mask total;  ///< all light is reflected, and wi is no direction
};

HWY_INLINE Refracted refract(const Vec3s& wo, const Vec3s& normal,
                             const Floats& eta_ratio) {
  const Floats cos_o = dot(wo, normal);
  const Floats sin2_o = max(0.0f, 1.0f - cos_o * cos_o);
  const Floats sin2_i = eta_ratio * eta_ratio * sin2_o;
  const Floats cos_i = sqrt(1.0f - sin2_i);
  return {normalize(-eta_ratio * (wo - cos_o * normal) - cos_i * normal),
          sin2_i >= 1.0f};
}

HWY_INLINE Floats fresnel_reflectance(const Floats& cos_o,
                                      const Floats& eta_ratio) {
  const Floats sin2_o = max(0.0f, 1.0f - cos_o * cos_o);
  const Floats sin2_i = eta_ratio * eta_ratio * sin2_o;
  const Floats cos_i = sqrt(1.0f - sin2_i);
  const Floats r_s =
      (eta_ratio * cos_o - cos_i) / (eta_ratio * cos_o + cos_i);
  const Floats r_p =
      (cos_o - eta_ratio * cos_i) / (cos_o + eta_ratio * cos_i);
  return select(sin2_i >= 1.0f, 1.0f, (r_s * r_s + r_p * r_p) / 2.0f);
}
// #endregion refract

// ## A table for all
//
// Each path has met one of the shapes, and so one of the materials. In stage
// 5 that was a pointer. Here the materials are in a table, one entry for
// each. The shapes are in a table, too, with the numbers of their materials.
// Each lane looks up the number of its shape's material, and then what is in
// that entry. A short table fits into a register, and picking from a register
// is one instruction for all of its lanes. A longer table stays in memory,
// and its entries are fetched one by one (`rows/column.hpp`).
//
// ![](lookup)
//
// What was yes or no is a mask: `found` in `Hits`, and in `Materials`
// `emits`, `fresnel` and `varies`. The last is set where a coefficient is a
// pattern. A pattern is worked out lane by lane, by stage 5's own function.
// `for_each_lane` calls a function for each lane of a mask, one after the
// other; `a[lane]` reads one lane, and `a.set(lane, x)` writes one.
// `normal_towards(hit, wo)` is a Surface's normal, `shapes.hit(hits, lane)` a
// Hit. Emission is looked up apart, because few lanes need it.

// #region material-at
/// The scene in the form that rows need.
struct SceneRows {
  const Scene& scene;
  ShapeTable shapes;
  MaterialTable materials;

  explicit SceneRows(const Scene& scene_)
      : scene(scene_), shapes(scene_), materials(shapes.materials()) {}
};

LIGHTWALK_NOINLINE inline void vary(Materials& m, const SceneRows& rows,
                                    const Hits& hits, const Vec3s& wo,
                                    const Mask& varies) {
  for_each_lane(varies, [&](int lane) {
    const Hit hit = rows.shapes.hit(hits, lane);
    const auto set = [&](Vec3s& k, const VaryingCoefficient* pattern) {
      if (!pattern) return;
      k.set(lane,
            stage5::coefficient_at(*pattern, rows.scene, hit, wo[lane]));
    };
    set(m.kd, hit.material->varying_kd);
    set(m.ks, hit.material->varying_ks);
    set(m.kt, hit.material->varying_kt);
  });
}

/// The materials with the coefficients that they have here, seen from `wo`.
HWY_INLINE Materials material_at(const SceneRows& rows, const Hits& hit,
                                 const Vec3s& wo, const Mask& on) {
  Materials m = rows.materials.at(rows.shapes.material(hit));
  const Mask varies = on & m.varies;
  if (any(varies)) vary(m, rows, hit, wo, varies);
  if (any(on & m.fresnel)) {
    const Floats cos_o = dot(normal_towards(hit, wo), wo);
    const Floats f = fresnel_reflectance(cos_o, relative_eta(hit, m.eta, wo));
    m.ks = select(m.fresnel, m.ks * f, m.ks);
    m.kt = select(m.fresnel, m.kt * (1.0f - f), m.kt);
  }
  return m;
}

/// Where each path is, as stage 5's Surface; refers to the rows in `step`.
struct Surfaces {
  const Hits& hit;
  const Materials& material;  ///< with the coefficients that they have here
  const Vec3s& wo;
  Vec3s normal;  ///< on the side of wo
};

HWY_INLINE Vec3s emitted(const SceneRows& rows, const Surfaces& surface) {
  const Mask front = dot(surface.hit.normal, surface.wo) > 0.0f;
  const Vec3s ke = rows.materials.ke(rows.shapes.material(surface.hit));
  return select(front, ke, Vec3(0));
}
// #endregion material-at

// ## An event for each path
//
// Each path draws a lobe or is absorbed. Three masks say which path drew
// which lobe. No lane is set in two of them. A lane that was on and is set in
// none has lost its path: the light was absorbed. One of the two values in a
// `select` must be a row: hence `Floats(1)`.

// #region choose-lobes
struct LobeChoices {
  Mask diffuse, specular, refraction;
  Floats probability;
};

/// Picks a lobe for each path that is `on`, by `xi`, uniform in [0, 1).
HWY_INLINE LobeChoices choose_lobes(const Materials& material,
                                    const Ints& bounce, const Floats& xi,
                                    const Mask& on) {
  const Floats diffuse = max_component(material.kd);
  const Floats specular = max_component(material.ks);
  const Floats refraction = max_component(material.kt);
  const Mask is_early = bounce < stage4::first_limited_bounce;
  const Floats limit = select(is_early, Floats(1), stage4::survival_limit);
  const Floats sum = diffuse + specular + refraction;
  const Floats scale = select(sum > limit, limit / sum, 1.0f);
  const Floats d = scale * diffuse;
  const Floats s = scale * specular;
  const Floats r = scale * refraction;

  LobeChoices choice;
  // Keep this order: `on & (xi < d + s + r) & !(...)` makes Clang 19 hang for
  // AVX-512, where two of its rewrites undo each other.
  choice.diffuse = on & (xi < d);
  choice.specular = on & !(xi < d) & (xi < d + s);
  choice.refraction = on & !(xi < d + s) & (xi < d + s + r);
  choice.probability =
      select(choice.diffuse, d, select(choice.specular, s, r));
  return choice;
}
// #endregion choose-lobes

// Then a direction of each lobe is worked out, and the masks choose. Only the
// diffuse lobe takes two random numbers. A lane with another event must draw
// none, or its later numbers would not be stage 5's.
// `random.uniform_2d(mask)` draws only where the mask is set. The diffuse
// lobe is nearly always needed, so there is no `any` for it.

// #region sample
struct BsdfSamples {
  Vec3s wi, weight;
};

/// For each path a direction of its lobe, and f_r cos(theta) / pdf.
HWY_INLINE BsdfSamples sample(const LobeChoices& lobe,
                              const Surfaces& surface, Sampling sampling,
                              Randoms& random) {
  const auto& [hit, material, wo, normal] = surface;
  const Vec2s u = random.uniform_2d(lobe.diffuse);
  BsdfSamples next;
  if (sampling == Sampling::uniform) {
    next.wi = sample_uniform_hemisphere(normal, u);
    next.weight = 2.0f * dot(normal, next.wi) * material.kd;
  } else {
    next = {sample_cosine_hemisphere(normal, u), material.kd};
  }
  if (any(lobe.specular | lobe.refraction)) {
    const Floats eta_ratio = relative_eta(hit, material.eta, wo);
    const Refracted bent = refract(wo, normal, eta_ratio);
    const Mask mirrored = lobe.specular | bent.total;
    const Vec3s wi = select(mirrored, reflect(wo, normal), bent.wi);
    const Vec3s transmitted = eta_ratio * eta_ratio * material.kt;
    const Vec3s weight = select(lobe.specular, material.ks,
                                select(bent.total, material.kt, transmitted));
    next.wi = select(lobe.diffuse, next.wi, wi);
    next.weight = select(lobe.diffuse, next.weight, weight);
  }
  return next;
}
// #endregion sample

// ## Lights
//
// All paths ask the same light, then all ask the next. The kind of light does
// not depend on the path. So `std::visit` chooses the formula, as in stage 2:
// you find it in `direct_light` below. `asking` is the mask of the lanes that
// ask. The formulas are those of stage 2. Only the early return inside a
// sphere light becomes a `select`. (Inside, the distance means nothing: no
// ray is sent to a black light.) A vector that meets a row of numbers is made
// a row first: `Vec3s(v)`. A point light has nothing to choose, but stage 2
// draws two numbers for it, and so they are drawn here.

// #region lights
/// What arrives from a light at each path, as in stage 2.
struct LightSamples {
  Vec3s direction, weight;
  Floats distance;
};

HWY_INLINE LightSamples sample_light(const PointLight& light, const Vec3s& x,
                                     const Mask& asking, Randoms& random) {
  random.uniform_2d(asking);
  const Vec3s to_light = light.center - x;
  const Floats squared_distance = dot(to_light, to_light);
  const Floats distance = sqrt(squared_distance);
  const Floats size = distance + max_abs_component(light.center);
  return {to_light / distance, Vec3s(light.intensity) / squared_distance,
          distance - stage2::distance_rounding / 2 * size};
}

HWY_INLINE LightSamples sample_light(const RectangleLight& light,
                                     const Vec3s& x, const Mask& asking,
                                     Randoms& random) {
  const Vec2s u = random.uniform_2d(asking);
  const Vec3s point =
      light.corner + u.x * Vec3s(light.edge_u) + u.y * Vec3s(light.edge_v);
  const Vec3 area_vector = cross(light.edge_u, light.edge_v);
  const float area = length(area_vector);
  const Vec3s normal = area_vector / area;
  const Vec3s to_light = point - x;
  const Floats squared_distance = dot(to_light, to_light);
  const Floats distance = sqrt(squared_distance);
  const Vec3s direction = to_light / distance;
  const Floats cos_light = max(0.0f, -dot(normal, direction));
  return {direction,
          Vec3s(light.radiance) * (area * cos_light / squared_distance),
          distance * (1 + stage2::distance_rounding)};
}

HWY_INLINE LightSamples sample_light(const SphereLight& light, const Vec3s& x,
                                     const Mask& asking, Randoms& random) {
  const Vec2s u = random.uniform_2d(asking);
  const Vec3s to_center = light.center - x;
  const Floats squared_distance = dot(to_center, to_center);
  const Floats squared_radius = light.radius * light.radius;
  const Floats distance = sqrt(squared_distance);
  const Floats sin2_max = squared_radius / squared_distance;
  const Floats one_minus_cos_max = sin2_max / (1.0f + sqrt(1.0f - sin2_max));

  const Floats one_minus_cos = u.x * one_minus_cos_max;
  const Floats cos_theta = 1.0f - one_minus_cos;
  const Floats sin2_theta = one_minus_cos * (1.0f + cos_theta);
  const Floats sin_theta = sqrt(sin2_theta);
  const Floats phi = two_pi * u.y;
  const Vec3s direction =
      Bases(to_center / distance)
          .to_world({sin_theta * cos(phi), sin_theta * sin(phi), cos_theta});

  const Floats half_chord =
      sqrt(max(0.0f, squared_radius - squared_distance * sin2_theta));
  const Mask inside = squared_distance <= squared_radius;
  return {
      select(inside, Vec3(0, 0, 1), direction),
      select(inside, Vec3(0),
             Vec3s(light.radiance) * (two_pi * one_minus_cos_max)),
      (distance * cos_theta - half_chord) * (1 + stage2::distance_rounding)};
}
// #endregion lights

// Direct light is stage 2's, with masks. A lane that faces away from the
// light, or gets nothing, is not in `faces`. Stage 2 skips a light where
// `cos_theta <= 0`. The mask says `!(cos_theta <= 0)`, not `cos_theta > 0`:
// both stages must do the same even with a NaN, with which `<`, `<=` and `>`
// are false. A lane in shadow is not in `lit`.
//
// `number` is the light's place in the scene's list. A shadow ray may meet
// the shape of its own light, and nothing else before it. `f` is $f_r$.

// #region direct-light
/// Radiance toward the viewer that all sampled lights cause.
HWY_INLINE Vec3s direct_light(const SceneRows& rows, const Surfaces& surface,
                              const Mask& asking, Randoms& random) {
  const Vec3s x = leave(surface.hit, surface.normal);
  const Vec3s f = surface.material.kd * inverse_pi;
  Vec3s sum(Vec3(0));
  std::int32_t number = 0;
  const auto ask = [&](const auto& light) HWY_ATTR {
    const LightSamples to_light = sample_light(light, x, asking, random);
    const Floats cos_theta = dot(surface.normal, to_light.direction);
    const Mask faces =
        asking & !(cos_theta <= 0.0f) & !is_black(to_light.weight);
    if (!any(faces)) return;
    count_rays(count(faces));
    const Rays shadow_rays = spawn_rays(surface.hit, to_light.direction);
    const Mask lit = faces & rows.shapes.reach(shadow_rays, to_light.distance,
                                               number, faces);
    sum = select(lit, sum + f * cos_theta * to_light.weight, sum);
  };
  for (const Light& light : rows.scene.lights) {
    std::visit(ask, light.form);
    ++number;
  }
  return sum;
}
// #endregion direct-light

// ## One step
//
// Everything that a path carries from one surface to the next is kept in
// `Paths`. The paths of a row are at different bounces, so `bounce` is a
// row, too. The body of stage 5's loop becomes `step`. Here they are side by
// side: the comments are the same, and so is their order.
//
// ![](step-beside-loop)
//
// A few lines need a word. `scene_` is a `SceneRows` here. `count_rays`
// counts rays for the display; it was inside the search. What adds 1 to
// `bounce` was in the loop's head. `is_light` and the line after it are stage
// 2's `already_counted`: the shape is in the list of lights, and the previous
// vertex asked them. `log_vertex` is missing: with `--pixel`, stage 5 follows
// the path and prints it.
//
// In stage 5 a path ended in four places, by four `return`s. Here there are
// four lines in which `on` loses lanes: those that meet nothing, meet an
// emitter, have had all bounces, or are absorbed. `step` returns those that
// are left. The figure follows eight lanes through a step.
//
// ![](masks)
//
// Rays of all lanes are tested with one shape, then with the next, and each
// lane keeps the nearest (`rows/shape_table.hpp`). Lanes that are off are
// tested, too, for nothing; only in scenes with many shapes (see the end) are
// they left out. A lane that met nothing is given the first shape's entry
// of the table, since any will do: its results are not used. `on` is narrowed
// before `material_at`, so that a pattern is worked out only for lanes on a
// shape.
//
// When the event is drawn, `on` is given twice. `random.uniform(on)` draws a
// number for these lanes only, and `choose_lobes` sets its masks only in
// these. In a lane whose light is absorbed the probability and the weight
// mean nothing, and may be 0/0; but this lane has just lost its path.

// #region paths
inline constexpr int paths_at_once = row_lanes;  ///< 16, or 4 on ARM

struct Paths {
  Rays ray;
  Vec3s throughput, sum;
  Ints bounce;
  Mask direct_light_added;
  Randoms random;
};
// #endregion paths

// #region step
class PathTracer {
 public:
  PathTracer(const Scene& scene, const RenderSettings& settings)
      : scene_(scene),
        seed_(settings.seed),
        max_bounces_(settings.max_bounces),
        sampling_(settings.sampling) {}

  Mask step(Paths& path, Mask on) const;
  void render_tile(const Tile&, Film&, const std::atomic<bool>& stop) const;
  Vec3 radiance(const Ray& ray, Random& random) const;

 private:
  void begin(Paths& path, const Mask& fresh) const;

  SceneRows scene_;
  std::uint64_t seed_;
  int max_bounces_;
  Sampling sampling_;
};

/// Takes the paths that are `on` to the next surface, and beyond it.
/// Returns those that have not ended.
LIGHTWALK_FLATTEN inline Mask PathTracer::step(Paths& path, Mask on) const {
  // Find the next surface.
  count_rays(count(on));
  const Hits hit = scene_.shapes.nearest_hits(path.ray, on);
  on = on & hit.found;
  const Vec3s wo = -path.ray.direction;
  const Materials material = material_at(scene_, hit, wo, on);
  const Surfaces surface{hit, material, wo, normal_towards(hit, wo)};

  // An emitter ends the path, and counts if it has not been counted.
  const Mask emits = on & material.emits;
  if (any(emits)) {
    const Mask is_light = scene_.shapes.is_light(hit);
    const Mask counted = path.direct_light_added & is_light;
    const Vec3s added = path.throughput * emitted(scene_, surface);
    path.sum = select(emits & !counted, path.sum + added, path.sum);
  }
  on = on & !emits;
  on = on & (path.bounce != max_bounces_);

  // Ask the lights, for the diffuse lobe.
  const Mask asking = on & !is_black(material.kd);
  if (any(asking)) {
    const Vec3s added =
        path.throughput * direct_light(scene_, surface, asking, path.random);
    path.sum = select(asking, path.sum + added, path.sum);
  }

  // Draw an event.
  const LobeChoices lobe =
      choose_lobes(material, path.bounce, path.random.uniform(on), on);
  on = lobe.diffuse | lobe.specular | lobe.refraction;

  // Go on in a direction of the event's lobe.
  const BsdfSamples next = sample(lobe, surface, sampling_, path.random);
  path.throughput = path.throughput * (next.weight / lobe.probability);
  path.ray = spawn_rays(hit, next.wi);
  path.bounce = path.bounce + 1;
  path.direct_light_added = lobe.diffuse;
  return on;
}
// #endregion step

// ## Paths that end
//
// In the box under the point light, about one path in five ends at each
// step. Suppose that its lane stayed empty until all 16 have ended. Soon
// most lanes would be empty, and all would wait for the longest path. Without
// a refill nearly two thirds of the lanes do nothing, as the figure shows.
//
// ![](idle-lanes)
//
// So a lane whose path has ended gets the next sample's path at once.
//
// ## Why the last bit is the same
//
// Floats are rounded after each operation. So the sum of three numbers
// depends on which two are added first, and a faster program often changes
// the last bits there. Three rules keep them here:
//
// - In each lane the operations are those of stage 5, in its order. A
//   compiler might turn `a * b + c` into one instruction that rounds only
//   once. An option in `cmake/CompilerOptions.cmake` forbids it.
// - The random numbers depend on the sample, not on the lane, nor on what
//   other paths have drawn (`common/math/random.hpp`).
// - Samples end in another order than they begin. So each writes its radiance
//   into its place in a list. When the tile is done, the list goes into the
//   film in order.
//
// ![](in-their-places)
//
// Why bother? Any error shows at once: render the scene with stage 5, too,
// and compare the bits. So the tests of this stage need no tolerance.
//
// So far the program asked a stage for one ray after the other. This stage is
// given a *tile*, 16 by 16 pixels, and makes its rays itself. `origin_slot`
// is the shape that a ray leaves, and `no_slot` none. `SampleQueue` has the
// samples of the tile, and a `Film` adds up the pixels. If the user ends the
// program, `stop` is set, and the tile is dropped. `samples_taken` only
// counts, for the display. `mask_of` makes a mask of bits, bit 0 for lane 0,
// and `no_lanes` has none. `sample_in` says which sample a lane has.

// #region render-tile
/// Makes a new path in each `fresh` lane, where SampleQueue::take has left a
/// direction and random numbers. A ray of the camera leaves no shape.
inline void PathTracer::begin(Paths& path, const Mask& fresh) const {
  const Vec3s black(Vec3(0)), white(Vec3(1)), eye(scene_.scene.camera.origin);
  path.ray.origin = select(fresh, eye, path.ray.origin);
  path.ray.origin_slot = select(fresh, no_slot, path.ray.origin_slot);
  path.throughput = select(fresh, white, path.throughput);
  path.sum = select(fresh, black, path.sum);
  path.bounce = select(fresh, 0, path.bounce);
  // direct_light_added is false: step clears it in lanes that end.
}

inline void PathTracer::render_tile(const Tile& tile, Film& film,
                                    const std::atomic<bool>& stop) const {
  SampleQueue samples(tile, scene_.scene.camera, seed_);
  const auto radiance =
      std::make_unique_for_overwrite<Vec3[]>(samples.size());
  std::array<std::size_t, std::size_t{paths_at_once}> sample_in{};
  Paths path{};
  Mask on = no_lanes();
  while (!stop.load(std::memory_order_relaxed)) {
    // Begin a path in each lane that has none.
    unsigned begun = 0;
    for_each_lane(!on, [&](int lane) {
      if (samples.empty()) return;
      sample_in[static_cast<std::size_t>(lane)] =
          samples.take(path.ray.direction, path.random, lane);
      begun |= 1u << lane;
    });
    begin(path, mask_of(begun));
    on = on | mask_of(begun);
    if (!any(on)) break;

    // One step, and store the radiance of the paths that end with it.
    const Mask going_on = step(path, on);
    for_each_lane(on & !going_on, [&](int lane) {
      radiance[sample_in[static_cast<std::size_t>(lane)]] = path.sum[lane];
      ++samples_taken;
    });
    on = going_on;
  }
  if (samples.empty() && !any(on)) samples.add_to(film, radiance.get());
}
// #endregion render-tile

// The other stages answer for a single ray. So does this one, with one lane
// that is on. It is slow, and is there for tests that all stages share.

// #region one-path
inline Vec3 PathTracer::radiance(const Ray& ray, Random& random) const {
  Paths path{};
  Mask on = mask_of(1);
  begin(path, on);
  scene_.shapes.set_ray(path.ray, 0, ray);
  path.random.set(0, random);
  while (any(on)) on = step(path, on);
  random = path.random[0];
  return path.sum[0];
}
// #endregion one-path

// ## What it buys
//
// AVX2 and AVX-512 are names of instruction sets. Their registers hold 8 and
// 16 floats, so a row is two registers of AVX2. The table has stage 5's
// processor time, with AVX2 for its eight shapes, over stage 6's.
//
// | the lab's box, all materials | AVX2 | AVX-512 |
// |---|---|---|
// | under a point light | 4.6 | 6.1 |
// | under its shining ceiling | 3.9 | 4.9 |
//
// Why not 16 times as fast, or 8 with AVX2? Stage 5's search uses the
// registers, too. A division of 16 numbers takes longer than one of a single
// number. Some lanes wait whenever another branch is worked out. And the
// data of 16 lanes does not fit into the registers, so a lot of it is moved
// to memory and back.
//
// From 64 shapes of one type on, the search uses a tree of boxes, and there
// 16 rays take 16 different ways. So each ray searches alone, as in stage 5.
// The rest of a step still works on rows, but with a thousand shapes most of
// the time goes into the search. Little is gained.
//
// See for yourself which registers you have, and what the bits are:
//
//     build/stage6 --version
//     build/stage6 scenes/cornell_box_point.toml -o many.pfm
//     build/stage5 scenes/cornell_box_point.toml -o one.pfm
//     cmp many.pfm one.pfm
//
// If the last line prints nothing, the two files are the same. A build with
// `-DLIGHTWALK_NATIVE=OFF` uses only what every x86-64 has. There stage 6 is
// the same as stage 5, and `--version` says so.
//
// ![](lab-many)
//
// What remains? On a graphics card, with thousands of rows at work, a program
// may collect the paths in queues, by the material that they meet, so that
// all lanes of a row do the same. The name for that is *wavefront path
// tracing* (Laine, Karras, Aila: "Megakernels Considered Harmful", HPG 2013).

}  // namespace lightwalk::stage6

#else  // no rows here

namespace lightwalk::stage6 {
using stage5::PathTracer;
inline constexpr int paths_at_once = 1;
}  // namespace lightwalk::stage6

#endif
