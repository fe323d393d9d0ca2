#pragma once

// # Stage 7: photon mapping
//
// Under a point light, stage 5 paints a glass ball with a dark shadow. Real
// glass gathers the light there in a bright spot, a *caustic*. A path from
// the floor through the ball would have to hit a point, and no path does.
//
// But the *light* has no such trouble. What starts at the point goes through
// the ball, and meets the floor somewhere. So this stage follows light from
// the lamps, and stores where it arrives. A *photon* is here a small share of
// a lamp's power, not the quantum of physics. All stored photons are the
// *photon map* (Jensen, "Global Illumination using Photon Maps", Eurographics
// Workshop on Rendering, 1996).
//
// ![](caustic)
//
// A picture takes two steps. First, photons leave the lamps and walk through
// the scene. Then paths leave the camera, as before. Where a path meets a
// diffuse surface, it asks the lights, as in stage 2. Then it looks for
// photons nearby, and adds their light. There it ends.
//
// ![](two-walks)
//
// Most of the code is there already. Photons walk by stage 3's `sample`,
// stage 4's `choose_lobe` and stage 5's `material_at`. Only three things are
// new: how light starts, what a photon carries, and how many stored photons
// become one radiance.

#include <memory>

#include "common/render/render.hpp"
#include "stages/5_fresnel_textures/path_tracer.hpp"
#include "stages/7_photon_mapping/photons/kd_tree.hpp"

