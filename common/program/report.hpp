#pragma once

#include <string>
#include <vector>

#include "common/image/render_result.hpp"

namespace lightwalk {

/// What other programs want to know of a render.
struct Report {
  std::string scene = {};  ///< its file, as it was named
  int width = 0, height = 0;
  RenderInfo info = {};
  int threads = 1;
  double seconds = 0;      ///< wall-clock time
  double cpu_seconds = 0;  ///< of all threads together
  bool interrupted = false;
  std::vector<std::string> outputs = {};
};

/// The report as a JSON object; README.md lists its keys.
std::string to_json(const Report& report);

/// Writes the report whole or not at all. Throws a FileError.
void write_report(const std::string& path, const Report& report);

}  // namespace lightwalk
