#pragma once

// The parts of a golden picture: its scene with fewer bounces, with one lobe
// alone, with one kind of light alone.

#include <functional>
#include <string>
#include <vector>

#include "common/image/render_result.hpp"
#include "common/render/render_settings.hpp"
#include "common/scene_file/loaded_scene.hpp"
#include "compare/part_story.hpp"

namespace lightwalk::tests {

struct Golden;

/// Renders a scene with the stage in question.
using Painter =
    std::function<RenderResult(const Scene&, const RenderSettings&)>;

/// Their names, in the order in which they are told.
std::vector<std::string> part_names(const Golden& golden);

/// Renders one of them with these samples and this seed.
RenderResult paint_part(const Golden& golden, const std::string& name,
                        int samples, std::uint64_t seed,
                        const Painter& paint);

/// Where they are stored.
std::string part_path(int stage, const std::string& scene);

/// What is seen in the golden's tiles.
PartsView view_of(const Golden& golden);

/// What became of the parts that are stored; renders them.
std::vector<PartVerdict> judge_parts(const Golden& golden,
                                     const std::vector<Part>& right,
                                     const Painter& paint);

}  // namespace lightwalk::tests
