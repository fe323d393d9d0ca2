#include "common/program/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>

#include "common/program/command_line.hpp"
#include "common/scene/camera.hpp"
#include "common/scene_file/suggestion.hpp"

namespace lightwalk {

namespace {

/// A whole number, if all of the text is one that fits.
template <class Number>
std::optional<Number> whole_number(std::string_view text) {
  Number number = 0;
  const char* const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  if (read.ec != std::errc{} || read.ptr != end) return std::nullopt;
  return number;
}

/// Two whole numbers with a separator between them, like 128x128.
std::optional<std::pair<int, int>> pair_of_numbers(std::string_view text,
                                                   char separator) {
  const std::size_t middle = text.find(separator);
  if (middle == std::string_view::npos) return std::nullopt;
  const auto first = whole_number<int>(text.substr(0, middle));
  const auto second = whole_number<int>(text.substr(middle + 1));
  if (!first || !second) return std::nullopt;
  return std::pair{*first, *second};
}

std::optional<ImageSize> size_of(const std::string& text) {
  const auto numbers = pair_of_numbers(text, 'x');
  const auto fits = [](int n) { return n >= 1 && n <= 65536; };
  if (!numbers || !fits(numbers->first) || !fits(numbers->second)) {
    return std::nullopt;
  }
  return ImageSize{numbers->first, numbers->second};
}

std::optional<PixelSample> pixel_of(const std::string& text) {
  const auto numbers = pair_of_numbers(text, ',');
  if (!numbers || numbers->first < 0 || numbers->second < 0) {
    return std::nullopt;
  }
  return PixelSample{numbers->first, numbers->second};
}

/// An option whose text `parse` turns into its value. If it returns none, the
/// error is the text and `complaint`, such as "is not a number".
template <class Value, class Parse>
CLI::Option* add_parsed(CLI::App& app, const std::string& name,
                        std::optional<Value>& value, Parse parse,
                        const std::string& complaint,
                        const std::string& help) {
  return app.add_option_function<std::string>(
      name,
      [=, &value](const std::string& text) {
        value = parse(text);
        if (!value) {
          throw CLI::ValidationError(name, in_quotes(text) + complaint);
        }
      },
      help);
}

/// An option that takes a whole number. All digits are decimal: CLI11 itself
/// would read 010 as eight, wrap -1 to 2^64 - 1, and 2^64 to 0.
template <class Number>
CLI::Option* add_whole(CLI::App& app, const std::string& name,
                       std::optional<Number>& value, Number least,
                       Number most, const std::string& help) {
  const auto parse = [=](const std::string& text) {
    const auto number = whole_number<Number>(text);
    return number && *number >= least && *number <= most ? number
                                                         : std::nullopt;
  };
  return add_parsed(app, name, value, parse,
                    " is not a whole number from " + std::to_string(least) +
                        " to " + std::to_string(most),
                    help)
      ->type_name("N");
}

/// A default as --help shows it.
std::string shown(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

/// An option that takes a number within bounds.
CLI::Option* add_number(CLI::App& app, const std::string& name,
                        std::optional<float>& value, double least,
                        double most, const std::string& help) {
  const auto parse = [=](const std::string& text) -> std::optional<float> {
    // CLI11 reads "0x2", "1_0", "1'0" and "nan", too.
    const bool plain =
        text.find_first_not_of("0123456789+-.eE") == std::string::npos;
    double number = 0;
    if (!plain || !CLI::detail::lexical_cast(text, number) ||
        !(number >= least && number <= most)) {
      return std::nullopt;
    }
    return static_cast<float>(number);
  };
  return add_parsed(
      app, name, value, parse,
      " is not a number from " + shown(least) + " to " + shown(most), help);
}

constexpr std::array<std::string_view, 2> sampling_names = {"cosine",
                                                            "uniform"};
constexpr std::array<std::string_view, 2> filter_names = {"cone", "box"};
constexpr std::array<std::string_view, 4> step_names = {"clamp", "equalize",
                                                        "gamma", "reinhard"};

/// The value of an enumeration with this name; `names` has its order.
template <class Value, class Names>
std::optional<Value> named(const std::string& text, const Names& names) {
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) return std::nullopt;
  return static_cast<Value>(found - names.begin());
}

/// The options besides the scene that say what to render.
void add_render_options(CLI::App& app, const Program& program,
                        Options& options) {
  const RenderSettings defaults;
  const Camera camera;
  const std::string or_scene = "scene's, or ";
  add_whole(app, "--spp", options.samples_per_pixel, 1, 1'000'000'000,
            "Samples per pixel")
      ->default_str(or_scene + std::to_string(defaults.samples_per_pixel));
  add_whole(app, "--first-sample", options.first_sample, std::uint32_t{0},
            std::uint32_t{3'000'000'000},
            "Number of each pixel's first sample; stage-merge joins pictures "
            "of other samples")
      ->default_str("0");
  add_whole(app, "--max-bounces", options.max_bounces, 0,
            program.bounce_limit, "Longest path, in bounces")
      ->default_str(or_scene + std::to_string(program.default_bounces));
  add_whole(app, "--seed", options.seed, std::uint64_t{0},
            std::numeric_limits<std::uint64_t>::max(),
            "Another seed gives other noise")
      ->default_str(std::to_string(defaults.seed));
  add_whole(app, "--threads", options.threads, 0, 1024,
            "0 takes as many as the machine has")
      ->default_str(std::to_string(defaults.threads));
  add_parsed(app, "--size", options.size, size_of,
             " is not a size like 128x128, each from 1 to 65536",
             "Columns x rows, like 128x128")
      ->type_name("WxH")
      ->default_str(or_scene + std::to_string(camera.width) + 'x' +
                    std::to_string(camera.height));
  add_parsed(
      app, "--sampling", options.sampling,
      [](const std::string& text) {
        return named<Sampling>(text, sampling_names);
      },
      " is none of " + listed(sampling_names),
      "How diffuse directions are drawn: " + listed(sampling_names))
      ->type_name("HOW")
      ->default_str(std::string(
          sampling_names[static_cast<std::size_t>(defaults.sampling)]));
}

/// The options of a program that has photons.
void add_photon_options(CLI::App& app, Options& options) {
  const RenderSettings defaults;
  add_whole(app, "--photons", options.photons, 1, 100'000'000,
            "Photons that leave the lights, for each sample of a pixel")
      ->default_str(std::to_string(defaults.photons));
  add_whole(app, "--neighbors", options.neighbors, 2, 1'000'000,
            "The first radius is the distance to so many photons")
      ->default_str(std::to_string(defaults.neighbors));
  add_number(app, "--radius", options.radius, 1e-6, 1e30,
             "The first radius is at most this long; without it, as long as "
             "it takes")
      ->type_name("X");
  add_parsed(
      app, "--filter", options.filter,
      [](const std::string& text) {
        return named<Filter>(text, filter_names);
      },
      " is none of " + listed(filter_names),
      "How photons count by their distance: " + listed(filter_names))
      ->type_name("HOW")
      ->default_str("cone");
}

/// The options for .png. parse_options() combines them.
void add_tone_options(CLI::App& app, std::vector<ToneStep>& steps,
                      std::optional<float>& gamma,
                      std::optional<float>& exposure) {
  const ToneMapping defaults;
  std::string default_steps;
  for (const ToneStep step : defaults.steps) {
    default_steps += default_steps.empty() ? "" : ",";
    default_steps += step_names[static_cast<std::size_t>(step)];
  }
  const std::string name = "--tone-map";
  app.add_option_function<std::vector<std::string>>(
         name,
         [=, &steps](const std::vector<std::string>& words) {
           for (const std::string& word : words) {
             const auto step = named<ToneStep>(word, step_names);
             if (!step) {
               throw CLI::ValidationError(name, none_of(word, step_names));
             }
             steps.push_back(*step);
           }
         },
         "For .png: steps in order, out of " + listed(step_names))
      ->delimiter(',')
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->type_name("STEPS")
      ->default_str(default_steps);
  add_number(app, "--gamma", gamma, 0.1, 10,
             "For .png: exponent of the gamma step, which it adds where "
             "there is none")
      ->type_name("X")
      ->default_str(shown(defaults.gamma));
  add_number(app, "--exposure", exposure, -40, 40,
             "For .png, in stops: times 2^exposure before the steps")
      ->type_name("X")
      ->default_str(shown(defaults.exposure));
}

}  // namespace

std::optional<int> parse_options(int argc, char** argv,
                                 const Program& program, Options& options) {
  const std::string example =
      "build/" + program.name +
      " scenes/cornell_box_ceiling_diffuse.toml -o box.png";
  CLI::App app(program.description, program.name);
  app.formatter(
      std::make_shared<HelpText>(example, "SCENE -o IMAGE [OPTION]..."));
  app.allow_windows_style_options(false);  // /home/ana/box.toml is a file
  // If an option is given twice, the last one counts.
  app.option_defaults()->multi_option_policy(
      CLI::MultiOptionPolicy::TakeLast);
  app.add_option("SCENE", options.scene, "Scene file (.toml)");
  app.add_option("-o,--output", options.outputs,
                 "Image to write: .exr or .pfm (linear radiance), .ppm (the "
                 "course's P3 with #MAX), .png (tone mapped); may be given "
                 "several times")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->type_name("IMAGE")
      ->check(named_with("images", endings_with(&ImageFormat::encode)));
  app.add_option("--report", options.report,
                 "What was rendered and how fast, for programs (.json)")
      ->type_name("FILE")
      ->check(named_with("reports", std::array{".json"}));
  add_render_options(app, program, options);
  if (program.has_photons) add_photon_options(app, options);
  CLI::Option* const pixel =
      add_parsed(app, "--pixel", options.pixel, pixel_of,
                 " is not a pixel like 120,80, from 0,0 on",
                 "Tell one path of the pixel at column X, row Y, vertex by "
                 "vertex; no image is written")
          ->type_name("X,Y");
  std::optional<std::uint32_t> sample;
  add_whole(app, "--sample", sample, 0u, 999'999'999u,
            "Which of the pixel's paths")
      ->needs(pixel)
      ->default_str("0");
  std::vector<ToneStep> steps;
  std::optional<float> gamma, exposure;
  add_tone_options(app, steps, gamma, exposure);
  app.add_flag("-q,--quiet", options.quiet, "Say nothing but errors");
  add_help_and_version(
      app,
      LIGHTWALK_VERSION + (program.mode.empty() ? "" : ", " + program.mode));
  app.footer(
      "Ctrl-C writes what was rendered so far; an old picture is kept until "
      "each pixel has a sample. "
      "Exit codes: 0 done, 1 could not, 2 wrong usage, 130 interrupted.");

  if (const auto code = parse(app, argc, argv)) return code;
  const auto required = [&](const std::string& what) {
    return wrong_usage(program.name,
                       what + " is required, as in '" + example + "'");
  };
  if (app.count("SCENE") == 0) return required("a scene");
  if (options.outputs.empty() && !options.report && !options.pixel) {
    return required("--output");
  }
  ToneMapping& mapping = options.tone_mapping;
  mapping.exposure = exposure.value_or(mapping.exposure);
  if (options.pixel) options.pixel->sample = sample.value_or(0);
  if (!steps.empty()) mapping.steps = steps;
  if (gamma) {
    mapping.gamma = *gamma;
    const auto& all = mapping.steps;
    if (std::find(all.begin(), all.end(), ToneStep::gamma) == all.end()) {
      mapping.steps.push_back(ToneStep::gamma);
    }
  }
  return std::nullopt;
}

}  // namespace lightwalk
