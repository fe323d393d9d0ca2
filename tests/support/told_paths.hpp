#pragma once

// A path logs at its vertices (`--pixel` prints it) what it computes.

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "common/scene/path_log.hpp"
#include "support/each_or_mean.hpp"
#include "support/first_things.hpp"
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

  // A program may follow several branches, one after the other.
  bool one_path = true;
  for (std::uint64_t sample = 0; sample < 1000; ++sample) {
    const PathLog log = listen_to(tracer, ray, sample);
    for (std::size_t i = 0; i < log.vertices.size(); ++i) {
      one_path = one_path && log.vertices[i].bounce == static_cast<int>(i);
    }
  }

  int longest = 0;
  // kd + kd^2 + ... + kd^5, of red.
  EachOrMean seen(0.8 * (1 - std::pow(0.8, 5)) / 0.2, 1e-5);
  for (std::uint64_t sample = 0; sample < 1000; ++sample) {
    PathLog log;
    Random random(1, 0, sample);
    const PathListener listener(log);
    const Vec3 radiance = tracer.radiance(ray, random);
    if (log.vertices.empty()) FAIL("log_vertex was never called");

    Vec3 all_added(0);
    bool told_any = false;
    for (const PathVertex& vertex : log.vertices) {
      told_any = told_any || vertex.sum != Vec3(0);
      if (vertex.bounce < max_bounces) all_added += vertex.throughput * added;
      longest = std::max(longest, vertex.bounce);
    }
    const bool usual = one_path && told_any &&
                       max_component(glm::abs(radiance - all_added)) <= 1e-5f;
    if (!lights.empty()) seen.add(radiance.x);
    Vec3 sum(0), told(0);
    int bounce = -1;
    for (std::size_t i = 0; i < log.vertices.size(); ++i) {
      const PathVertex& vertex = log.vertices[i];
      const Vec3& throughput = vertex.throughput;
      const std::string where =
          "vertex " + std::to_string(i) + " of the log of a path: ";
      const bool follows = vertex.bounce >= (i == 0 ? 0 : 1) &&
                           vertex.bounce <= bounce + 1 &&
                           vertex.bounce <= max_bounces;
      if (!follows) {
        FAIL(where << "bounce " << vertex.bounce << ", expected "
                   << bounce + 1);
      }
      bounce = vertex.bounce;
      if (i == 0 && throughput != Vec3(1)) {
        FAIL(where << "throughput " << throughput << ", expected "
                   << Vec3(1));
      }
      for (int c = 0; c < 3; ++c) {
        const std::string in_channel = ", channel " + std::to_string(c);
        // Red's share is 1.
        const float share = std::pow(kd[c] / kd.x, float(bounce));
        if (!(throughput[c] > 0) ||
            std::abs(throughput[c] / throughput.x - share) > 1e-5f) {
          FAIL(where << "throughput " << throughput[c] << in_channel
                     << ", expected kd^" << bounce << ", "
                     << share * throughput.x << " for red's "
                     << throughput.x);
        }
        const float before = vertex.sum[c];
        if (usual && !(std::abs(before - sum[c]) <= 1e-5f * (1 + sum[c]))) {
          FAIL(where << "the sum before it is " << before << in_channel
                     << ", expected " << sum[c]
                     << ": each vertex adds its throughput times kd. If "
                        "tests of light fail, too, start with those");
        }
        if (one_path &&
            !(before >= told[c] && before <= radiance[c] * 1.00001f)) {
          FAIL(where << "the sum before it is " << before << in_channel
                     << ", expected from " << told[c]
                     << ", the one before, to " << radiance[c]
                     << ", the path's radiance");
        }
      }
      told = vertex.sum;
      if (bounce < max_bounces) sum += throughput * added;
    }
    if (lights.empty() && radiance != Vec3(0)) {
      FAIL("without a light a path brings " << radiance << ", expected "
                                            << Vec3(0));
    }
  }
  if (longest != max_bounces) {
    FAIL_CHECK("the longest of 1000 paths has "
               << longest << " bounces, expected " << max_bounces);
  }
  const std::string wrong = lights.empty() ? "" : seen.wrong();
  if (!wrong.empty()) FAIL_CHECK("kd + kd^2 + ... + kd^5: " << wrong);
}

}  // namespace lightwalk::tests
