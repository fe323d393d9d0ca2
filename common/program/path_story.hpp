#pragma once

#include <string>

#include "common/render/render_settings.hpp"
#include "common/scene/path_log.hpp"
#include "common/scene_file/loaded_scene.hpp"

namespace lightwalk {

/// The path in words, vertex by vertex, from its `log`; `radiance` is its
/// result. Several lines; the last one is the radiance.
std::string path_story(const PathLog& log, const Vec3& radiance,
                       const LoadedScene& loaded,
                       const RenderSettings& settings);

}  // namespace lightwalk
