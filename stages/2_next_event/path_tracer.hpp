#pragma once

// # Stage 2: next-event estimation
//
// Stage 1 adds light only when a path happens to hit a lamp. How often does
// that happen? The lamp of the box is a square of side 0.6 under the ceiling,
// so its area is $A = 0.36$. The middle of the floor is $d = 1.99$ below it.
// Seen from there, the lamp fills a solid angle of about $A/d^2$. (At a
// distance $d$ an area looks $d^2$ times smaller; more on this below.) Near
// the normal, cosine sampling has the density $1/\pi$. The probability of
// hitting the lamp is this density times the solid angle:
//
// $$\frac{1}{\pi} \cdot \frac{A}{d^2} = \frac{0.36}{\pi \cdot 1.99^2}
// \approx 0.03$$
//
// So 97 of 100 paths bring nothing from this first bounce, and 3 bring a lot.
// That is *variance*, and it looks like bright specks. A smaller lamp makes
// it worse. A *point light* has no area at all: no path ever hits it, and
// stage 1 does not even read a scene that has one.
//
// But the program knows where the lights are. So at each surface, ask them
// directly: choose a point on the light, and follow a *shadow ray* to it. If
// nothing is in the way, add the light that comes along this line. This is
// *next-event estimation*, or direct light sampling.
//
// ![](stage-1-or-2)
//
// ## The integral in two parts
//
// The names are chapter 1's; $L_s$ is new. Look from $x$ in the direction
// $\omega_i$. The ray meets the next surface at the point $y$. In clear air,
// what arrives at $x$ is what leaves $y$. And that is what $y$ emits plus
// what $y$ scatters:
//
// $$L_i(x, \omega_i) = L_o(y, -\omega_i) =
// \textcolor[RGB]{194,90,34}{L_e(y, -\omega_i)} +
// \textcolor[RGB]{58,123,200}{L_s(y, -\omega_i)}$$
//
// Put this sum into the rendering equation. An integral of a sum is a sum of
// integrals. So the light that $x$ scatters has two parts. Inside the
// integrals, $L_e$ and $L_s$ are taken at $y$, toward $x$:
//
// $$L_s(x, \omega_o) =
// \textcolor[RGB]{194,90,34}{\underbrace{\int_\Omega L_e\,f_r
// \cos\theta\,d\omega_i}_{\text{direct light}}} +
// \textcolor[RGB]{58,123,200}{\underbrace{\int_\Omega L_s\,f_r
// \cos\theta\,d\omega_i}_{\text{indirect light}}}$$
//
// ![](split)
//
// Now each part can have its own *estimator*, the one that suits it:
//
// - **Direct light.** $L_e$ is 0 except toward what shines. So choose only
//   directions that lead to a light.
// - **Indirect light.** $L_s$ can come from anywhere. So choose a direction
//   as in stage 1, and go on.
//
// The second estimator needs care. Its path may hit a lamp by chance. The
// lamp's $L_e$ belongs to the first integral, which has it already if the
// lamp was asked. Then it must not be added again.
//
// ![](next-event)

#include "stages/1_diffuse/path_tracer.hpp"

