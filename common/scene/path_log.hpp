#pragma once

// # A path that is listened to
//
// To debug a pixel, look at one of its paths. For this the loops of the
// stages log each vertex, and the scene logs each ray. Without a listener
// this costs one null check.

#include <cstddef>
#include <optional>
#include <vector>

#include "common/scene/surface.hpp"

namespace lightwalk {

/// A ray toward a light, and whether it reached the light.
struct ShadowRay {
  Ray ray;
  float distance;  ///< to the light
  bool reached;
};

/// What the photons around a vertex bring.
struct GatheredPhotons {
  std::size_t count;  ///< photons that counted
  float radius;
  Vec3 radiance;
};

/// One vertex of a path, as the path tracer saw it on arrival.
struct PathVertex {
  Hit hit;
  Material material;
  Vec3 wo, normal;
  Vec3 throughput, sum;
  int bounce;
  std::vector<ShadowRay> shadow_rays;
  std::optional<GatheredPhotons> photons;
};

/// What has been logged of one path.
struct PathLog {
  std::vector<Ray> rays;
  std::vector<PathVertex> vertices;
};

/// The log of this thread's paths; null if there is none.
inline constinit thread_local PathLog* path_log = nullptr;

/// While this object lives, the paths of this thread are logged.
class PathListener {
 public:
  explicit PathListener(PathLog& log) { path_log = &log; }
  ~PathListener() { path_log = nullptr; }
  PathListener(const PathListener&) = delete;
  PathListener& operator=(const PathListener&) = delete;
};

/// Logs where the path is: `throughput` is the weight of light that is found
/// from here on, `sum` the radiance found before. Does not change the path.
inline void log_vertex(const Surface& surface, const Vec3& throughput,
                       const Vec3& sum, int bounce) {
  if (!path_log) return;
  path_log->vertices.push_back({surface.hit,
                                surface.material,
                                surface.wo,
                                surface.normal,
                                throughput,
                                sum,
                                bounce,
                                {},
                                {}});
}

inline void note_ray(const Ray& ray) {
  if (path_log) path_log->rays.push_back(ray);
}

inline void note_shadow_ray(const Ray& ray, float distance, bool reached) {
  if (!path_log || path_log->vertices.empty()) return;
  path_log->vertices.back().shadow_rays.push_back({ray, distance, reached});
}

inline void note_photons(const GatheredPhotons& gathered) {
  if (!path_log || path_log->vertices.empty()) return;
  path_log->vertices.back().photons = gathered;
}

}  // namespace lightwalk