namespace lightwalk::stage7 {

using stage1::BsdfSample;
using stage1::emitted;
using stage1::evaluate;
using stage1::sample_cosine_hemisphere;
using stage2::already_counted;
using stage2::direct_light;
using stage3::Lobe;
using stage3::relative_eta;
using stage3::sample;
using stage4::choose_lobe;
using stage4::lobe_probabilities;
using stage4::LobeChoice;
using stage5::material_at;

// A path from the camera carries a *throughput*: what would become of light
// that it finds. A photon carries *power*, in watts: light that is there.

// #region photon
struct Photon {
  Vec3 position;
  Vec3 power;   ///< W
  Vec3 normal;  ///< unit, of the surface, on the side that was lit
  int bounces;  ///< before it came here, at least 1
};

using PhotonMap = KdTree<Photon>;
// #endregion photon

// ## How much power a lamp has
//
// A point light has the intensity $I$, in watts per steradian, in all
// directions. The whole sphere has $4\pi$ steradians, so its power is
// $\Phi = 4\pi I$.
//
// A lamp of area $A$ has the radiance $L_e$: power per solid angle, and per
// area that is *held perpendicular*. Seen at the angle $\theta$ the lamp is
// narrower by $\cos\theta$. So a unit of its area sends out $\int_\Omega L_e
// \cos\theta\,d\omega$. Stage 1 computed this integral: the cosine alone
// gives $\pi$.
//
// $$\Phi = \pi A L_e$$
//
// The rectangle's area is the length of $u \times v$, as in stage 2. The
// sphere's is $4\pi r^2$. Check it from far away: one sees a disk $\pi r^2$,
// so the intensity is $\pi r^2 L_e$. $4\pi$ times that is the same.
//
// Write `power_of`. A `Light` is one of three forms, and `std::get_if` gives
// a pointer to the form, or null.

// #region power
/// The power that the light sends out, W.
inline Vec3 power_of(const Light& light) {
  const auto* point = std::get_if<PointLight>(&light.form);
  const auto* rectangle = std::get_if<RectangleLight>(&light.form);
  const auto* sphere = std::get_if<SphereLight>(&light.form);
  // #region exercise 7.1: power of a light
  // #stub return Vec3(0);
  if (point) return 4 * pi * point->intensity;
  if (rectangle) {
    const float area = length(cross(rectangle->edge_u, rectangle->edge_v));
    return pi * area * rectangle->radiance;
  }
  const float area = 4 * pi * sphere->radius * sphere->radius;
  return pi * area * sphere->radiance;
  // #endregion
}
// #endregion power

// ## How a photon starts
//
// Each photon of a lamp shall carry the same power. Then *how many* photons
// go somewhere says how much light goes there. So the density of starting
// points and directions must be that of the lamp's power.
//
// A point light sends equal power into all directions. They must be uniform
// on the sphere. That is stage 1's inversion, with the density
// $\frac{1}{4\pi}$, and up to $\pi$ instead of $\pi/2$:
//
// $$P(\theta) = \int_0^\theta \tfrac{1}{2} \sin t\,dt
// = \frac{1 - \cos\theta}{2} = \xi
// \quad\Rightarrow\quad \cos\theta = 1 - 2\xi$$
//
// A lamp with a surface sends $L_e \cos\theta$ into each direction, per solid
// angle and area. So its points are uniform on the area, and its directions
// have the density $\cos\theta/\pi$. That is stage 1's
// `sample_cosine_hemisphere` about the lamp's normal. Uniform directions
// would need a weight of $2\cos\theta$, and the photons would be unequal.
//
// ![](photon-start)
//
// Write `sample_sphere`. It needs no basis.

// #region emit
/// A unit vector, with density 1/(4 pi) per solid angle. `u` is uniform in
/// [0, 1)^2.
inline Vec3 sample_sphere(const Vec2& u) {
  // #region exercise 7.2: all directions
  // #stub return {0, 0, 1};
  const float cos_theta = 1 - 2 * u.x;
  const float sin2_theta = 1 - cos_theta * cos_theta;
  const float sin_theta = std::sqrt(std::max(0.0f, sin2_theta));
  const float phi = two_pi * u.y;
  return {sin_theta * cos(phi), sin_theta * sin(phi), cos_theta};
  // #endregion
}

/// Where a photon starts: on a light, with the light's normal there. A point
/// light has none, and the direction stands for it.
struct Emission {
  Vec3 position, normal, direction;
};

inline Emission emit(const PointLight& light, Random& random) {
  const Vec3 direction = sample_sphere(random.uniform_2d());
  return {light.center, direction, direction};
}

inline Emission emit(const RectangleLight& light, Random& random) {
  const Vec2 u = random.uniform_2d();
  const Vec3 point = light.corner + u.x * light.edge_u + u.y * light.edge_v;
  const Vec3 normal = normalize(cross(light.edge_u, light.edge_v));
  const Vec2 v = random.uniform_2d();
  return {point, normal, sample_cosine_hemisphere(normal, v)};
}

inline Emission emit(const SphereLight& light, Random& random) {
  const Vec3 normal = sample_sphere(random.uniform_2d());
  const Vec2 v = random.uniform_2d();
  return {light.center + light.radius * normal, normal,
          sample_cosine_hemisphere(normal, v)};
}
// #endregion emit

// With several lamps, each photon draws its lamp. The probability $p$ is in
// proportion to the lamp's power, in its largest channel. This is stage 4's
// bar, with lamps for events. Say that $N$ photons leave in all. A lamp gets
// about $pN$ of them, and together they carry its $\Phi$:
//
// $$\Phi_{photon} = \frac{\Phi}{p\,N}$$
//
// $N$ counts the photons that *leave*. Those that escape through the open
// front of the box have taken their power with them. To divide by the number
// of stored photons is a common mistake: the lab's box is then four times
// too dark.

// #region lamps
/// A light that photons leave.
struct Lamp {
  const Light* light;
  Vec3 power;         ///< W
  float probability;  ///< of being drawn
  Hit surface;        ///< what all its points have in common
};

/// The lamps of a scene; none if they have no power.
inline std::vector<Lamp> lamps_of(const Scene& scene) {
  std::vector<Lamp> lamps;
  float sum = 0;
  for (const Light& light : scene.lights) {
    Hit surface{};
    surface.slot = no_slot;
    scene.geometry.for_each_shape([&](const auto&, const Hit& hit) {
      if (hit.light == &light) surface = hit;
    });
    const Vec3 power = power_of(light);
    lamps.push_back({&light, power, max_component(power), surface});
    sum += max_component(power);
  }
  if (!(sum > 0)) return {};
  for (Lamp& lamp : lamps) lamp.probability /= sum;
  return lamps;
}

/// Draws a lamp by `xi`, uniform in [0, 1).
inline const Lamp& choose_lamp(const std::vector<Lamp>& lamps, float xi) {
  for (const Lamp& lamp : lamps) {
    if (xi < lamp.probability) return lamp;
    xi -= lamp.probability;
  }
  return lamps.front();  // only by rounding
}

/// The power of one photon of the lamp, W, if `photons` leave all lamps.
inline Vec3 photon_power(const Lamp& lamp, int photons) {
  // #region exercise 7.3: power of a photon
  // #stub return Vec3(0);
  return lamp.power / (lamp.probability * static_cast<float>(photons));
  // #endregion
}
// #endregion lamps

// ## How a photon walks
//
// At a surface the photon draws an event, as a path does: diffuse, specular,
// refraction, or absorbed. Its power is multiplied by the weight over the
// probability. A diffuse weight is $k_d$, whichever way light goes, since
// $f_r$ is the same if the two directions are exchanged. The same holds for
// a mirror.
//
// For refraction it does not. Stage 3 has derived, for radiance,
//
// $$L_o = k_t \left(\frac{\eta_o}{\eta_i}\right)^2 L_i$$
//
// The square is there because glass squeezes the same light into a smaller
// solid angle. Radiance is power *per solid angle*, so it grows. The power
// itself does not: of 100 W that meet the surface, $100\,k_t$ watts are
// behind it. A photon that goes in keeps its power, apart from $k_t$. Where
// photons are squeezed, there are *more of them* per solid angle. They do by
// their number what the square does for radiance (Veach 1997, section 5.2).
//
// ![](squeezed-light)
//
// `sample` has multiplied by the square of `relative_eta(surface)`. So
// `power_weight` divides by it. It gets the surface and stage 3's sample. If
// `next.wi` is behind the surface, the light was refracted. `surface.normal`
// is on the side that the light came from. Total internal reflection stays in
// front, and had no square.
//
// A ball hides the mistake: what goes in comes out, and the two squares
// cancel. A floor in glass or under water shows it.

// #region power-weight
/// What is left of the power of light that came from `surface.wo` and goes on
/// in `next.wi`: f_r cos(theta) / p, without the square in refraction.
inline Vec3 power_weight(const Surface& surface, const BsdfSample& next) {
  // #region exercise 7.4: power through glass
  // #stub return Vec3(0);
  if (dot(next.wi, surface.normal) > 0) return next.weight;
  const float eta_ratio = relative_eta(surface);
  return next.weight / (eta_ratio * eta_ratio);
  // #endregion
}
// #endregion power-weight

// Where is the photon stored? Wherever the surface has a diffuse lobe: a
// mirror needs light from just one direction, and no photon has it. But it is
// not stored where it comes straight from the lamp, after 0 bounces. That is
// direct light, which shadow rays bring without blur. What is stored is the
// power that *arrives*. The albedo comes later, when a path asks.
//
// One photon is stored many times, once for each diffuse surface that it
// meets. This is right: its light arrives at each of them. In the lab's box
// 100,000 photons are stored 407,000 times.
//
// ![](photons)
//
// Write the walk. `bounce` counts from 0. Store by `stored.push_back`; the
// order of a `Photon` is position, power, normal, bounces, and the normal is
// `surface.normal`. Then draw the event, as in stage 4, and return if there
// is none. Else take a direction, change `power` and `ray`.

// #region follow
/// Follows the photon along `ray`, and stores it at diffuse surfaces.
inline void follow_photon(const Scene& scene, const RenderSettings& settings,
                          Ray ray, Vec3 power, Random& random,
                          std::vector<Photon>& stored) {
  for (int bounce = 0; bounce < settings.max_bounces; ++bounce) {
    // Find the next surface.
    const std::optional<Hit> hit = scene.nearest_hit(ray);
    if (!hit) return;
    const Material material = material_at(scene, *hit, -ray.direction);
    const Surface surface(*hit, material, -ray.direction);
    if (surface.material.emits()) return;

    // #region exercise 7.5: walk of a photon
    // #stub return;
    // Store the photon, unless it is direct light.
    if (bounce > 0 && !is_black(surface.material.kd)) {
      stored.push_back({hit->position, power, surface.normal, bounce});
    }

    // Draw an event.
    const std::optional<LobeChoice> choice = choose_lobe(
        lobe_probabilities(surface.material, bounce), random.uniform());
    if (!choice) return;

    // Go on in a direction of the event's lobe.
    const BsdfSample next =
        sample(choice->lobe, surface, settings.sampling, random);
    power *= power_weight(surface, next) / choice->probability;
    ray = spawn_ray(*hit, next.wi);
    // #endregion
  }
}
// #endregion follow

// `trace_photons` makes a map. Photon $i$ has random numbers of its own, by
// its number and the map's. The photons are shared out among the threads, a
// thousand at a time, and put together in order. So the map has the same
// bits with any number of threads. (`~seed` flips the seed's bits: no photon
// shall have the numbers of a pixel.)

// #region trace
/// Map number `map` of the scene's photons. It is incomplete after `stop`.
inline PhotonMap trace_photons(const Scene& scene,
                               const RenderSettings& settings,
                               std::uint64_t map,
                               const std::atomic<bool>& stop,
                               RenderProgress& progress) {
  const std::vector<Lamp> lamps = lamps_of(scene);
  if (lamps.empty()) return {};
  const int part = 1000;
  const int parts = (settings.photons - 1) / part + 1;
  std::vector<std::vector<Photon>> stored(static_cast<std::size_t>(parts));
  const auto trace_part = [&](std::int64_t number) {
    const int first = static_cast<int>(number) * part;
    const int last = first + std::min(part, settings.photons - first);
    for (int i = first; i < last; ++i) {
      Random random(~settings.seed, static_cast<std::uint64_t>(i), map);
      const Lamp& lamp = choose_lamp(lamps, random.uniform());
      const Emission start =
          std::visit([&](const auto& form) { return emit(form, random); },
                     lamp.light->form);
      Hit from = lamp.surface;
      from.position = start.position;
      from.normal = start.normal;
      from.rounding = flat_rounding * max_abs_component(start.position);
      follow_photon(scene, settings, spawn_ray(from, start.direction),
                    photon_power(lamp, settings.photons), random,
                    stored[static_cast<std::size_t>(number)]);
    }
  };
  share_out(parts, thread_count(settings.threads), stop, progress,
            trace_part);
  std::vector<Photon> all;
  for (const std::vector<Photon>& some : stored) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return PhotonMap(std::move(all));
}
// #endregion trace

// ## From photons to radiance
//
// Draw a disk of radius $r$ on the surface, around the point $x$. Add the
// power of the photons in it, and divide by its area. That is power per area
// that arrives at $x$, the *irradiance*. Times the BRDF it is the radiance
// that leaves:
//
// $$L_o \approx f_r\,\frac{1}{\pi r^2} \sum_{j} \Phi_j$$
//
// There is no cosine: slanted photons are spread over more surface already.
//
// ![](photon-disk)
//
// Which $r$? A small disk has few photons, and their number is noisy. A large
// disk blurs the picture. This is a *bias*: more paths do not remove it. So
// let the photons decide. Go out from $x$ until $k$ photons are found, and
// let $r$ be the distance to the last. Where light is, the disk is small.
//
// ![](neighbors)
//
// The $k$-th photon is *on* the rim. It has set the radius, and must not
// count. Let there be $\lambda$ photons per area. The disk up to the $k$-th
// has an area $A$ with a gamma distribution, and the mean of $1/A$ is
// $\lambda/(k - 1)$. So $k - 1$ photons over $A$ have the mean $\lambda$.
// `walk` visits photons *nearer* than the limit, so the rim is left out. The
// relative variance is $1/(k - 2)$: by the box, 50 photons have 14 % noise.
//
// ![](density-estimate)
//
// Which photons count? Two conditions:
//
// - They are on a surface that faces the same way, to 60 degrees. Behind a
//   thin wall it may be dark, and around a corner the light is another one.
// - The light has at most `max_bounces` bounces in all: those of the photon,
//   those of the path, and the one here.
//
// A *filter* gives near photons more weight than far ones. Then an edge is
// sharper. The weights must have the mean 1 over the disk. The *cone* falls
// to 0 at the rim. Let $t$ be the distance in radii. A ring has the area
// $2\pi t\,dt$, so the mean of $1 - t$ is $\frac{1}{\pi}\int_0^1 (1 - t)\,
// 2\pi t\,dt = \frac{1}{3}$. The weight is $3(1 - t)$. The *box* is 1
// everywhere.
//
// Write `filter_weight` and `estimate`. `map.walk(x, limit, visit)` calls
// `visit(photon, squared_distance)` for each photon whose squared distance is
// below `limit`; `visit` returns the limit.

// #region estimate
/// How much a photon counts at `t` radii from the middle of the disk.
inline float filter_weight(Filter filter, float t) {
  // #region exercise 7.6: filters
  // #stub return 0;
  return filter == Filter::box ? 1 : 3 * (1 - t);
  // #endregion
}

/// Whether a photon of at most `most` bounces brings light to the surface.
inline bool counts(const Photon& photon, const Surface& surface, int most) {
  return photon.bounces <= most && dot(photon.normal, surface.normal) > 0.5f;
}

/// Radiance of the diffuse lobe toward `wo` by the photons that are nearer
/// than the radius, W/(m^2 sr).
inline Vec3 estimate(const PhotonMap& map, const Surface& surface, int most,
                     float squared_radius, Filter filter) {
  Vec3 power(0);
  std::size_t count = 0;
  // #region exercise 7.7: density estimate
  // #stub const Vec3 radiance(0);
  map.walk(surface.hit.position, squared_radius,
           [&](const Photon& photon, float squared_distance) {
             if (counts(photon, surface, most)) {
               const float t = std::sqrt(squared_distance / squared_radius);
               power += filter_weight(filter, t) * photon.power;
               ++count;
             }
             return squared_radius;
           });
  const Vec3 irradiance = power / (pi * squared_radius);
  const Vec3 radiance = evaluate(surface.material) * irradiance;
  // #endregion
  note_photons({count, std::sqrt(squared_radius), radiance});
  return radiance;
}
// #endregion estimate

// ## Finding the neighbors
//
// A look at each of 400,000 photons for each sample would take minutes. A
// *k-d tree* finds the near ones in a few hundred steps. It is in
// `photons/kd_tree.hpp`, a page to read.
//
// ## Right in the limit
//
// With one map the picture is wrong, and more samples of the pixels do not
// help. There is noise from the photons, which looks like stains, and bias
// from the radius. More photons remove both, but must all be in memory.
//
// *Progressive photon mapping* makes one map after the other, and forgets
// each (Hachisuka, Ogaki, Jensen, ACM TOG 27(5), 2008). The picture is the
// mean of them all. That removes the noise. To remove the bias, too, the
// radius shrinks from map to map.
//
// How fast? Say that $N$ photons have been kept so far in a disk of radius
// $R$, and that a new map brings $M$ more. Keep only the fraction $\alpha$ of
// the new ones, and shrink the disk such that the density stays what was
// measured:
//
// $$\frac{N + M}{R^2} = \frac{N + \alpha M}{R'^2}
// \quad\Rightarrow\quad \frac{R'^2}{R^2} = \frac{N + \alpha M}{N + M}$$
//
// With $\alpha = 1$ the radius stays, and with $\alpha = 0$ the number of
// photons does. Between them the radius goes to 0, and the photons become
// infinitely many. Where the light is even, the $i$ maps so far have left as
// many photons in this disk as $i$ new maps would: $N = iM$. Then
//
// $$\frac{R'^2}{R^2} = \frac{i + \alpha}{i + 1}$$
//
// Knaus and Zwicker ("Progressive Photon Mapping: A Probabilistic Approach",
// ACM TOG 30(3), 2011) take this ratio everywhere. So nothing has to be
// remembered but $i$, and each map is a sample like any other: the film takes
// the mean. Only the first radius is measured, as the distance to the $k$-th
// photon of a first map. That map is used for nothing else. So the radius
// does not depend on the photons that are counted, and they all count.
//
// Which $\alpha$? $R^2$ falls like $i^{\alpha - 1}$, and the variance of a
// map is about $1/R^2$. So the mean of $n$ maps has the variance
// $\frac{1}{n^2}\sum i^{1 - \alpha}$, about $n^{-\alpha}$. The bias falls
// like $R^2$, so its square like $n^{2\alpha - 2}$. In the end both fall
// equally fast if $\alpha = 2/3$. The error then falls like $n^{-1/3}$: half
// of it takes eight times the maps; a path tracer takes four times the paths.
//
// ![](bias-and-noise)

// #region shrink
/// The share of the new photons that is kept.
inline constexpr double alpha = 2.0 / 3;

/// The square of the next radius, in squares of the first one, if it was
/// `squared_scale` in the last of `maps` maps.
inline double next_squared_scale(double squared_scale, std::uint32_t maps) {
  // #region exercise 7.8: the next radius
  // #stub return squared_scale;
  return squared_scale * (maps + alpha) / (maps + 1.0);
  // #endregion
}
// #endregion shrink

// ![](passes)
//
// ## The path
//
// The loop is stage 5's. At a surface with a diffuse lobe, the lights *and*
// the photons are asked, and nothing is divided by a probability. Together
// they bring all light of the lamps by the diffuse lobe. So a diffuse event
// ends the path, and only mirrors and glass lead on. An emitter that they
// lead to counts: there no light was asked, and no photon was stored.
//
// But no photon starts on a plane that emits: it has no end. Its light, and
// that of triangles, is found as in stage 5: where there are any,
// `paths_go_on_` is true, and a diffuse event does not end the path. From
// then on it has `gathered`, also behind mirrors: it asks no more, and
// `already_counted` keeps out the lamps that it meets.
//
// Write the end of the loop, after the emitters. `ask_photons(surface,
// bounce)` gives the photons' radiance.

// #region path
class PathTracer {
 public:
  /// With one map, whose radius does not shrink.
  PathTracer(const Scene& scene, const RenderSettings& settings)
      : PathTracer(scene, settings, nullptr, nullptr, 1) {
    map_ = first_map_ = trace(scene, settings, 0);
  }