namespace lightwalk::stage2 {

using stage1::BsdfSample;
using stage1::emitted;
using stage1::evaluate;
using stage1::sample;

// ## What a light answers
//
// To ask a light is to draw one direction $\omega$ toward it, with a density
// $p(\omega)$ per solid angle. The Monte Carlo estimate of the direct light
// is then the integrand over the density:
//
// $$\frac{L_e\,f_r \cos\theta}{p(\omega)} =
// \underbrace{f_r \cos\theta}_{\text{the surface}} \cdot
// \underbrace{\frac{L_e}{p(\omega)}}_{\text{the light}}$$
//
// The surface knows the first two factors. The light knows the last one, and
// this is the `weight` of its answer. (It is not the weight of a bounce,
// which has the surface's factors in it.) $1/p$ is in steradians. So the
// weight is radiance times solid angle, and its unit is $\mathrm{W/m^2}$.
//
// A `LightSample` is the answer: the weight, the direction, and the distance.
// The shadow ray needs the distance, because what lies *behind* the light
// casts no shadow.
//
// > *Rounding.* A computed distance is wrong in its last digits. So for a
// > lamp with a surface, `distance` is a little more than the distance to the
// > lamp: the factor is `1 + distance_rounding`. That is $2^{-18}$ more, 4
// > parts in a million. If it were a little less, what lies just before the
// > lamp would cast no shadow. The shadow ray may pass the lamp a little.
// > That is harmless, since `reaches`, below, looks no farther than the
// > first hit, and that is the lamp.

// #region light-sample
struct LightSample {
  Vec3 direction;  ///< unit, from the surface to the light
  Vec3 weight;     ///< W/m^2 on a surface that faces the light
  float distance;  ///< how far the shadow ray looks
};

/// A bound on the relative rounding error of a distance.
inline constexpr float distance_rounding = 0x1p-18f;
// #endregion light-sample

// ## A point light
//
// A point light shines equally in all directions. Its *intensity* $I$ is its
// power per solid angle, in watts per steradian (W/sr). A steradian is the
// solid angle that covers an area of 1 on a sphere of radius 1. On a sphere
// of radius $d$ it covers an area of $d^2$. So a surface that faces the light
// at the distance $d$ receives, in $\mathrm{W/m^2}$,
//
// $$\text{weight} = \frac{I}{d^2}$$
//
// There is one direction only, so nothing is random. (This weight is
// $L_e/p(\omega)$ in a limit, which comes below.) In the code $I$ is
// `light.intensity`, and the light is at `light.center`. The lab calls $I$
// the light's power. But it is per steradian, so nothing is divided by
// $4\pi$. `const Vec2&` has no name below, because it is not used.
//
// The core has what the code needs: `dot(a, b)`, `length(v)` and
// `normalize(v)` for vectors, `std::sqrt`, and `cos`, `sin` and `two_pi` for
// angles.
//
// ![](inverse-square)
//
// The answer's distance is a little less than $d$. You need not work it out.
// Copy it, with `distance` for $d$:
//
//     distance - distance_rounding / 2 *
//         (distance + max_abs_component(light.center))
//
// > *Rounding.* No ray can hit a point. But a point light may lie exactly in
// > the plane of a ceiling, and then the ceiling must not be in the way. So
// > here the shadow ray ends a little *before* the light. Rounding grows with
// > $d$ and with the coordinates. So $d$ is reduced by `distance_rounding`
// > times the mean of two numbers: $d$, and the largest absolute value of the
// > light's coordinates.

// #region point-light
inline LightSample sample_light(const PointLight& light, const Vec3& x,
                                const Vec2&) {
  // #region exercise 2.1: point light
  // #stub return {{0, 0, 1}, Vec3(0), 0};
  const Vec3 to_light = light.center - x;
  const float squared_distance = dot(to_light, to_light);
  const float distance = std::sqrt(squared_distance);
  const float size = distance + max_abs_component(light.center);
  return {to_light / distance, light.intensity / squared_distance,
          distance - distance_rounding / 2 * size};
  // #endregion
}
// #endregion point-light

// ## A rectangle that shines
//
// Choose the point `corner + u.x * edge_u + u.y * edge_v`, where `u` is a
// pair of random numbers in $[0, 1)$. It is uniform on the lamp's area $A$.
// So its density is known: $p_A = 1/A$. But this is a density per *area*. The
// weight needs one per *solid angle*, because the integral is over
// directions.
//
// Take a small patch $dA$ of the lamp, and ask what solid angle $d\omega$ it
// fills when seen from $x$.
//
// 1. The patch may be tilted. Let $\theta'$ be the angle between the lamp's
//    normal $n'$ and the line back to $x$. Seen from $x$, the patch looks as
//    large as a patch of area $\cos\theta'\,dA$ that faces $x$.
// 2. Project it onto the sphere of radius 1 around $x$. All lengths shrink by
//    $d$, so the area shrinks by $d^2$. And area on this sphere *is* solid
//    angle.
//
// $$d\omega = \frac{\cos\theta'\,dA}{d^2}$$
//
// ![](area-to-angle)
//
// The chance of choosing this patch is the same, in whatever unit it is
// measured. It is $p_A\,dA$, and it is $p(\omega)\,d\omega$:
//
// $$p(\omega)\,d\omega = p_A\,dA \quad\Rightarrow\quad p(\omega) =
// p_A\,\frac{dA}{d\omega} = \frac{1}{A} \cdot \frac{d^2}{\cos\theta'}$$
//
// So the weight is
//
// $$\frac{L_e}{p(\omega)} = L_e\,\frac{A\,\cos\theta'}{d^2}$$
//
// Do not mix up the two cosines. The lamp's $\cos\theta'$ comes from the
// change of density, and it is in the weight. The surface's $\cos\theta$ is
// in the rendering equation, and `direct_light` multiplies by it below.
//
// Each of the three factors can be forgotten. Here is how that looks. Only
// the picture without $A$ keeps the right shape. It is the dangerous one,
// because nothing in it looks wrong: it would be right for a lamp of area 1.
//
// ![](lamp-mistakes)
//
// What the code needs: $L_e$ is `light.radiance`. The edges are
// `light.edge_u` and `light.edge_v`. Their product `cross(edge_u, edge_v)`
// is perpendicular to the lamp. Its `length` is the area $A$, also for a
// parallelogram. Divided by its length it is $n'$. The direction $\omega$
// leads *to* the lamp, so $\cos\theta' = -n' \cdot \omega$. Behind the lamp
// this is negative. The back is black, so use 0 there, by `std::max`. As
// said above, `distance` is $d$ times `1 + distance_rounding`.

// #region rectangle-light
inline LightSample sample_light(const RectangleLight& light, const Vec3& x,
                                const Vec2& u) {
  // #region exercise 2.2: rectangle light
  // #stub return {{0, 0, 1}, Vec3(0), 0};
  const Vec3 point = light.corner + u.x * light.edge_u + u.y * light.edge_v;
  const Vec3 area_vector = cross(light.edge_u, light.edge_v);
  const float area = length(area_vector);
  const Vec3 normal = area_vector / area;
  const Vec3 to_light = point - x;
  const float squared_distance = dot(to_light, to_light);
  const float distance = std::sqrt(squared_distance);
  const Vec3 direction = to_light / distance;
  const float cos_light = std::max(0.0f, -dot(normal, direction));
  return {direction, light.radiance * (area * cos_light / squared_distance),
          distance * (1 + distance_rounding)};
  // #endregion
}
// #endregion rectangle-light

// ## A point light is a lamp that has shrunk
//
// A lamp of area $A$ that faces $x$ has $\cos\theta' = 1$ and the weight
// $L_e A/d^2$. Shrink it, and raise its radiance so that $L_e A$ stays the
// same. Then the weight at $x$ stays the same, too. Let $A$ go to 0. The lamp
// becomes a point, and the product is its intensity $I$:
//
// $$\frac{L_e\,A}{d^2} \to \frac{I}{d^2}
// \qquad \text{with } L_e\,A \to I$$
//
// In the limit, the radiance $L_e$ is infinite and the density $p(\omega)$
// is, too. Neither is a number that a program could hold. Only their
// quotient, the weight, has a limit. So a `PointLight` stores $I$. One
// difference remains: a flat lamp shines with $\cos\theta'$, and the point
// light shines equally in all directions.
//
// ![](shrinking-lamp)
//
// ## A sphere that shines
//
// A uniform point on the sphere's area would be right here, too, but
// wasteful. From $x$, at the distance $d$ from the center, only a cap of the
// sphere is visible. Its edge is where the lines of sight touch the sphere.
// There the radius is perpendicular to the line, so the angle $\alpha$ at the
// center has $\cos\alpha = r/d$. Seen from the center, the cap
// fills the solid angle $2\pi \int_0^\alpha \sin\theta\,d\theta = 2\pi\,(1 -
// \cos\alpha)$ of the sphere's $4\pi$. So its share of the area is
//
// $$\frac{1 - \cos\alpha}{2} = \frac{1}{2}\left(1 - \frac{r}{d}\right)$$
//
// This is always less than half. At $d = 2r$ it is a quarter: three of four
// points would bring nothing.
//
// ![](visible-share)
//
// So choose *directions* instead, uniformly in the cone that the sphere fills
// as seen from $x$. Its half-angle is $\theta_{max}$. The same touching line
// gives $\sin\theta_{max} = r/d$. All directions in the cone hit the lamp.
//
// In the code the center is `light.center`, $r$ is `light.radius`, and $L_e$
// is `light.radiance`. How does one draw $\theta$ and $\phi$? Write the solid
// angle in angles, as in stage 1:
//
// $$d\omega = \sin\theta\,d\theta\,d\phi = \mathrm d(1-\cos\theta)\,d\phi$$
//
// Equal steps of $1 - \cos\theta$ are equal steps of solid angle. So
// $1 - \cos\theta$ must be uniform, from 0 on the axis to
// $1 - \cos\theta_{max}$ at the edge. This is *inversion sampling* of the
// cone:
//
// $$1 - \cos\theta = \xi_1\,(1 - \cos\theta_{max}) \qquad
// \phi = 2\pi\,\xi_2$$
//
// With $\theta_{max} = 90$ degrees this says $\cos\theta = 1 - \xi_1$. It is
// stage 1's rule for the hemisphere: $1 - \xi_1$ is as uniform as $\xi_1$.
// The cone's solid angle is $\Omega_c$, the density is one over it, and so
//
// $$\Omega_c = 2\pi\,(1 - \cos\theta_{max}) \qquad
// \frac{L_e}{p(\omega)} = L_e\,\Omega_c$$
//
// The method is by Shirley, Wang and Zimmerman ("Monte Carlo Techniques for
// Direct Lighting Calculations", ACM TOG 15(1), 1996). The weight is the
// same for all directions in the cone. What is still random is the cosine at
// the surface, and whether something is in the way.
//
// ![](lamp-cone)
//
// The code needs $\sin\theta$, too. It follows from what is known already:
// $\sin^2\theta = 1 - \cos^2\theta = (1 - \cos\theta)(1 + \cos\theta)$.
// `Basis(axis)` takes a unit vector and makes a coordinate system with this
// vector as its z axis. Its `to_world` turns
// $(\sin\theta \cos\phi, \sin\theta \sin\phi, \cos\theta)$ into a direction
// of the scene. Here the axis leads to the center.
//
// Where does this direction meet the sphere? Walk along it. After the
// distance $d\cos\theta$ you are closest to the center, $d\sin\theta$ away.
// From there back to the surface is half a *chord*. By Pythagoras it is
// $\sqrt{r^2 - d^2\sin^2\theta}$ long. So the distance to the first point on
// the sphere is
//
// $$d\cos\theta - \sqrt{r^2 - d^2\sin^2\theta}$$
//
// > *Rounding.* At the edge of the cone there is 0 under the root, and
// > rounding can make it negative. So take the larger of it and 0.
//
// If $x$ is inside the lamp, there is no cone. The lamp shines outward, so
// the answer is black: any unit direction, the weight 0, the distance 0.
//
// > *Rounding.* If the lamp is far away, $\cos\theta_{max}$ is rounded to 1.
// > Then $1 - \cos\theta_{max}$ is 0, and the lamp goes out. But
// > $s = \sin^2\theta_{max} = r^2/d^2$ has all its digits. It is
// > $(1 - \cos\theta_{max})(1 + \cos\theta_{max})$, and the cosine is
// > $\sqrt{1 - s}$. Divide by the second factor:
// >
// > $$1 - \cos\theta_{max} = \frac{s}{1 + \sqrt{1 - s}}$$

// #region sphere-light
inline LightSample sample_light(const SphereLight& light, const Vec3& x,
                                const Vec2& u) {
  const Vec3 to_center = light.center - x;
  const float squared_distance = dot(to_center, to_center);
  const float squared_radius = light.radius * light.radius;
  if (squared_distance <= squared_radius) return {{0, 0, 1}, Vec3(0), 0};
  // #region exercise 2.3: sphere light
  // #stub return {normalize(to_center), Vec3(0), 0};
  const float distance = std::sqrt(squared_distance);
  const float sin2_max = squared_radius / squared_distance;
  const float one_minus_cos_max = sin2_max / (1 + std::sqrt(1 - sin2_max));

  const float one_minus_cos = u.x * one_minus_cos_max;
  const float cos_theta = 1 - one_minus_cos;
  const float sin2_theta = one_minus_cos * (1 + cos_theta);
  const float sin_theta = std::sqrt(sin2_theta);
  const float phi = two_pi * u.y;
  const Vec3 direction =
      Basis(to_center / distance)
          .to_world({sin_theta * cos(phi), sin_theta * sin(phi), cos_theta});

  const float half_chord = std::sqrt(
      std::max(0.0f, squared_radius - squared_distance * sin2_theta));
  return {direction, light.radiance * (two_pi * one_minus_cos_max),
          (distance * cos_theta - half_chord) * (1 + distance_rounding)};
  // #endregion
}
// #endregion sphere-light

// ## Direct light
//
// Now ask all lights of the scene. With several lights the direct light is a
// sum of integrals, one for each. So their answers are added. Each light adds
// $f_r \cos\theta$ times its weight, with $\theta$ between the surface's
// normal and the direction to the light. There are two reasons to add
// nothing:
//
// - The light is *below the horizon*, $\cos\theta \le 0$. Then no shadow ray
//   is needed. In the rendering equation $\omega_i$ is above the surface. A
//   light may be below it, and with the equation's $|n \cdot \omega_i|$ it
//   would shine through thin walls.
// - The shadow ray meets something else before the light.
//
// ![](three-answers)
//
// These parts of the core do the rest:
//
// - `scene.lights` is the list of lights, each a `Light`.
// - `leave(hit, direction)` gives the starting point for a ray that leaves
//   the surface in this direction. This point is the same for all directions
//   on one side. So look at all lights from `leave(surface.hit,
//   surface.normal)`.
// - `spawn_ray(hit, direction)` gives the ray that starts there.
// - `scene.reaches(ray, distance, light)` is true if the ray meets nothing
//   before `distance`, or this light first.
// - `random.uniform_2d()` draws the two numbers for `sample_light`.
// - `is_black(weight)` is true if all three channels are 0. Such a light
//   needs no shadow ray, either.
//
// A `Light` is one of the three forms of light: `light.form` is a
// `std::variant` of them. `std::visit` calls the lambda with the one that is
// there. `auto` takes its type, so the `sample_light` above that fits it is
// called. The pictures show what is wrong without shadow rays, and without
// the surface's cosine.
//
// ![](direct-mistakes)

// #region direct-light
/// A point on any light, as seen from `x`. `u` is uniform in [0, 1)^2.
inline LightSample sample_light(const Light& light, const Vec3& x,
                                const Vec2& u) {
  return std::visit(
      [&](const auto& form) { return sample_light(form, x, u); }, light.form);
}

/// Radiance toward `wo` of the light that comes straight from the lights.
inline Vec3 direct_light(const Scene& scene, const Surface& surface,
                         Random& random) {
  // #region exercise 2.4: direct light
  // #stub return Vec3(0);
  const Vec3 x = leave(surface.hit, surface.normal);
  Vec3 sum(0);
  for (const Light& light : scene.lights) {
    const LightSample to_light = sample_light(light, x, random.uniform_2d());
    const float cos_theta = dot(surface.normal, to_light.direction);
    if (cos_theta <= 0 || is_black(to_light.weight)) continue;

    // Is anything in the way?
    const Ray shadow_ray = spawn_ray(surface.hit, to_light.direction);
    if (!scene.reaches(shadow_ray, to_light.distance, light)) continue;
    sum += evaluate(surface.material) * cos_theta * to_light.weight;
  }
  return sum;
  // #endregion
}
// #endregion direct-light

// ## Counted once
//
// The path goes on in a random direction, and it still hits *emitters*:
// surfaces that shine. Should their emission be added? A *vertex* is a point
// where the path meets a surface. The light must be counted exactly once:
// either when the previous vertex asked for it, or when it is hit. Two things
// decide.
//
// *What happened at the previous vertex?* If it asked the lights, it may have
// this light already. If the camera looks straight at the lamp, there was no
// previous vertex, and no light was asked.
//
// *What was hit?* Rectangles and spheres that emit are in the scene's list
// of lights. These were asked. A plane that emits has no end, so no point on
// it can be chosen uniformly. Triangles could be asked, but are not here.
// Only a hit can find those two.
//
// Together these are the four cells of a table:
//
// - From the camera, a rectangle or a sphere is hit: the hit counts.
// - From the camera, a plane or a triangle is hit: the hit counts.
// - The previous vertex asked the lights, and a rectangle or a sphere is hit:
//   the question counted, so the hit does not.
// - The previous vertex asked the lights, and a plane or a triangle is hit:
//   the hit counts.
//
// ![](who-counts)
//
// Get one of the four cells wrong, and you see it. If a lamp counts in both
// places, everything except the lamp itself is twice as bright. It is also
// noisy, because the second half is found by chance, as in stage 1. If a hit
// never counts, the camera sees a black lamp.
//
// ![](counted)
//
// The fourth cell is the one that people forget. The previous vertex asked
// the lights, but it could not ask this emitter. If the code assumes that it
// did, the light counts in *neither* place. A room under a ceiling that
// shines is then black.
//
// ![](counted-in-neither)
//
// So the rule has two conditions. Every hit has a pointer `hit.light` to the
// light that was hit. It is null if the shape is not in the scene's list of
// lights.

// #region counted-once
/// Whether `direct_light`, added at the previous surface, has this emission
/// in it already.
inline bool already_counted(const Surface& surface, bool direct_light_added) {
  // #region exercise 2.5: counted once
  // #stub return false;
  return direct_light_added && surface.hit.light != nullptr;
  // #endregion
}
// #endregion counted-once

// ## The path
//
// The loop is stage 1's. It has a `sum` beside the throughput, because a path
// now adds light at each vertex and not only at its end. The middle of the
// loop is now this:
//
// 1. At an emitter, add the throughput times its emission if it is not
//    counted yet. Then the path ends.
// 2. If `bounce` is `max_bounces_`, the path ends.
// 3. Otherwise add the throughput times the direct light, and note in
//    `direct_light_added` that it was added.
//
// Wherever the path ends, it returns the sum. Do not return 0 where a ray
// leaves the scene: what was gathered before would be lost.
//
// Why does the bound come before the direct light? Direct light is a bounce,
// too: the surface scatters it once. With `max_bounces` 0 there must be none.
// Then stages 1 and 2 give the same expected picture for the same bound, in
// each scene that stage 1 can read.
//
// Why a flag, and not just `bounce > 0`? In this program they are the same.
// But the flag says the reason: what matters is whether the previous vertex
// asked the lights.

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
      const Surface surface(*hit, *hit->material, -ray.direction);
      log_vertex(surface, throughput, sum, bounce);

