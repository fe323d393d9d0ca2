// Renders the parts of the golden images, which a failing golden is explained
// by, with their right stages: `make goldens` does.
//
//     build/make_parts [stageN/scene ...]

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "all_stages.hpp"
#include "support/goldens.hpp"

namespace {

using namespace lightwalk;
using namespace lightwalk::tests;

/// As many samples as the tests take, times this.
constexpr int times = 16;

template <class PathTracer>
void make(int stage, const std::set<std::string>& chosen) {
  for (const std::string& name : golden_names(stage)) {
    const std::string title = "stage" + std::to_string(stage) + '/' + name;
    if (!chosen.empty() && !chosen.count(title)) continue;
    std::printf("%s: its parts\n", title.c_str());
    std::fflush(stdout);
    const Golden golden = load_golden(stage, name);
    std::ofstream file(part_path(stage, name));
    file << golden.loaded.sha256 << '\n';
    const int samples = times * golden.settings.samples_per_pixel;
    for (const std::string& part : part_names(golden)) {
      const RenderResult result =
          paint_part(golden, part, samples, 20'000'000,
                     [](const Scene& scene, const RenderSettings& settings) {
                       return paint<PathTracer>(scene, settings);
                     });
      file << part_line(part_of(result, part)) << '\n';
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::set<std::string> chosen(argv + 1, argv + argc);
  std::filesystem::create_directories(GOLDENS "/parts");
  for_each_stage(
      [&]<class PathTracer>(int stage) { make<PathTracer>(stage, chosen); });
}