  /// As `render` has it for one sample of all pixels.
  PathTracer(const Scene& scene, const RenderSettings& settings,
             std::uint32_t sample)
      : PathTracer(scene, settings, trace(scene, settings, 0),
                   trace(scene, settings, std::uint64_t{sample} + 1),
                   squared_scale_of(sample)) {}

  /// Radiance that comes back along the ray, as one path sees it.
  Vec3 radiance(Ray ray, Random& random) const {
    Vec3 sum(0);
    Vec3 throughput(1);
    bool gathered = false;
    for (int bounce = 0;; ++bounce) {
      // Find the next surface.
      const std::optional<Hit> hit = scene_.nearest_hit(ray);
      if (!hit) return sum;
      const Material material = material_at(scene_, *hit, -ray.direction);
      const Surface surface(*hit, material, -ray.direction);
      log_vertex(surface, throughput, sum, bounce);

      // An emitter ends the path, and counts if it has not been counted.
      if (surface.material.emits()) {
        if (!already_counted(surface, gathered)) {
          sum += throughput * emitted(surface);
        }
        return sum;
      }
      if (bounce == settings_.max_bounces) return sum;

      // #region exercise 7.9: the loop with photons
      // #stub return sum;
      // Ask the lights and the photons, for the diffuse lobe.
      if (!gathered && !is_black(surface.material.kd)) {
        sum += throughput * (direct_light(scene_, surface, random) +
                             ask_photons(surface, bounce));
      }

      // Draw an event; a diffuse one is done.
      const std::optional<LobeChoice> choice = choose_lobe(
          lobe_probabilities(surface.material, bounce), random.uniform());
      if (!choice) return sum;
      gathered = gathered || choice->lobe == Lobe::diffuse;
      if (gathered && !paths_go_on_) return sum;

      // Go on in a direction of the event's lobe.
      const BsdfSample next =
          sample(choice->lobe, surface, settings_.sampling, random);
      throughput *= next.weight / choice->probability;
      ray = spawn_ray(*hit, next.wi);
      // #endregion
    }
  }

