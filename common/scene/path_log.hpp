#pragma once

// # A path that is listened to
//
// Who doubts a pixel wants to see one of its paths. So the loops of the
// stages say at each vertex where they are, and the scene says which rays it
// was asked about. Where nobody listens, all of it is a glance at a null
// pointer.

#include <vector>

#include "common/scene/surface.hpp"

namespace lightwalk {

/// A ray towards a light, and whether it came there.
struct ShadowRay {
  Ray ray;
  float distance;  ///< to the light
  bool reached;
};

/// One vertex of a path, as the path tracer saw it when it came there.
struct PathVertex {
  Hit hit;
  Material material;
  Vec3 wo, normal;
  Vec3 throughput, sum;
  int bounce;
  std::vector<ShadowRay> shadow_rays;
};

/// What has been heard of one path.
struct PathLog {
  std::vector<Ray> rays;
  std::vector<PathVertex> vertices;
};

/// Who listens to the paths of this thread; null if nobody does.
inline constinit thread_local PathLog* path_log = nullptr;

/// While it lives, the paths of this thread are heard.
class PathListener {
 public:
  explicit PathListener(PathLog& log) { path_log = &log; }
  ~PathListener() { path_log = nullptr; }
  PathListener(const PathListener&) = delete;
  PathListener& operator=(const PathListener&) = delete;
};

/// Says where the path is: `throughput` is what light from here on counts,
/// `sum` what has been found before. Changes nothing.
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
                                {}});
}

inline void note_ray(const Ray& ray) {
  if (path_log) path_log->rays.push_back(ray);
}

inline void note_shadow_ray(const Ray& ray, float distance, bool reached) {
  if (!path_log || path_log->vertices.empty()) return;
  path_log->vertices.back().shadow_rays.push_back({ray, distance, reached});
}

}  // namespace lightwalk
