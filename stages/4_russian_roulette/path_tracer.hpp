#pragma once

// # Stage 4: Russian roulette
//
// Stage 3 follows every lobe at every hit. Its rays double with each bounce,
// so the number of bounces must be small, and then the picture is too dark.
// One idea mends both. Do not follow all lobes: draw one of them at random.
// And let "none of them" be one of the choices, so that paths end by
// themselves.
//
// ![](bound-or-none)
//
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
// Say you want a sum $A + B$, and both are expensive. Draw one: with
// probability $p$ compute only $A$ and answer $A/p$. Otherwise compute only
// $B$ and answer $B/(1 - p)$. Each answer is wrong. Their mean is right:
//
// $$p \cdot \frac{A}{p} + (1 - p) \cdot \frac{B}{1 - p} = A + B$$
//
// It is the estimator of stage 1 once more, over a choice of two instead of a
// hemisphere of directions.
//
// Now say you want $A$ alone. With probability $p$ compute it and answer
// $A/p$. Otherwise answer 0, without any work:
//
// $$p \cdot \frac{A}{p} + (1 - p) \cdot 0 = A$$
//
// The second trick is *Russian roulette*: a path may die at any hit, and
// those that survive count more. In most books the name means only this. The
// slides use it for both, since one random number decides both.
//
// Forget the division, and the mean of a bounce is $p\,A$, not $A$. The
// picture is too dark. Divide by something else, and it is too bright or has
// wrong colors.
//
// ![](roulette-mistakes)
//
// ## Four events
//
// At each hit one random number $\xi_{RR}$, uniform in $[0, 1)$, picks one of
// four *events* (slides "Russian Roulette: probabilities" and "Path
// termination"). Let $p_d$, $p_s$ and $p_t$ be the probabilities of the
// diffuse, the specular and the refraction event. Lay them end to end on a
// bar of length 1. What is left of the bar is the fourth event: the light is
// *absorbed*, and the path ends.
//
// ![](events)
//
// A path that goes on is divided by the probability of its event. For the
// diffuse lobe the factor is $k_d\,\frac{1}{\pi} \cdot \frac{1}{p_d}$, for
// the specular $k_s\,\frac{\delta_{\omega_r}(\omega_i)}{|n \cdot \omega_i|}
// \cdot \frac{1}{p_s}$, and so on.
//
// ### Which probabilities?
//
// Any will do, as long as no lobe with a coefficient has the probability 0.
// Which are good? The weight of a bounce is $k/p$.
//
// 1. If all three weights $k/p$ are equal, the choice of the event adds no
//    noise. So the $p$ should be in the *ratio* of the $k$.
// 2. Choose $p = k$. Then the weight is 1, and the throughput stays 1. A dark
//    wall ends most paths, and rightly: what they would bring is multiplied
//    by almost nothing. Time is spent where light is.
// 3. But $k$ has three channels, and $p$ is one number. Take the largest.
//    Then no channel has a weight above 1, and nothing bright is ever made
//    brighter.
//
// The slides say it in a formula:
//
// $$p_i = \max_{RGB} k_i$$
//
// They also note that $k_d + k_s + k_t \le 1$ in each channel. This does
// *not* make the maxima add to at most 1. A red $k_d = (0.9, 0, 0)$ and a
// green $k_s = (0, 0.9, 0)$ have the maxima 0.9 and 0.9, with the sum 1.8. On
// the bar the specular event only gets what is left, 0.1. Yet its light would
// be divided by 0.9: nine times too dark. So where the sum exceeds 1, all
// three are scaled down together.
//
// ![](overfull-bar)
//
// ### Paths that never end
//
// With absorption no bound on the bounces is needed, say the slides. Nearly.
// Glass with $k_s + k_t = 1$ absorbs nothing. Light inside it may be
// reflected totally at every bounce, forever, and one such path hangs the
// program.
//
// The cure: from bounce 16 on, the three events together get at most 0.95.
// Then every path may end. The weights grow to match, so the mean stays as it
// is. Up to bounce 16 the coefficients alone decide, and mirrors and glass
// add no noise of their own. Of the paths with 16 bounces a fraction of
// $0.95^{84} = 0.013$ reaches 100.
//
// Write `lobe_probabilities`: the largest channel of each coefficient,
// `max_component(color)`; all scaled by the same factor where their sum is
// above the limit. The limit is 1 before `first_limited_bounce` and
// `survival_limit` from it on.

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
  // #region exercise 4.1: event probabilities
  // #stub return {0, 0, 0};
  const float diffuse = max_component(material.kd);
  const float specular = max_component(material.ks);
  const float refraction = max_component(material.kt);
  const float limit = bounce < first_limited_bounce ? 1 : survival_limit;
  const float sum = diffuse + specular + refraction;
  const float scale = sum > limit ? limit / sum : 1;
  return {scale * diffuse, scale * specular, scale * refraction};
  // #endregion
}
// #endregion lobe-probabilities

