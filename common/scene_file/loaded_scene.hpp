#pragma once

#include <map>
#include <optional>
#include <string>

#include "common/scene/scene.hpp"

namespace lightwalk {

/// A scene as it was read, with what its file says beside it.
struct LoadedScene {
  Scene scene;
  std::string sha256;  ///< of the file's bytes, in hexadecimal
  std::optional<int> samples_per_pixel;
  std::optional<int> max_bounces;
  std::map<const Material*, std::string> material_names;
};

}  // namespace lightwalk
