#pragma once

// A path logs at its vertices (`--pixel` prints it) what it computes.

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "common/scene/path_log.hpp"
#include "support/each_or_mean.hpp"
#include "support/renders.hpp"

namespace lightwalk::tests {

/// Paths within a sphere of radius 1. `lights` is a point light of intensity
/// pi at its center, or nothing: a wall reflects kd/pi * pi / 1^2 = kd of it.
/// So each vertex but the last adds its throughput times kd to the sum, and
/// nothing else does.
template <class PathTracer>
void check_told_paths(const std::string& lights) {
  const Scene scene = scene_text(R"(
[materials]
wall = { kd = [0.8, 0.4, 0.2] }
[[shapes]]
type = "sphere"
center = [0, 0, 0]
radius = 1
material = "wall"
)" + lights);
  const Vec3 kd(0.8f, 0.4f, 0.2f);
  const Vec3 added = lights.empty() ? Vec3(0) : kd;
  constexpr int max_bounces = 5;
  RenderSettings settings;
  settings.max_bounces = max_bounces;
  const PathTracer tracer(scene, settings);
  const Ray ray{{0.2f, 0.1f, -0.3f}, normalize(Vec3(1, 2, 3))};

  std::size_t longest = 0;
  // kd + kd^2 + ... + kd^5, of red.
  EachOrMean seen(0.8 * (1 - std::pow(0.8, 5)) / 0.2, 1e-5);
  for (std::uint64_t sample = 0; sample < 1000; ++sample) {
    PathLog log;
    Random random(1, 0, sample);
    const PathListener listener(log);
    const Vec3 radiance = tracer.radiance(ray, random);
    REQUIRE_MESSAGE(!log.vertices.empty(), "log_vertex was never called");
    longest = std::max(longest, log.vertices.size());

    Vec3 all_added(0);
    bool told_any = false;
    for (const PathVertex& vertex : log.vertices) {
      told_any = told_any || vertex.sum != Vec3(0);
      if (vertex.bounce < max_bounces) all_added += vertex.throughput * added;
    }
    const bool usual = max_component(glm::abs(radiance - all_added)) <= 1e-5f;
    if (!lights.empty()) seen.add(radiance.x);
    Vec3 sum(0), told(0);
    Vec3 shares(1);  // of throughput in the three channels, red's being 1
    for (std::size_t i = 0; i < log.vertices.size(); ++i) {
      const PathVertex& vertex = log.vertices[i];
      const Vec3& throughput = vertex.throughput;
      CHECK(vertex.bounce == static_cast<int>(i));
      if (i == 0) CHECK(throughput.x == 1);
      for (int c = 0; c < 3; ++c) {
        INFO("channel ", c, " at vertex ", i, ": throughput ", throughput[c],
             ", sum before it ", vertex.sum[c], ", expected ", sum[c],
             ": each vertex adds its throughput times kd. If tests of light "
             "fail, too, start with those");
        CHECK(throughput[c] > 0);
        CHECK(throughput[c] / throughput.x ==
              doctest::Approx(shares[c]).epsilon(1e-5));
        if (usual && told_any) {
          CHECK(vertex.sum[c] == doctest::Approx(sum[c]).epsilon(1e-5));
        }
        CHECK(vertex.sum[c] >= told[c]);
        CHECK(vertex.sum[c] <= radiance[c] * 1.00001f);
      }
      told = vertex.sum;
      if (i < max_bounces) sum += throughput * added;
      shares *= kd / kd.x;
    }
    if (lights.empty()) CHECK(radiance == Vec3(0));
  }
  CHECK(longest == max_bounces + 1);
  const std::string wrong = lights.empty() ? "" : seen.wrong();
  if (!wrong.empty()) FAIL_CHECK("kd + kd^2 + ... + kd^5: " << wrong);
}

}  // namespace lightwalk::tests
