#pragma once

// The command line that all stages share.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/image/render_result.hpp"
#include "common/image/tone_mapping.hpp"
#include "common/render/render_settings.hpp"
#include "common/scene_file/syllabus.hpp"

namespace lightwalk {

struct ImageSize {
  int width, height;
};

/// What the user asked for, and nothing else. The scene or a default decides
/// what is empty here.
struct Options {
  std::string scene;
  std::vector<std::string> outputs;
  std::optional<std::string> report;
  std::optional<PixelSample> pixel;  ///< whose path to tell
  std::optional<int> samples_per_pixel, max_bounces, threads, photons,
      neighbors;
  std::optional<std::uint32_t> first_sample;
  std::optional<std::uint64_t> seed;
  std::optional<Sampling> sampling;
  std::optional<float> radius;
  std::optional<Filter> filter;
  std::optional<ImageSize> size;
  ToneMapping tone_mapping;
  bool quiet = false;
};

/// What a stage tells the program about itself.
struct Program {
  std::string name = {};         ///< "stage1"
  std::string description = {};  ///< one line for --help
  std::string mode = {};         ///< what --version says besides
  Syllabus syllabus = {};        ///< which scenes it can paint
  int default_bounces = bounce_cap;
  int bounce_limit = bounce_cap;
  bool has_photons = false;  ///< and the options that say how many
};

/// Reads the command line into `options`. Returns the exit code where there
/// is nothing to render: 0 after --help or --version, 2 after wrong usage.
std::optional<int> parse_options(int argc, char** argv,
                                 const Program& program, Options& options);

}  // namespace lightwalk
