#include "common/program/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <limits>
#include <utility>

#include "common/image/image_file.hpp"
#include "common/scene_file/message_text.hpp"

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

/// An option whose text `parse` turns into its value, or into none where the
/// text is not `what` is expected.
template <class Value, class Parse>
CLI::Option* add_parsed(CLI::App& app, const std::string& name,
                        std::optional<Value>& value, Parse parse,
                        const std::string& what, const std::string& help) {
  return app.add_option_function<std::string>(
      name,
      [=, &value](const std::string& text) {
        value = parse(text);
        if (!value) {
          throw CLI::ValidationError(name, "'" + text + "' is not " + what);
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
                    "a whole number from " + std::to_string(least) + " to " +
                        std::to_string(most),
                    help)
      ->type_name("N");
}

/// An option that takes one of these names, and stands for what they name.
template <class Value>
void choose_among(CLI::Option* option,
                  std::vector<std::pair<std::string, Value>> names) {
  // CLI::CheckedTransformer would also take the numbers behind the names.
  option->transform(CLI::Transformer(names).description(""))
      ->transform(CLI::IsMember(std::move(names)));
}

const CLI::Validator is_number(
    [](const std::string& text) {
      // CLI::Range lets "nan" through: it is neither below nor above. And
      // CLI11 reads "0x2", "1_0" and "1'0".
      return text.find_first_not_of("0123456789+-.eE") != std::string::npos
                 ? "'" + text + "' is not a number"
                 : std::string();
    },
    "");

/// The options beside the scene that say what is rendered.
void add_render_options(CLI::App& app, int most_bounces, Options& options) {
  add_whole(app, "--spp", options.samples_per_pixel, 1, 1'000'000'000,
            "Samples per pixel [scene's, or 64]");
  add_whole(app, "--max-bounces", options.max_bounces, 0, most_bounces,
            "Longest path, in bounces");
  add_whole(app, "--seed", options.seed, std::uint64_t{0},
            std::numeric_limits<std::uint64_t>::max(),
            "Another seed gives other noise [1]");
  add_whole(app, "--threads", options.threads, 0, 1024,
            "Threads; 0 takes as many as the machine has [0]");
  add_parsed(app, "--size", options.size, size_of,
             "a size like 128x128, each from 1 to 65536",
             "Columns x rows, like 128x128 [scene's]")
      ->type_name("WxH");
  choose_among<Sampling>(
      app.add_option("--sampling", options.sampling,
                     "How diffuse directions are drawn: cosine or uniform "
                     "[cosine]"),
      {{"cosine", Sampling::cosine}, {"uniform", Sampling::uniform}});
}

/// The options for .png, but for what only all of them together mean.
void add_tone_options(CLI::App& app, std::vector<ToneStep>& steps,
                      std::optional<float>& gamma, float& exposure) {
  choose_among<ToneStep>(
      app.add_option("--tone-map", steps,
                     "For .png, steps in order, like --tone-map clamp,gamma: "
                     "clamp, equalize, gamma, reinhard [equalize,gamma]")
          ->delimiter(',')
          ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
          ->allow_extra_args(false),
      {{"clamp", ToneStep::clamp},
       {"equalize", ToneStep::equalize},
       {"gamma", ToneStep::gamma},
       {"reinhard", ToneStep::reinhard}});
  app.add_option("--gamma", gamma,
                 "For .png: exponent of the gamma step, "
                 "which it adds where there is none [2.2]")
      ->check(is_number)
      ->check(CLI::Range(0.1, 10.0));
  app.add_option("--exposure", exposure,
                 "For .png, in stops: times 2^exposure before the steps [0]")
      ->check(is_number)
      ->check(CLI::Range(-40.0, 40.0));
}

}  // namespace

int wrong_usage(const std::string& program, const std::string& what) {
  std::fprintf(stderr, "%s: %s (%s --help lists the options)\n",
               program.c_str(), one_line(what).c_str(), program.c_str());
  return 2;
}

std::optional<int> parse_options(int argc, char** argv,
                                 const CommandLine& expected,
                                 Options& options) {
  const std::string& program = expected.program;
  CLI::App app(expected.description, program);
  app.allow_windows_style_options(false);  // /home/ana/box.toml is a file
  // An option that is given twice counts as it was given last.
  app.option_defaults()->multi_option_policy(
      CLI::MultiOptionPolicy::TakeLast);
  app.set_version_flag("--version",
                       program + " (Lightwalk) " + LIGHTWALK_VERSION +
                           (expected.way.empty() ? "" : ", ") + expected.way);
  app.add_option("scene", options.scene, "Scene file (.toml)")->required();
  app.add_option("-o,--output", options.outputs,
                 "Image to write: .exr or .pfm (linear radiance), .ppm (the "
                 "course's P3 with #MAX), .png (tone mapped); may be given "
                 "several times")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->check([](const std::string& path) {
        return is_image_ending(ending(path))
                   ? std::string()
                   : "'" + path + "' ends in none of .exr, .pfm, .ppm, .png";
      });
  app.add_option("--report", options.report,
                 "What was rendered and how fast, for programs (.json)")
      ->type_name("FILE")
      ->check([](const std::string& path) {
        return ending(path) == ".json" ? std::string()
                                       : "'" + path + "' is not a .json";
      });
  add_render_options(app, expected.most_bounces, options);
  CLI::Option* const pixel =
      add_parsed(app, "--pixel", options.pixel, pixel_of,
                 "a pixel like 120,80, from 0,0 on",
                 "Tell one path of the pixel at column X, row Y, vertex by "
                 "vertex; no image is written")
          ->type_name("X,Y");
  std::optional<std::uint32_t> sample;
  add_whole(app, "--sample", sample, 0u, 999'999'999u,
            "Which of the pixel's paths [0]")
      ->needs(pixel);
  std::vector<ToneStep> steps;
  std::optional<float> gamma;
  ToneMapping& mapping = options.tone_mapping;
  add_tone_options(app, steps, gamma, mapping.exposure);
  app.add_flag("-q,--quiet", options.quiet, "Say nothing but errors");
  app.footer(
      "Ctrl-C writes what was rendered so far; an old picture is kept until "
      "each pixel has a sample.\n"
      "Exit codes: 0 done, 1 could not, 2 wrong usage, 130 interrupted.");

  try {
    app.parse(argc, argv);
    if (options.outputs.empty() && !options.report && !options.pixel) {
      throw CLI::RequiredError("--output");
    }
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return wrong_usage(program, error.what());
  }
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
