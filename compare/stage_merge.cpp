// stage-merge PART... -o WHOLE: one picture of parts that have other samples.
//
// Exit codes: 0 done, 1 could not, 2 wrong usage.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "common/image/image_file.hpp"
#include "common/program/command_line.hpp"
#include "common/program/console.hpp"
#include "common/program/signals.hpp"
#include "common/scene_file/message_text.hpp"
#include "compare/merge.hpp"

int main(int argc, char** argv) {
  using namespace lightwalk;
  prepare_console();
  const std::string program = "stage-merge";
  const std::string example = "build/stage-merge a.pfm b.pfm -o whole.pfm";
  std::vector<std::string> names;
  std::string output;
  CLI::App app("Joins pictures of other samples of the same pixels", program);
  app.formatter(
      std::make_shared<HelpText>(example, "PART... -o WHOLE [OPTION]..."));
  app.allow_windows_style_options(false);
  app.add_option("PART", names, "Images (.pfm or .exr), in any order");
  app.add_option("-o,--output", output, "Image to write (.pfm or .exr)")
      ->type_name("WHOLE");
  add_help_and_version(app, LIGHTWALK_VERSION);
  app.footer(
      "Each part was rendered with its own --first-sample: of 128 samples\n"
      "`--spp 64` is the first half, and `--spp 64 --first-sample 64` the "
      "other.\nA sample that is in two parts or in none, and parts of other "
      "pictures, are\nerrors. Exit codes: 0 done, 1 could not, 2 wrong "
      "usage.");
  if (const auto code = parse(app, argc, argv)) {
    return checked_output(program, *code, 2);
  }
  if (names.empty() || output.empty()) {
    return wrong_usage(
        program, "parts and an output are required, as in '" + example + "'");
  }
  ignore_failing_writes();
  try {
    std::vector<Part> parts;
    for (const std::string& name : names) {
      try {
        parts.push_back({name, read_image(name)});
      } catch (const std::exception& error) {
        throw std::runtime_error(name + ": " + error.what());
      }
    }
    const RenderResult whole = merged(std::move(parts));
    write_image(output, whole, {});
    std::printf("%s: %d x %d, %.0f samples per pixel\n",
                escaped(output).c_str(), whole.radiance.width,
                whole.radiance.height, whole.info.samples_per_pixel);
    return checked_output(program, 0, 1);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program.c_str(),
                 one_line(error.what()).c_str());
    return 1;
  }
}
