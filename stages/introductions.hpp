#pragma once

#include "common/scene_file/syllabus.hpp"

namespace lightwalk {

// Which stage of the course introduces which word of the scene format. Words
// that are not here belong to the first stage.
inline constexpr Introduction introductions[] = {
    {"point", 2},   {"ks", 3},    {"kt", 3},      {"eta", 3},
    {"fresnel", 5}, {"image", 5}, {"checker", 5}, {"schlick", 5},
};

/// What stage `stage` of the course can render.
inline Syllabus syllabus(int stage) {
  return {stage, introductions};
}

}  // namespace lightwalk
