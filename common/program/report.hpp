#pragma once

#include <string>
#include <vector>

#include "common/image/render_result.hpp"

namespace lightwalk {

/// A render as other programs want to read of it.
struct Report {
  std::string scene = {};  ///< its file, as it was named
  int width = 0, height = 0;
  RenderInfo info = {};
  int threads = 1;
  double seconds = 0;      ///< by the clock on the wall
  double cpu_seconds = 0;  ///< of all threads together
  bool interrupted = false;
  std::vector<std::string> outputs = {};
};

/// The report as a JSON object; README.md lists its keys.
std::string to_json(const Report& report);

/// Writes the report so that the name always stands for a whole one. Throws
/// a FileError.
void write_report(const std::string& path, const Report& report);

}  // namespace lightwalk
