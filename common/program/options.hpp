#pragma once

// The command line that all stages share.

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "common/image/image_file.hpp"
#include "common/image/tone_mapping.hpp"
#include "common/render/render_settings.hpp"
#include "common/scene_file/message_text.hpp"

namespace lightwalk {

struct ImageSize {
  int width, height;
};

/// Reads "128x128". No size where the text is not one.
inline std::optional<ImageSize> parse_size(const std::string& text) {
  ImageSize size{};
  const char* end = text.data() + text.size();
  const auto width = std::from_chars(text.data(), end, size.width);
  if (width.ec != std::errc{} || width.ptr == end || *width.ptr != 'x') {
    return std::nullopt;
  }
  const auto height = std::from_chars(width.ptr + 1, end, size.height);
  const auto fits = [](int n) { return n >= 1 && n <= 65536; };
  if (height.ec != std::errc{} || height.ptr != end || !fits(size.width) ||
      !fits(size.height)) {
    return std::nullopt;
  }
  return size;
}

/// Reads a seed. None where the text is not a whole number of 64 bits.
inline std::optional<std::uint64_t> parse_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, seed);
  if (read.ec != std::errc{} || read.ptr != end) return std::nullopt;
  return seed;
}

inline ToneStep tone_step(const std::string& name) {
  if (name == "clamp") return ToneStep::clamp;
  if (name == "equalize") return ToneStep::equalize;
  if (name == "reinhard") return ToneStep::reinhard;
  return ToneStep::gamma;
}

/// What the user asked for. What is empty, the scene or a default decides.
struct Options {
  std::string scene;
  std::vector<std::string> outputs;
  std::optional<int> samples_per_pixel, max_bounces;
  std::optional<ImageSize> size;
  std::uint64_t seed = 1;
  int threads = 0;
  Sampling sampling = Sampling::cosine;
  ToneMapping tone_mapping;
  bool quiet = false;
};

/// Reads the command line into `options`. Returns the exit code where there
/// is nothing to render: 0 after --help or --version, 2 after wrong usage.
inline std::optional<int> parse_options(int argc, char** argv,
                                        const std::string& program,
                                        const std::string& description,
                                        int most_bounces, Options& options) {
  CLI::App app(description, program);
  // An option that is given twice counts as it was given last.
  app.option_defaults()->multi_option_policy(
      CLI::MultiOptionPolicy::TakeLast);
  app.set_version_flag("--version",
                       program + " (Lightwalk) " + LIGHTWALK_VERSION);
  app.add_option("scene", options.scene, "Scene file (.toml)")->required();
  app.add_option("-o,--output", options.outputs,
                 "Image to write: .exr or .pfm (linear radiance), .ppm (the "
                 "course's P3 with #MAX), .png (tone mapped); may be given "
                 "several times")
      ->required()
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->check([](const std::string& path) {
        return is_image_ending(ending(path))
                   ? std::string()
                   : "'" + path + "' ends in none of .exr, .pfm, .ppm, .png";
      });
  app.add_option("--spp", options.samples_per_pixel,
                 "Samples per pixel [scene's, or 64]")
      ->check(CLI::Range(1, 1'000'000'000));
  app.add_option("--max-bounces", options.max_bounces,
                 "Longest path, in bounces")
      ->check(CLI::Range(0, most_bounces));
  app.add_option("--seed", options.seed, "Another seed gives other noise [1]")
      ->check([](const std::string& text) {
        // CLI11 would wrap what does not fit: -1 to 2^64 - 1, 2^64 to 0.
        return parse_seed(text) ? std::string()
                                : "'" + text +
                                      "' is not a whole number from "
                                      "0 to 18446744073709551615";
      });
  app.add_option("--threads", options.threads,
                 "Threads; 0 takes as many as the machine has [0]")
      ->check(CLI::Range(0, 1024));
  std::string size;
  app.add_option("--size", size, "Columns x rows, like 128x128 [scene's]")
      ->check([](const std::string& text) {
        return parse_size(text)
                   ? std::string()
                   : "'" + text +
                         "' is not a size like 128x128, each from 1 "
                         "to 65536";
      });
  std::string sampling = "cosine";
  app.add_option("--sampling", sampling,
                 "How diffuse directions are drawn: cosine or uniform "
                 "[cosine]")
      ->check(CLI::IsMember({"cosine", "uniform"}));
  std::vector<std::string> steps;
  app.add_option("--tone-map", steps,
                 "For .png, steps in order, like --tone-map clamp,gamma: "
                 "clamp, equalize, gamma, reinhard [equalize,gamma]")
      ->delimiter(',')
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->check(CLI::IsMember({"clamp", "equalize", "gamma", "reinhard"}));
  const auto is_number = [](const std::string& text) {
    // CLI::Range lets "nan" through: it is neither below nor above.
    return std::isnan(std::strtof(text.c_str(), nullptr))
               ? "'" + text + "' is not a number"
               : std::string();
  };
  std::optional<float> gamma;
  app.add_option("--gamma", gamma,
                 "For .png: exponent of the gamma step, "
                 "which it adds where there is none [2.2]")
      ->check(is_number)
      ->check(CLI::Range(0.1, 10.0));
  app.add_option("--exposure", options.tone_mapping.exposure,
                 "For .png, in stops: times 2^exposure before the steps [0]")
      ->check(is_number)
      ->check(CLI::Range(-40.0, 40.0));
  app.add_flag("-q,--quiet", options.quiet, "Say nothing but errors");

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "%s: %s (%s --help lists the options)\n",
                 program.c_str(), one_line(error.what()).c_str(),
                 program.c_str());
    return 2;
  }
  options.size = parse_size(size);
  if (sampling == "uniform") options.sampling = Sampling::uniform;
  ToneMapping& mapping = options.tone_mapping;
  if (!steps.empty()) mapping.steps.clear();
  for (const std::string& step : steps) {
    mapping.steps.push_back(tone_step(step));
  }
  if (gamma) {
    mapping.gamma = *gamma;
    if (std::find(mapping.steps.begin(), mapping.steps.end(),
                  ToneStep::gamma) == mapping.steps.end()) {
      mapping.steps.push_back(ToneStep::gamma);
    }
  }
  return std::nullopt;
}

}  // namespace lightwalk