  /// Takes each pixel's samples, one pass over the picture with each map.
  static void render(const Scene& scene, const RenderSettings& settings,
                     Film& film, const std::atomic<bool>& stop,
                     RenderProgress& progress) {
    const auto trace = [&](std::uint64_t map) {
      return std::make_shared<PhotonMap>(
          trace_photons(scene, settings, map, stop, progress));
    };
    const int threads = thread_count(settings.threads);
    const auto first_map = trace(0);
    std::uint32_t sample = settings.first_sample;
    double squared_scale = squared_scale_of(sample);
    for (int i = 0; i < settings.samples_per_pixel; ++i, ++sample) {
      const auto map = trace(std::uint64_t{sample} + 1);
      if (stop) return;
      const PathTracer tracer(scene, settings, first_map, map, squared_scale);
      render_pass(
          [&](const Tile& tile, Film& into, const std::atomic<bool>& ended) {
            render_tile(tracer, scene, settings.seed, tile, into, ended);
          },
          film, sample, sample + 1, threads, stop, progress);
      squared_scale = next_squared_scale(squared_scale, sample + 1);
    }
  }

 private:
  using Map = std::shared_ptr<const PhotonMap>;

  PathTracer(const Scene& scene, const RenderSettings& settings, Map first,
             Map map, double squared_scale)
      : scene_(scene),
        settings_(settings),
        first_map_(std::move(first)),
        map_(std::move(map)),
        squared_scale_(static_cast<float>(squared_scale)) {
    scene.geometry.for_each_shape([&](const auto&, const Hit& hit) {
      paths_go_on_ = paths_go_on_ || (hit.material->emits() && !hit.light);
    });
  }

