#pragma once

// # Stage 4: Russian roulette
//
// Stage 3 follows every lobe at every hit. Its rays double with each bounce,
// so the number of bounces must stay small. Then the picture is too dark.
//
// One idea fixes both. Do not follow all lobes: draw one of them at random.
// And let "none of them" be one of the choices, so that paths end by
// themselves.
//
// ![](branching)
//
#include "stages/3_specular_refraction/path_tracer.hpp"

namespace lightwalk::stage4 {

using stage1::BsdfSample;
using stage1::emitted;
using stage2::already_counted;
using stage2::direct_light;
using stage3::Lobe;
using stage3::sample;

// ## Divide by the probability
//
// Say you want a sum $A + B$, and both terms are expensive. Draw one of them.
// With probability $p$ compute only $A$, and answer $A/p$. Otherwise compute
// only $B$, and answer $B/(1 - p)$. Each answer is wrong. The mean is right:
//
// $$p \cdot \frac{A}{p} + (1 - p) \cdot \frac{B}{1 - p} = A + B$$
//
// It is the Monte Carlo estimator of stage 1 once more, over a choice of two
// instead of a hemisphere of directions.
//
// Now say you want $A$ alone. With probability $p$ compute it, and answer
// $A/p$. Otherwise answer 0, without any work:
//
// $$p \cdot \frac{A}{p} + (1 - p) \cdot 0 = A$$
//
// A path whose answer is 0 ends. A path that goes on counts for those that
// ended, too. In most books only this second trick is called *Russian
// roulette* (Arvo and Kirk 1990). The slides use the name for both, since
// one random number decides both.
//
// ![](mean-is-area)
//
// If you forget the division, the mean of a bounce is $p\,A$, not $A$, and
// the picture is too dark. If you divide by the probability of another
// event, things with several lobes have wrong colors. On a wall with one
// lobe you cannot see it.
//
// ![](roulette-mistakes)
//
// ## Four events
//
// Each hit has four *events*: the path goes on by the diffuse lobe, by the
// specular lobe or by refraction, or its light is *absorbed* and it ends. Let
// $p_d$, $p_s$ and $p_t$ be the probabilities of the first three. Lay them
// end to end on a bar of length 1. What is left of the bar is the
// probability of absorption (slide "Path termination"):
//
// $$1 - (p_d + p_s + p_t)$$
//
// One uniform random number $\xi_{RR} \in [0, 1)$ falls somewhere on the bar
// and picks the event there. It is $\xi$ in the figures, and `xi` in the
// code.
//
// ![](event-bar)
//
// A path that goes on is divided by the probability of its event. In stage 3
// the weight of a lobe was its coefficient $k$. Now it is $k/p$, with the $p$
// of this lobe. (Refraction keeps its factor $(\eta_o/\eta_i)^2$ besides.
// Below we leave it out.) In the notation of the slides, the diffuse term is
// $k_d\,\frac{1}{\pi} \cdot \frac{1}{p_d}$, and the specular term is
// $k_s\,\frac{\delta_{\omega_r}(\omega_i)}{n \cdot \omega_i} \cdot
// \frac{1}{p_s}$.
//
// ### Which probabilities?
//
// The mean is right with any probabilities, as long as no lobe with a
// coefficient has the probability 0. Good ones give less noise in less time.
//
// **The ratio.** Say that all directions bring the same light $L$. Then an
// event answers $\frac{k}{p}\,L$. If $k/p$ is the same for all lobes, the
// three lobes answer the same, and the choice among them adds no noise. So
// take $p$ in proportion to $k$: $p = c\,k$ with one constant $c$ for all
// three.
//
// **The constant.** The ratio leaves $c$ open. On a gray surface every
// weight is $1/c$. The largest $c$ that fits on the bar fills it, and
// nothing is absorbed. Then the throughput shrinks at each bounce, and a ray
// with the throughput 0.01 costs as much time as one with 1. A small $c$
// makes noise: few paths survive, with weights above 1. With $c = 1$ the
// weight is 1. A dark wall ends many paths, and all that go on are worth the
// same.
//
// ![](same-ratios)
//
// **The channels.** But $k$ has three channels, and $p$ is one number. The
// slides take the largest channel (slide "Russian Roulette: probabilities"):
//
// $$p_i = \max_{RGB} k_i$$
//
// It is one good choice among many. Then $k_i/p_i$ is 1 in this channel and
// at most 1 in the others. So the roulette never makes the throughput grow.
// The only exceptions are in the next two sections, and refraction's square.
//
// The mean of the channels would be right, too. But a red wall with $k_d =
// (0.8, 0.2, 0.2)$ would get $p_d = 0.4$, and the weight $0.8/0.4 = 2$ in
// red. Three such walls make a sample 8 times as bright. Such a bright dot
// in the picture is called a *firefly*.
//
// ### A bar that is too long
//
// The slides note that $k_d + k_s + k_t \le 1$ in each channel. This does
// *not* make the maxima add to at most 1. Take red paint, $k_d = (0.9, 0,
// 0)$, under a green mirror, $k_s = (0, 0.9, 0)$. The maxima are 0.9 and 0.9,
// and their sum is 1.8.
//
// On the bar the specular event gets only what the diffuse one leaves, 0.1.
// Yet its light would be divided by 0.9. Its mean is then $0.1/0.9$ of what
// it should be: nine times too dark. So where the sum exceeds 1, multiply
// all three by the same factor, here $1/1.8$, and their sum is 1.
//
// ![](overfull)
//
// The scene `scenes/coloured_lobes.toml` has such a ball, and one of glass
// that reflects green and lets purple through.
//
// ![](not-scaled)
//
// ### Paths that never end
//
// The slides say that no bound on the bounces is needed with absorption. That
// is nearly true. But glass with $k_s + k_t = 1$ absorbs nothing. Light
// inside it may be reflected totally at every bounce, forever. Without any
// limit one such path hangs the program.
//
// The cure is a limit. From bounce 16 on, the three events together get at
// most 0.95. Then every path ends sooner or later. For such glass the
// weights grow to match, $1/0.95 = 1.053$ instead of 1, so the mean stays as
// it is.
//
// Before bounce 16 the coefficients alone decide. Mirrors and glass lose
// little, and in most pictures the limit adds no noise to them.
//
// ![](trapped)
//
// How long can a path be now? Of the paths with 16 bounces, at most the
// fraction $0.95^{84} = 0.013$ reaches bounce 100. That is one in 74. The
// renderer also stops every path at bounce 4096, in case a stage has no
// limit. Here only $0.95^{4080} < 10^{-90}$ of them would get there.
//
// This path is in a ball of glass, and the camera is in it, too. It is
// reflected 56 times and finds nothing. At bounce 16 the limit begins.
//
//     $ build/stage4 scenes/total_internal_reflection.toml
//     > --pixel 156,34
//     ...
//     vertex 15: sphere[0] of 'glass', bounce 15
//     ...
//       weight     (       1,        1,        1)
//
//     vertex 16: sphere[0] of 'glass', bounce 16
//     ...
//       weight     (   1.053,    1.053,    1.053)
//     ...
//     vertex 56: sphere[0] of 'glass', bounce 56
//     ...
//       throughput (    7.78,     7.78,     7.78)
//       ends       absorbed (roulette)
//     ...
//
// Now write `lobe_probabilities`. The function `max_component(color)` gives
// the largest channel of a color. Take it of `material.kd`, `material.ks` and
// `material.kt`. The limit is 1 before bounce `first_limited_bounce`, and
// `survival_limit` from it on. If the three add to more than the limit,
// multiply all of them by the limit over their sum.

// #region lobe-probabilities
/// From this bounce on every path may end.
inline constexpr int first_limited_bounce = 16;
inline constexpr float survival_limit = 0.95f;

/// Probabilities of the three events that go on; the rest is absorption.
struct LobeProbabilities {
  float diffuse, specular, refraction;
};

/// Of each lobe the largest channel of its coefficient. Where the three add
/// to more than the limit of a path with `bounce` bounces, all are scaled.
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

// ## One number, one event
//
// Now pick the event: find the piece of the bar on which `xi` lies. The
// order is that of the figure: diffuse, specular, refraction, and the rest
// is absorbed. The result is the lobe together with *its own* probability,
// the length of its piece, as in `return LobeChoice{Lobe::diffuse,
// p.diffuse};`. Where the light is absorbed, the result is `std::nullopt`,
// an empty `std::optional`.
//
// Compare `xi` with the right end of each piece, by `<` and not by `<=`. So a
// lobe with probability 0 is never picked, not even by `xi` = 0, and nothing
// is ever divided by 0.
//
// Do not use the same number again to draw the direction. After a diffuse
// event it lies below $p_d$. A direction drawn with it comes from one part of
// the hemisphere only, and the room is shaded wrongly.
//
// ![](number-twice)
//
// There is a valid trick, though. After a diffuse event $\xi/p_d$, the number
// stretched to the full length, is uniform in $[0, 1)$ again. Some programs
// use it for the next choice. Here each choice draws a number of its own.
//
// ![](rest-of-the-number)

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
// The tree is gone, and the loop is stage 2's again, with one ray after the
// other. Only the event is new. Three details decide whether the picture is
// right.
//
// **Direct light is not divided.** The lights are asked before the event is
// drawn, at every hit with a diffuse lobe. This is always done, whichever
// way the path goes on. Only what is done with a probability is divided by
// it. (To ask only after a diffuse event would be right, too, with the
// division by
// $p_d$. But then some paths would not ask, for no gain.)
//
// **A hit in the mirror is no double count.** The BSDF of plastic is a sum of
// two lobes, and so is the light that leaves it. The shadow ray brings the
// lamp's light by the diffuse lobe, times $k_d/\pi$. The mirrored ray brings
// the lamp's light by the specular lobe, times $k_s$. These are two terms of
// the sum, and each is counted once.
//
// ![](both-lobes)
//
// **The flag tells the event.** After a diffuse event `direct_light_added` is
// true, since the shadow ray has brought this term already. After any other
// event it is false, since no light was asked for that term. If the flag is
// always true, lamps vanish from mirrors. If it is never true, the diffuse
// light of lamps counts twice.
//
// ![](lamp-in-plastic)
//
// ### Follow one path
//
// Every surface in `scenes/plastic.toml` has $k_s = 0.3$. The blue ball has
// $k_d = (0.2, 0.2, 0.6)$, so $p_d = 0.6$, and 0.1 of the bar is left.
//
// 1. At the ball the event is diffuse, and the weight is $k_d/p_d =
//    (0.2, 0.2, 0.6)/0.6$.
// 2. At the red wall, with $k_d = (0.5, 0.1, 0.1)$, it is diffuse again, and
//    the weight is $(0.5, 0.1, 0.1)/0.5$.
// 3. At the green wall it is specular, and the weight is $0.3/0.3 = 1$.
// 4. At the white wall, with $k_d = 0.5$, 0.2 of the bar is left. The path
//    ends there. The wall's direct light has been added before.
//
// These four events come with the probability $0.6 \cdot 0.5 \cdot 0.3 \cdot
// 0.2 = 0.018$. Stage 3 would follow all branches. Here this path stands for
// many others.
//
//     $ build/stage4 scenes/plastic.toml
//     > --pixel 75,195 --sample 19
//     ...
//     vertex 0: sphere[0] of 'blue', bounce 0
//     ...
//       goes on    (   -0.64,     0.68,    -0.35)  diffuse
//       weight     (   0.333,    0.333,        1)
//
//     vertex 1: plane[0] of 'red', bounce 1
//     ...
//       throughput (   0.333,    0.333,        1)
//     ...
//       goes on    (    0.90,    -0.04,     0.44)  diffuse
//       weight     (       1,      0.2,      0.2)
//
//     vertex 2: plane[1] of 'green', bounce 2
//     ...
//       throughput (   0.333,   0.0667,      0.2)
//     ...
//       goes on    (   -0.90,    -0.04,     0.44)  specular
//       weight     (       1,        1,        1)
//
//     vertex 3: plane[4] of 'white', bounce 3
//     ...
//       throughput (   0.333,   0.0667,      0.2)
//     ...
//       adds       (   0.028,   0.0056,    0.017)  direct light
//       sum        (   0.076,    0.028,    0.073)
//       ends       absorbed (roulette)
//     ...
//
// Now write the end of the loop. Draw an event by `choose_lobe`. It takes the
// `lobe_probabilities` of the surface's material at this `bounce`, and
// `random.uniform()`, a new number in $[0, 1)$. If it is empty, return `sum`.
//
// Else `sample(lobe, surface, sampling_, random)` of stage 3 gives a
// direction of the event's `lobe`. It returns a `BsdfSample`, with the
// direction `wi` and its `weight`. Multiply the throughput by the weight over
// the probability. The next ray comes from `spawn_ray`. It goes from the hit
// toward `wi`, and starts a little off the surface. Set the flag, too.

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
// Count the rays of one sample, shadow rays too. In `scenes/plastic.toml`,
// where every surface has two lobes, stage 3 needs 760 rays for 8 bounces.
// Stage 4 needs 8.4, and 10 without any bound.
//
// ![](ray-counts)
//
// This is not the whole truth. A sample of stage 4 sees one path, not a tree,
// so it is noisier. What counts is the noise at equal *time*.
//
// Let a sample take the time $t$ and have the variance $v$. In $T$ seconds
// there are $N = T/t$ samples, and the variance of their mean is $v/N =
// v\,t/T$. So compare the products $v\,t$. The field calls $1/(v\,t)$ the
// *efficiency* of an estimator.
//
// ![](equal-time)
//
// With one bounce both stages are about equal. With two, stage 3 is better:
// its tree is still small, and which lobe is followed is not left to chance.
// With six bounces it needs 4 times as long as stage 4 for the same noise.
// With eight it needs 13 times as long. Each further bounce doubles the
// time of a sample.
//
// The table's last column, the light that is cut, is no noise but *bias*:
// more samples do not help. Six bounces cut off 5 %. Without a bound stage 4
// has all.
//
// So one sample of the tree has little noise and costs much. At equal time
// the noise decides:
//
// ![](branch-or-draw)
//
// Try this on the lab's box: what do the corners lack with two bounces, and
// what does the glass ball lack?
//
//     build/stage4 scenes/cornell_box_ceiling.toml -o box.png
//     build/stage4 scenes/cornell_box_ceiling.toml --max-bounces 2 -o 2.png
//
// ![](bound-or-none)
//
// ## What remains
//
// The probabilities look at the material alone, not at the throughput. A path
// with the throughput $(1, 0.1, 0.1)$ may meet a green wall, where it is
// worth little. It is followed as long as any other. Even a black throughput
// is followed. That costs time, and is never wrong.
//
// Where the bar was scaled, weights exceed 1. The red paint under the green
// mirror has the weight $0.9/0.5 = 1.8$ in red, with probability 0.5. In a
// room of this material alone each bounce would multiply the mean of the
// squared throughput in red by $0.5 \cdot 1.8^2 = 1.62$. The noise grows with
// it, since the variance is this mean less the square of the mean. There it
// helps to take the maxima of the throughput times $k$, and not of $k$.
//
// And every material is still the same all over. Stage 5 changes that.

}  // namespace lightwalk::stage4
