// How often is a right program rejected? Renders every golden's scene with many
// seeds, and counts: the regions that looked different at first, the renders
// that needed a second look, and the renders that failed after it.
//
//     build/null_test [seeds, 200]

#include <cstdio>
#include <cstdlib>

#include "all_stages.hpp"
#include "support/goldens.hpp"

namespace {

using namespace lightwalk;
using namespace lightwalk::tests;

struct Count {
  double renders = 0, second_looks = 0, rejections = 0;
  double regions = 0, suspected = 0, expected_rejections = 0;
};

template <class PathTracer>
void add_stage(int stage, int seeds, Count& total) {
  for (const std::string& name : golden_names(stage)) {
    Golden golden = load_golden(stage, name);
    const Rerender rerender =
        renderer<PathTracer>(golden.loaded.scene, golden.settings);
    Count count;
    for (int seed = 1; seed <= seeds; ++seed) {
      const Comparison comparison = compare_with_reference(
          rerender, golden.settings.samples_per_pixel,
          static_cast<std::uint64_t>(seed), golden.image);
      count.renders += 1;
      count.second_looks += comparison.suspected.empty() ? 0 : 1;
      count.rejections += comparison.same() ? 0 : 1;
      count.regions += static_cast<double>(comparison.all.size());
      count.suspected += static_cast<double>(comparison.suspected.size());
      count.expected_rejections += comparison.false_alarms({});
    }
    std::printf("stage%d %-32s second looks %3.0f, rejections %.0f\n", stage,
                name.c_str(), count.second_looks, count.rejections);
    std::fflush(stdout);
    total.renders += count.renders;
    total.second_looks += count.second_looks;
    total.rejections += count.rejections;
    total.regions += count.regions;
    total.suspected += count.suspected;
    total.expected_rejections += count.expected_rejections;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::atoi(argv[1]) : 200;
  Count total;
  for_each_stage([&]<class PathTracer>(int stage) {
    add_stage<PathTracer>(stage, seeds, total);
  });
  const double once = false_alarm_rate(Bands().z_critical, total.regions);
  std::printf(
      "%.0f renders, %.0f regions: %.0f beyond z at first (normal: %.3g), "
      "%.0f second looks, %.0f rejections (computed: %.2g)\n",
      total.renders, total.regions, total.suspected, once, total.second_looks,
      total.rejections, total.expected_rejections);
  return total.rejections > 0;
}