// Now pick the event: see on which piece of the bar `xi` lies. The result is
// the lobe together with *its own* probability, or nothing where the light is
// absorbed. The comparison is `<`, so a lobe with probability 0 is never
// picked, even by `xi` = 0.
//
// The number that picks the event must not draw the direction as well.
// Diffuse events have $\xi < p_d$, so the direction would only see the lower
// part of all numbers. (Rescaled, $\xi/p_d$ is uniform again, and some
// programs do that. Here each choice draws a number of its own.)
//
// ![](number-twice)

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
  // #region exercise 4.2: the choice of an event
  // #stub return {};
  if (xi < p.diffuse) return LobeChoice{Lobe::diffuse, p.diffuse};
  if (xi < p.diffuse + p.specular) {
    return LobeChoice{Lobe::specular, p.specular};
  }
  if (xi < p.diffuse + p.specular + p.refraction) {
    return LobeChoice{Lobe::refraction, p.refraction};
  }
  return std::nullopt;
  // #endregion
}
// #endregion choose-lobe

// ## The path
//
// The tree is gone, and the loop is stage 2's again. What is new is the
// event.
//
// - The lights are asked *before* the event is drawn, and are not divided by
//   anything. They are asked for the diffuse lobe, with its coefficient,
//   whichever way the path goes on.
// - Only what goes on is divided by the probability of going on.
// - The flag is true after a diffuse event only. At plastic the lights were
//   asked, but for the diffuse lobe. If the path goes on as a mirror and hits
//   a lamp, that light belongs to the specular lobe. Nobody has counted it.
//
// One path with numbers. At the white wall $k_d$ and $p_d$ are both 0.8, so
// the weight is 1. At the red wall $p_d$ is 0.8, from red, and the weight of
// green and blue is $0.2/0.8 = 0.25$.
//
//     $ build/stage4 scenes/cornell_box_ceiling.toml
//     > --pixel 60,150 --sample 3
//     ...
//     vertex 0: plane[4] of 'white', bounce 0
//     ...
//       weight     (       1,        1,        1)
//     ...
//     vertex 1: plane[0] of 'red', bounce 1
//     ...
//       weight     (       1,     0.25,     0.25)
//     ...
//     vertex 3: plane[3] of 'ceiling', bounce 3
//     ...
//       throughput (       1,     0.25,     0.25)
//       adds       (       1,     0.25,     0.25)  emission
//     ...
//
// Write the end of the loop. Draw an event with `random.uniform()`, and stop
// if the light is absorbed. Sample the event's lobe as in stage 3. Multiply
// the throughput, and set the ray and the flag.

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

      // #region exercise 4.3: one event per hit
      // #stub return sum;
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
      // #endregion
    }
  }

 private:
  const Scene& scene_;
  int max_bounces_;
  Sampling sampling_;
};
// #endregion path

// ## What it buys
//
// Rays per sample in `scenes/plastic.toml`, where every surface is diffuse
// and specular. Shadow rays are counted.
//
// | `--max-bounces` | stage 3 | stage 4 |
// |---|---|---|
// | 1 | 4 | 2.7 |
// | 2 | 10 | 4.2 |
// | 4 | 45 | 6.2 |
// | 8 | 760 | 8.4 |
// | 12 | 12,200 | 9.3 |
// | none | - | 10 |
//
// ![](ray-counts)
//
// This is not the whole truth, since a sample of stage 4 is also noisier.
// What counts is the noise at equal *time*. With 6 bounces the variance of
// one sample is 6 times as large as in stage 3, but the sample takes a
// twentieth of the time. At equal time stage 4 has less than a third of the
// variance, and about half the noise. (Measured by
// `tools/bench/efficiency.py`; the ratio of variance times time was between
// 3.5 and 4.7 on one machine.) With more bounces stage 3 falls behind without
// end.
//
// ![](branch-or-draw)
//
// What remains? A path that was colored by several walls may have a
// throughput like (1, 0.1, 0.1). The probabilities here look at the material
// alone, not at the throughput, so such a path is followed as long as a white
// one. That costs a little time and is never wrong. And every material is
// still the same all over: stage 5 changes that.
//
//     build/stage4 scenes/cornell_box_ceiling.toml -o box.png
//
}  // namespace lightwalk::stage4
