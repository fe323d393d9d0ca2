#pragma once

// What the command lines of all programs have in common, with CLI11: --help,
// and the messages about wrong usage.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "common/image/image_file.hpp"
#include "common/scene_file/message_text.hpp"
#include "common/scene_file/suggestion.hpp"

namespace lightwalk {

/// Prints to stderr what is wrong with the command line; returns exit code 2.
inline int wrong_usage(const std::string& program, const std::string& what) {
  std::fprintf(stderr, "%s: %s (%s --help lists the options)\n",
               program.c_str(), one_line(what).c_str(), program.c_str());
  return 2;
}

/// A text in lines that are no longer than `width`, if its words allow that.
inline std::vector<std::string> in_lines(const std::string& text,
                                         std::size_t width) {
  std::vector<std::string> lines{""};
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    std::string& line = lines.back();
    if (line.empty()) {
      line = word;
    } else if (line.size() + 1 + word.size() <= width) {
      line += ' ' + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

/// What --help prints: an example, and a table of the options with their
/// defaults.
class HelpText final : public CLI::FormatterBase {
 public:
  /// `usage` is what follows the program's name.
  HelpText(std::string example, std::string usage)
      : example_(std::move(example)), usage_(std::move(usage)) {}

  std::string make_help(const CLI::App* app, std::string,
                        CLI::AppFormatMode) const override {
    std::string text = "Example: " + example_ +
                       "\nUsage: " + app->get_name() + ' ' + usage_ + "\n\n" +
                       app->get_description() + "\n\n";
    const auto options = app->get_options();
    std::size_t name_width = 0, default_width = 0;
    for (const CLI::Option* option : options) {
      const std::string& given = option->get_default_str();
      name_width = std::max(name_width, title_of(*option).size() + 2);
      if (given.empty()) continue;
      default_width =
          std::max({default_width, given.size() + 2, default_title.size()});
    }
    const auto row = [&](std::string name, std::string given,
                         const std::string& meaning) {
      name.resize(name_width, ' ');
      given.resize(default_width, ' ');
      std::string start = "  " + name + given;
      for (const auto& line : in_lines(meaning, columns - start.size())) {
        text += start + line;
        text.erase(text.find_last_not_of(' ') + 1);
        text += '\n';
        start.assign(start.size(), ' ');
      }
    };
    if (default_width > 0) row("", std::string(default_title), "");
    for (const CLI::Option* option : options) {
      row(title_of(*option), option->get_default_str(),
          option->get_description());
    }
    text += '\n';
    for (const std::string& line : in_lines(app->get_footer(), columns)) {
      text += line + '\n';
    }
    return text;
  }

 private:
  static constexpr std::size_t columns = 80;
  static constexpr std::string_view default_title = "default";

  /// "-o, --output FILE".
  static std::string title_of(const CLI::Option& option) {
    if (option.get_positional()) return option.get_name(true);
    std::string text;
    for (const std::string& name : option.get_snames()) {
      text += '-' + name + ", ";
    }
    text += "--" + option.get_lnames().front();
    const bool is_flag = option.get_type_size() == 0;
    return is_flag ? text : text + ' ' + option.get_type_name();
  }

  std::string example_, usage_;
};

/// The options that every program has. They come last.
inline void add_help_and_version(CLI::App& app, const std::string& version) {
  app.set_version_flag("-V,--version",
                       app.get_name() + " (Lightwalk) " + version,
                       "Print the version");
  app.set_help_flag("-h,--help", "Print this help");
}

/// Checks that `what`, such as "images", have names with one of the endings.
template <class Endings>
auto named_with(const std::string& what, const Endings& endings) {
  return [=](const std::string& path) {
    if (path == "-") {
      return "'-' is no name: " + what + " are written by name, like box" +
             std::string(endings.back());
    }
    if (std::count(endings.begin(), endings.end(), ending(path)) > 0) {
      return std::string();
    }
    return in_quotes(path) +
           (endings.size() == 1 ? " does not end in " : " ends in none of ") +
           listed(endings);
  };
}

/// What is wrong with a command line that CLI11 refuses. An unknown option
/// comes first: the program may have taken what follows it for something
/// else.
inline std::string what_is_wrong(const CLI::App& app,
                                 const CLI::ParseError& error) {
  const std::string text = error.what();
  const std::vector<std::string> unused = app.remaining();
  std::vector<std::string> known, positional;
  std::string about;  // the option that CLI11 names
  for (const CLI::Option* option : app.get_options()) {
    for (const auto& name : option->get_lnames()) {
      known.push_back("--" + name);
      if (text.find(known.back()) != std::string::npos) about = known.back();
    }
    if (!option->get_positional()) continue;
    for (const auto& word : option->results()) positional.push_back(word);
  }
  for (const std::string& word : unused) {
    if (word == "--") break;
    if (word.size() < 2 || word[0] != '-') continue;
    const std::string name = word.substr(0, word.find('='));
    return "unknown option " + in_quotes(name) + suggestion(name, known);
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) {
    return about + " needs a value";
  }
  if (dynamic_cast<const CLI::ConversionError*>(&error)) {
    return about + " takes no value";
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
    const auto extra = unused.begin() + (unused.front() == "--" ? 1 : 0);
    return "argument " + in_quotes(*extra) + " was not expected" +
           (positional.empty() ? ""
                               : " after " + in_quotes(positional.back()));
  }
  return text;
}

/// Reads the command line. Returns the exit code if it is wrong, or if all
/// has been said, as after --help.
inline std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return wrong_usage(app.get_name(), what_is_wrong(app, error));
  }
  return std::nullopt;
}

}  // namespace lightwalk