      // #region exercise 2.6: the loop with direct light
      // #stub if (bounce == max_bounces_ || direct_light_added) return sum;
      // An emitter ends the path, and counts if it has not been counted.
      if (surface.material.emits()) {
        if (!already_counted(surface, direct_light_added)) {
          sum += throughput * emitted(surface);
        }
        return sum;
      }
      if (bounce == max_bounces_) return sum;

      // Ask the lights.
      sum += throughput * direct_light(scene_, surface, random);
      direct_light_added = true;
      // #endregion

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

// ## Follow one path with numbers
//
// The option `--pixel` prints what happens along one path of a pixel, and
// `--sample` chooses the path. This one meets the floor first, in the shadow
// of the left ball. Vertex 0 asks the lamp, but the ball is in the way, so
// it adds nothing. The path goes on to the red wall. Vertex 1 asks again,
// and its shadow ray reaches the lamp.
//
// ![](told-path)
//
// Check the red channel of vertex 1 by hand, with the numbers that the
// program prints. The lamp's normal is $(0, -1, 0)$, so $\cos\theta'$ is the
// second coordinate of the direction, 0.8801. The lamp has $L_e = (10, 9,
// 8)$, so 10 in red, and $A = 0.36$. The weight is
//
// $$10 \cdot \frac{0.36 \cdot 0.8801}{2.104^2} \approx 0.716$$
//
// The wall's normal is $(1, 0, 0)$, so $\cos\theta$ is the first coordinate,
// 0.4086. With the throughput 0.8 and $f_r = 0.8/\pi$, the path adds
//
// $$0.8 \cdot \frac{0.8}{\pi} \cdot 0.4086 \cdot 0.716 \approx 0.0596$$
//
// At vertex 2 the path hits the lamp by chance. Vertex 1 asked this lamp, so
// nothing is added. Stage 1 would have added $0.64 \cdot 10 = 6.4$ here, and
// nothing anywhere else. Such rare large terms are its noise.
//
//     $ build/stage2 scenes/cornell_box_lamp_diffuse.toml
//     > --pixel 50,225 --sample 31
//     ...
//     vertex 0: plane[2] of 'white', bounce 0
//     ...
//       light      (  0.2626,   0.9461,  -0.1895)  at 2.103: blocked
//       adds       (       0,        0,        0)  direct light
//     ...
//     vertex 1: plane[0] of 'red', bounce 1
//     ...
//       kd         (     0.8,      0.2,      0.2)
//       throughput (     0.8,      0.8,      0.8)
//       light      (  0.4086,   0.8801,  -0.2419)  at 2.104: reached
//       adds       ( 0.05957,   0.0134,  0.01191)  direct light
//     ...
//     vertex 2: rectangle[0] of 'lamp', bounce 2
//     ...
//       throughput (    0.64,     0.16,     0.16)
//       adds       nothing: this lamp was counted at the previous vertex
//       ends       at a lamp
//     radiance of this sample = (0.0595667, 0.0134025, 0.0119133)
//
// ## Stage 2 minus stage 1 is noise
//
// Both stages estimate the same integral. So the difference of their
// pictures must be noise around 0. No shape of the room may be seen in it,
// except as a place with more noise, such as the lamp's edge.
// Type this, with any scene that both can read:
//
//     make diff A=stage2 B=stage1 SCENE=scenes/cornell_box_lamp_diffuse.toml
//
// It renders both pictures and compares their means, in the whole picture and
// in small regions. For each there is a $z$: the difference of the means,
// divided by its standard deviation. It prints the largest $z$, and the limit
// that chance exceeds once in 10,000 runs. It also prints the variance of A
// over that of B: below 1, A has less noise. The same test finds a mistake:
// count the lamp twice, and the room can be seen in the difference.
//
// ![](stage-2-minus-1)
//
// ## Direct light, and the rest
//
// Now paint the box under the point light that stage 1 could not read:
//
//     build/stage2 scenes/cornell_box_point_diffuse.toml -o box.png
//
// With `--max-bounces 1` you see the direct light alone, and the shadows are
// black. With more bounces there is light in the shadows. It comes from the
// walls. Look for red light beside the red wall.
//
// ![](direct-and-all)
//
// ## What remains
//
// Some noise is left. The indirect light is still found by random directions.
// Even if a lamp is seen as a whole, the cosines and distances vary from
// point to point. At the soft edge of a shadow, the *penumbra*, only some of
// the points on the lamp are visible. And close to a rectangle its weight has
// no bound, because $d^2$ goes to 0: a wall that touches a lamp can have
// bright specks. There a random direction would be the better estimator. To
// combine the two is *multiple importance sampling* (Veach, *Robust Monte
// Carlo Methods for Light Transport Simulation*, 1997, chapter 9).
//
// There is a cost, too: one shadow ray for each light at each vertex. With a
// thousand lights a program would ask a few of them, chosen at random.

}  // namespace lightwalk::stage2