  static Map trace(const Scene& scene, const RenderSettings& settings,
                   std::uint64_t map) {
    const std::atomic<bool> stop{false};
    RenderProgress progress;
    return std::make_shared<PhotonMap>(
        trace_photons(scene, settings, map, stop, progress));
  }

  static double squared_scale_of(std::uint32_t sample) {
    double squared_scale = 1;
    for (std::uint32_t i = 1; i <= sample; ++i) {
      squared_scale = next_squared_scale(squared_scale, i);
    }
    return squared_scale;
  }

  Vec3 ask_photons(const Surface& surface, int bounce) const {
    const int most = settings_.max_bounces - bounce - 1;
    const float first = first_map_->squared_distance_to(
        static_cast<std::size_t>(settings_.neighbors), surface.hit.position,
        settings_.radius * settings_.radius,
        [&](const Photon& photon) { return counts(photon, surface, most); });
    if (first == 0) return Vec3(0);  // There is no photon.
    return estimate(*map_, surface, most, squared_scale_ * first,
                    settings_.filter);
  }

  const Scene& scene_;
  RenderSettings settings_;
  Map first_map_, map_;
  float squared_scale_;
  bool paths_go_on_ = false;  ///< for emitters that are not lights
};
// #endregion path

// `ask_photons` goes out to the `--neighbors`, 50 if not given, but not
// beyond `--radius`. Here it is in the shadow of the blue ball:
//
//     $ build/stage7 scenes/cornell_box_point.toml --pixel 60,230
//     ...
//     vertex 0: plane[2] of 'white', bounce 0
//     ...
//       light      (  0.3972,   0.9042,  -0.1569)  at 1.659: blocked
//       photons    (   0.097,    0.038,    0.047) ...
//     ...
//       ends       here: the photons have brought the rest
//     ...
//
// ## What remains
//
// At an edge, part of the disk hangs over, and no photon can be there. So
// edges and corners are a little dark, until the radius is small. Where there
// are few photons, stains remain for long. *Final gathering* hides them: it
// follows one more diffuse bounce, and asks the photons there (Jensen 1996).
// In most rooms paths are better than photons, but a caustic needs photons.
// *Vertex connection and merging* uses each where it is good (Georgiev et
// al., ACM TOG 31(6), 2012).
//
// Paint the box with `--neighbors 10`, then `--radius 0.01`: what happens?

}  // namespace lightwalk::stage7
