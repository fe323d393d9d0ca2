#include "common/program/path_story.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <vector>

namespace lightwalk {

// A path tracer logs vertices, no decisions. Decisions are inferred: what
// was added at a vertex is the growth of the sum up to the next vertex. The
// direction of the next ray tells the event, and the quotient of the two
// throughputs is its weight.

namespace {

std::string print(const char* format, ...) {
  char text[200];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

/// A position or direction.
std::string place(const Vec3& v) {
  return print("(%8.4f, %8.4f, %8.4f)", static_cast<double>(v.x),
               static_cast<double>(v.y), static_cast<double>(v.z));
}

/// Three channels, which may be of any size.
std::string color(const Vec3& v) {
  return print("(%8.4g, %8.4g, %8.4g)", static_cast<double>(v.x),
               static_cast<double>(v.y), static_cast<double>(v.z));
}

std::string line(const char* label, const std::string& value,
                 const std::string& note = "") {
  std::string text = print("  %-11s", label) + value;
  if (!note.empty()) text += "  " + note;
  return text + "\n";
}

// ## What became of the rays

/// A ray that goes on from a vertex.
struct Branch {
  Vec3 direction;
  std::optional<std::size_t> to;  ///< none if it leaves the scene
};

/// The vertex at which a ray that meets nothing starts: the last of the first
/// `count` vertices that is where the ray begins.
std::size_t start_of(const Ray& ray, const std::vector<PathVertex>& vertices,
                     std::size_t count) {
  for (std::size_t i = count; i-- > 0;) {
    const Vec3& position = vertices[i].hit.position;
    const float size = 1 + max_abs_component(position);
    if (length(ray.origin - position) < 1e-3f * size) return i;
  }
  return count - 1;
}

/// For each vertex the rays that go on from it, in the order in which they
/// were followed.
std::vector<std::vector<Branch>> branches(const PathLog& log) {
  const std::vector<PathVertex>& vertices = log.vertices;
  std::vector<std::vector<Branch>> result(vertices.size());
  std::size_t next = 0;
  const auto come_to_next = [&] {
    std::size_t from = next;
    while (from-- > 0) {
      if (vertices[from].bounce + 1 != vertices[next].bounce) continue;
      result[from].push_back({-vertices[next].wo, next});
      break;
    }
    ++next;
  };
  for (const Ray& ray : log.rays) {
    if (next < vertices.size() && ray.direction == -vertices[next].wo) {
      come_to_next();
    } else if (next > 0) {
      result[start_of(ray, vertices, next)].push_back({ray.direction, {}});
    }
  }
  while (next < vertices.size()) come_to_next();
  return result;
}

// ## Vertices in words

bool is_outside(const PathVertex& vertex) {
  return dot(vertex.hit.normal, vertex.wo) > 0;
}

std::string side_of_path(const PathVertex& vertex) {
  if (vertex.hit.shape_type == ShapeType::sphere) {
    return is_outside(vertex) ? "the path is outside" : "the path is inside";
  }
  return is_outside(vertex) ? "the path is in front" : "the path is behind";
}

/// Whether the path is in glass, at an angle at which no light gets out.
bool is_beyond_critical_angle(const PathVertex& vertex) {
  if (is_outside(vertex)) return false;
  const float cos_o = dot(vertex.normal, vertex.wo);
  const float eta = vertex.material.eta;
  return eta * eta * (1 - cos_o * cos_o) >= 1;
}

/// The lobe that a path has followed if it goes on to `wi`.
std::string event_of(const PathVertex& vertex, const Vec3& wi) {
  const Vec3& normal = vertex.normal;
  const Material& material = vertex.material;
  if (dot(wi, normal) < 0) return "refraction";
  const Vec3 mirrored = 2 * dot(vertex.wo, normal) * normal - vertex.wo;
  const bool has_spike = !is_black(material.ks) || !is_black(material.kt);
  if (!has_spike || length(wi - mirrored) > 1e-3f) return "diffuse";
  if (!is_beyond_critical_angle(vertex) || is_black(material.kt)) {
    return material.fresnel && is_beyond_critical_angle(vertex)
               ? "total internal reflection"
               : "specular";
  }
  return is_black(material.ks) ? "total internal reflection"
                               : "specular or total internal";
}

/// Why the path ends at a lamp and adds nothing.
std::string why_nothing(const PathVertex& lamp) {
  return is_outside(lamp) ? "this lamp was counted at the previous vertex"
                          : "its back is black";
}

std::string end_of_path(const PathVertex& vertex, int max_bounces) {
  if (vertex.photons) return "here: the photons have brought the rest";
  const Material& m = vertex.material;
  if (m.emits()) return "at a lamp";
  if (vertex.bounce >= max_bounces) {
    return "at the bound of " + std::to_string(max_bounces) + " bounces";
  }
  const bool black = is_black(m.kd) && is_black(m.ks) && is_black(m.kt);
  return black ? "absorbed: the surface is black" : "absorbed (roulette)";
}

/// `after` over `before` in each channel; 0 where `before` is 0.
Vec3 ratio(const Vec3& after, const Vec3& before) {
  Vec3 result(0);
  for (int c = 0; c < 3; ++c) {
    if (before[c] != 0) result[c] = after[c] / before[c];
  }
  return result;
}

class Story {
 public:
  Story(const PathLog& log, const Vec3& radiance, const LoadedScene& loaded,
        int max_bounces)
      : vertices_(log.vertices),
        branches_(branches(log)),
        radiance_(radiance),
        names_(loaded.material_names),
        max_bounces_(max_bounces) {
    for (const auto& several : branches_) {
      is_tree_ = is_tree_ || several.size() > 1;
    }
  }

  /// One vertex. In a tree each bounce indents it further.
  std::string vertex(std::size_t i) const {
    const PathVertex& vertex = vertices_[i];
    const Material& material = vertex.material;
    const auto name = names_.find(vertex.hit.material);
    std::string text = print(
        "vertex %zu: %s[%u] of '%s', bounce %d\n", i,
        shape_name(vertex.hit.shape_type).c_str(), vertex.hit.shape_index,
        name == names_.end() ? "?" : name->second.c_str(), vertex.bounce);
    text += line("position", place(vertex.hit.position));
    text += line("normal", place(vertex.hit.normal), side_of_path(vertex));
    text += line("wo", place(vertex.wo));
    for (const auto& [label, k] : {std::pair{"kd", material.kd},
                                   {"ks", material.ks},
                                   {"kt", material.kt},
                                   {"ke", material.ke}}) {
      if (!is_black(k)) text += line(label, color(k));
    }
    text += line("throughput", color(vertex.throughput));
    for (const ShadowRay& shadow : vertex.shadow_rays) {
      text += line("light", place(shadow.ray.direction),
                   print("at %.4g: ", static_cast<double>(shadow.distance)) +
                       (shadow.reached ? "reached" : "blocked"));
    }
    if (vertex.photons) {
      const auto& [count, radius, radiance] = *vertex.photons;
      text +=
          line("photons", color(radiance),
               print("%zu within %.4g", count, static_cast<double>(radius)));
    }
    text += addition(i);
    for (const Branch& branch : branches_[i]) text += step(vertex, branch);
    if (branches_[i].empty()) {
      text += line("ends", end_of_path(vertex, max_bounces_));
    }
    return is_tree_ ? indented(text, 2 * std::min(vertex.bounce, 4)) : text;
  }

 private:
  /// What is added to the sum at vertex i.
  std::string addition(std::size_t i) const {
    const Vec3& before = vertices_[i].sum;
    const Vec3& after =
        i + 1 < vertices_.size() ? vertices_[i + 1].sum : radiance_;
    const Vec3 added = after - before;
    const bool emits = vertices_[i].material.emits();
    if (is_black(added)) {
      if (emits) return line("adds", "nothing: " + why_nothing(vertices_[i]));
      if (vertices_[i].shadow_rays.empty() && !vertices_[i].photons)
        return "";
    }
    const char* const source = emits ? "emission"
                               : vertices_[i].photons
                                   ? "direct light, photons"
                                   : "direct light";
    return line("adds", color(added), source) + line("sum", color(after));
  }

  std::string step(const PathVertex& from, const Branch& branch) const {
    const std::string event = event_of(from, branch.direction);
    const std::string way = place(branch.direction);
    if (!branch.to) {
      return line("goes on", way, event) + line("ends", "leaves the scene");
    }
    const Vec3 weight =
        ratio(vertices_[*branch.to].throughput, from.throughput);
    return line("goes on", way, event) +
           line("weight", color(weight),
                is_tree_ ? print("to vertex %zu", *branch.to) : "");
  }

  static std::string indented(const std::string& text, int columns) {
    const std::string margin(static_cast<std::size_t>(columns), ' ');
    std::string result = margin;
    for (const char c : text) {
      result += c;
      if (c == '\n') result += margin;
    }
    result.resize(result.size() - margin.size());
    return result;
  }

  const std::vector<PathVertex>& vertices_;
  std::vector<std::vector<Branch>> branches_;
  Vec3 radiance_;
  const std::map<const Material*, std::string>& names_;
  int max_bounces_;
  bool is_tree_ = false;
};

}  // namespace

std::string path_story(const PathLog& log, const Vec3& radiance,
                       const LoadedScene& loaded,
                       const RenderSettings& settings) {
  std::string text;
  if (!log.rays.empty()) {
    text += "camera\n" + line("position", place(log.rays[0].origin)) +
            line("direction", place(log.rays[0].direction));
  }
  if (log.vertices.empty()) text += line("ends", "leaves the scene");
  const Story story(log, radiance, loaded, settings.max_bounces);
  for (std::size_t i = 0; i < log.vertices.size(); ++i) {
    text += "\n" + story.vertex(i);
  }
  return text + print("\nradiance of this sample = (%.9g, %.9g, %.9g)\n",
                      static_cast<double>(radiance.x),
                      static_cast<double>(radiance.y),
                      static_cast<double>(radiance.z));
}

}  // namespace lightwalk
