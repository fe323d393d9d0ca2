#pragma once

#include <string>

#include "common/render/render_settings.hpp"
#include "common/scene/path_log.hpp"
#include "common/scene_file/loaded_scene.hpp"

namespace lightwalk {

/// The path in words, vertex by vertex, as `log` has heard of it; `radiance`
/// is what it brought. Several lines, the last one the radiance.
std::string path_story(const PathLog& log, const Vec3& radiance,
                       const LoadedScene& loaded,
                       const RenderSettings& settings);

}  // namespace lightwalk
