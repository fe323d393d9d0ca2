// No stage allocates memory per ray or per sample: that would be its slowest
// step, and threads would wait for each other.

#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "all_stages.hpp"
#include "support/goldens.hpp"

namespace {
constinit std::atomic<long> allocations{0};
}

void* operator new(std::size_t size) {
  ++allocations;
  void* block = std::malloc(size > 0 ? size : 1);
  if (!block) throw std::bad_alloc();
  return block;
}
void operator delete(void* block) noexcept {
  std::free(block);
}
void operator delete(void* block, std::size_t) noexcept {
  std::free(block);
}

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

/// What a renderer allocates to render 64 x 64 pixels with some samples each.
template <class PathTracer>
long allocations_of(const Scene& scene, std::uint32_t samples) {
  const TileRenderer render =
      tile_renderer<PathTracer>(scene, {.max_bounces = 4});
  Film film(64, 64);
  const std::atomic<bool> stop{false};
  const long before = allocations;
  render({0, 64, 0, 64, 0, samples}, film, stop);
  return allocations - before;
}

}  // namespace

TEST_CASE("the count of allocations counts") {
  const long before = allocations;
  const Film film(8, 8);
  CHECK(allocations > before);
}

// Stage 6 has a queue of samples for each tile.
TEST_CASE("no stage allocates memory per sample, and at most once per tile") {
  std::vector<std::string> names;
  for_each_stage([&]<class PathTracer>(int stage) {
    // A stage with the pictures of the previous stage has no images of its
    // own.
    if (const auto own = golden_names(stage); !own.empty()) names = own;
    CHECK_FALSE(names.empty());
    for (const std::string& name : names) {
      CAPTURE(stage);
      CAPTURE(name);
      const auto& scene = scene_file(name, 64, 64);
      const long of_one_sample = allocations_of<PathTracer>(scene, 1);
      CHECK(of_one_sample <= (stage < 6 ? 0 : 1));
      // Stage 7's first look-up of photons in a thread makes a list.
      CHECK(allocations_of<PathTracer>(scene, 8) <= of_one_sample);
    }
  });
}
