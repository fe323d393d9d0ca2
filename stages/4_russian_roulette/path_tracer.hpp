#pragma once

// # Stage 4: Russian roulette
//
// Stage 3 follows every lobe at every hit, so its rays double with each
// bounce, and it stops after a fixed number of bounces, so its pictures are
// too dark. One idea mends both: do not follow all lobes, draw one by lot.
// And let "none of them" be one of the lots, so that paths end by themselves.

#include "stages/3_specular_refraction/path_tracer.hpp"

namespace lightwalk::stage4 {

using stage1::BsdfSample;
using stage1::emitted;
using stage2::direct_light;
using stage2::is_counted;
using stage3::Lobe;
using stage3::sample;

// ## Divide by the probability
//
// Say a sum $A + B$ is wanted, and both are expensive. Compute only $A$, with
// probability $p$, and call the result $A/p$; otherwise only $B$, and call it
// $B/(1-p)$. Any single answer is wrong, but the mean is
// $p\,\frac{A}{p} + (1-p)\frac{B}{1-p} = A + B$. It is the estimator of stage
// 1 once more, over a choice of two instead of a hemisphere of directions.
//
// Forget to divide and the picture is too dark: the mean is then
// $pA + (1-p)B$, a weighted mean of the two.
//
// ## Four events
//
// At each hit one random number $\xi_{RR} \in [0, 1)$ picks an event from a
// bar of length 1 (slides "Russian Roulette: probabilities" and "Path
// termination"):
//
//     0        p_d          p_d + p_s      p_d + p_s + p_t       1
//     |diffuse |  specular  |  refraction  |     absorption      |
//
// What is left of the bar is the fourth event: the light is absorbed and the
// path ends, with probability $1 - (p_d + p_s + p_t)$. A dark wall ends most
// paths, and rightly: what they would bring is multiplied by almost nothing.
// Each of the others is divided by its probability: a path that goes on by
// the diffuse event counts $k_d\,\frac{1}{\pi} \cdot \frac{1}{p_d}$, one by
// the specular $k_s\,\frac{\delta_{\omega_r}(\omega_i)}{n \cdot \omega_i}
// \cdot \frac{1}{p_s}$.
//
// Which probabilities? Any, as long as no lobe with a coefficient has 0. The
// less the weight $k/p$ varies the less noise there is, so take $p$ as large
// as $k$. But $k$ has three channels, and $p$ is one number; the slides take
// the largest:
//
// $$p_i = \max_{RGB} k_i$$
//
// They also note that $k_d + k_s + k_t \le 1$ in each channel. That does
// *not* make the maxima add to at most 1: with a red $k_d = (0.9, 0, 0)$ and
// a green $k_s = (0, 0.9, 0)$ they add to 1.8. The bar would be full before
// the last event begins, and that event would never come. So where the sum
// exceeds 1 all three are scaled down together.
//
// ![](event-bar)
//
// ## Paths that never end
//
// With absorption no bound on the bounces is needed, say the slides. Almost:
// glass with $k_s + k_t = 1$ absorbs nothing, and light that meets its inside
// beyond the critical angle may be reflected totally at every turn, for ever.
// In `scenes/total_internal_reflection.toml`, where the camera is in the
// glass, that is what becomes of one path in four. From outside, a ray that
// just grazes a ball is let out again by rounding alone: the tracers that
// recompute the hit carelessly lose one path in ten thousand there. One such
// path hangs the program. So from bounce 16 on the events together get at
// most 0.95, whatever the material, and the weights grow to match, which
// keeps the mean. Up to there the coefficients alone decide, and mirrors and
// glass add no noise of their own. A path of 100 bounces is then one in 75 of
// those with 16; the longest of 65,000 in that scene had 276, and nobody will
// ever see one of `bounce_cap` = 4096, where all end.

// #region lobe-probabilities
/// From this bounce on every path may end.
inline constexpr int first_limited_bounce = 16;
inline constexpr float survival_limit = 0.95f;

/// Probabilities of the three events that go on; the rest is absorption.
struct LobeProbabilities {
  float diffuse, specular, refraction;
};

/// The largest channel of each coefficient, scaled down where they add to
/// more than a path's survival may be after `bounce` bounces.
inline LobeProbabilities lobe_probabilities(const Material& material,
                                            int bounce) {
  const float diffuse = max_component(material.kd);
  const float specular = max_component(material.ks);
  const float refraction = max_component(material.kt);
  const float limit = bounce < first_limited_bounce ? 1 : survival_limit;
  const float sum = diffuse + specular + refraction;
  const float scale = sum > limit ? limit / sum : 1;
  return {scale * diffuse, scale * specular, scale * refraction};
}
// #endregion lobe-probabilities

// The number that picks the event picks nothing else. Use its rest to draw
// the direction as well and diffuse bounces only ever see one end of the
// hemisphere.

// #region choose-lobe
/// A lobe to follow, and the probability with which it was chosen.
struct LobeChoice {
  Lobe lobe;
  float probability;
};

/// Picks a lobe by `xi`, uniform in [0, 1), or none: the light is absorbed. A
/// lobe with probability 0 is never picked.
inline std::optional<LobeChoice> choose_lobe(const LobeProbabilities& p,
                                             float xi) {
  if (xi < p.diffuse) return LobeChoice{Lobe::diffuse, p.diffuse};
  if (xi < p.diffuse + p.specular) {
    return LobeChoice{Lobe::specular, p.specular};
  }
  if (xi < p.diffuse + p.specular + p.refraction) {
    return LobeChoice{Lobe::refraction, p.refraction};
  }
  return std::nullopt;
}
// #endregion choose-lobe

// ## What it buys
//
// Rays per sample in `scenes/plastic.toml`, where every surface is diffuse
// and specular, with bounds of 1 to 12 bounces:
//
// | `--max-bounces` | stage 3 | stage 4 |
// |---|---|---|
// | 1 | 4 | 2.7 |
// | 2 | 10 | 4.2 |
// | 3 | 22 | 5.3 |
// | 4 | 45 | 6.2 |
// | 5 | 93 | 7.0 |
// | 6 | 188 | 7.6 |
// | 7 | 379 | 8.0 |
// | 8 | 760 | 8.4 |
// | 9 | 1,520 | 8.7 |
// | 10 | 3,050 | 9.0 |
// | 11 | 6,100 | 9.2 |
// | 12 | 12,200 | 9.3 |
// | none | - | 10 |
//
// ![](ray-counts)
//
// ## The path
//
// The tree is gone, and the loop is stage 2's again, one ray after the
// other. The lights are asked before the event is drawn: they are
// asked for the diffuse lobe's sake, with its coefficient, whatever happens
// next. Only what goes on is divided by the probability of going on.

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

// ![](bound-or-none)

// ![](branch-or-draw)

}  // namespace lightwalk::stage4
