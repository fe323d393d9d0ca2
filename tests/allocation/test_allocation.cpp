// No stage asks for memory per ray or per sample: it would be the slowest
// thing that it does, and threads would wait for each other over it.

#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "tests/support/renders.hpp"
#if __has_include("stages/1_diffuse/path_tracer.hpp")
#include "stages/1_diffuse/path_tracer.hpp"
#endif
#if __has_include("stages/2_next_event/path_tracer.hpp")
#include "stages/2_next_event/path_tracer.hpp"
#endif
#if __has_include("stages/3_specular_refraction/path_tracer.hpp")
#include "stages/3_specular_refraction/path_tracer.hpp"
#endif
#if __has_include("stages/4_russian_roulette/path_tracer.hpp")
#include "stages/4_russian_roulette/path_tracer.hpp"
#endif
#if __has_include("stages/5_fresnel_textures/path_tracer.hpp")
#include "stages/5_fresnel_textures/path_tracer.hpp"
#endif

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

/// What a renderer asks for to render 64 x 64 pixels with some samples each.
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

template <class PathTracer>
void check_allocations(const Scene& scene) {
  CHECK(allocations_of<PathTracer>(scene, 4) == 0);
}

}  // namespace

TEST_CASE("the count of allocations counts") {
  const long before = allocations;
  const Film film(8, 8);
  CHECK(allocations > before);
}

TEST_CASE("no stage allocates memory while it renders") {
#if __has_include("stages/1_diffuse/path_tracer.hpp")
  check_allocations<stage1::PathTracer>(
      scene_file("cornell_box_ceiling_diffuse", 64, 64));
#endif
#if __has_include("stages/2_next_event/path_tracer.hpp")
  check_allocations<stage2::PathTracer>(
      scene_file("cornell_box_lamp_diffuse", 64, 64));
#endif
#if __has_include("stages/3_specular_refraction/path_tracer.hpp")
  check_allocations<stage3::PathTracer>(
      scene_file("cornell_box_point", 64, 64));
#endif
#if __has_include("stages/4_russian_roulette/path_tracer.hpp")
  check_allocations<stage4::PathTracer>(
      scene_file("cornell_box_point", 64, 64));
#endif
#if __has_include("stages/5_fresnel_textures/path_tracer.hpp")
  check_allocations<stage5::PathTracer>(scene_file("textured_globe", 64, 64));
#endif
}
