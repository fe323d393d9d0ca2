#pragma once

// What a student reads when tests fail: at most a screenful, and the most
// telling first. A test of one function says more than a scene with an exact
// answer, and that says more than two pictures that differ.

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace lightwalk::tests {

/// Kinds of tests, the sharpest first. Each is a test suite of doctest.
inline constexpr std::array<std::string_view, 4> kinds = {
    "units", "analytic scenes", "relations", "golden images"};

/// The place of a suite in `kinds`; tests in no suite are scenes.
inline int kind_of(std::string_view suite) {
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (suite == kinds[i]) return static_cast<int>(i);
  }
  return 1;
}

/// One failed test, with what its first failed check says.
struct FailedTest {
  std::string name, place, says;
  int kind = 1;
  int checks = 0;
};

/// The text in lines of at most 78 columns, each behind `indent`. What is
/// beyond `most` lines is left out.
inline std::string wrapped(const std::string& text, const std::string& indent,
                           int most) {
  std::vector<std::string> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string row;
    for (std::string word; words >> word;) {
      if (!row.empty() && indent.size() + row.size() + word.size() > 77) {
        rows.push_back(row);
        row.clear();
      }
      row += (row.empty() ? "" : " ") + word;
    }
    if (!row.empty()) rows.push_back(row);
  }
  std::string result;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool last = static_cast<int>(i) == most - 1 && i + 1 < rows.size();
    result += indent + rows[i] + (last ? " ..." : "") + '\n';
    if (last) break;
  }
  return result;
}

/// What has happened in a run so far.
class Report {
 public:
  void begin_test(const std::string& name, int kind) {
    end_test();
    current_ = {name, "", "", kind, 0};
    running_ = true;
  }
  /// A check failed. Only the first of a test is printed.
  void fail(const std::string& says, const std::string& place) {
    if (current_.checks++ > 0) return;
    current_.says = says;
    current_.place = place;
  }
  void note(const std::string& text) {
    if (std::find(notes_.begin(), notes_.end(), text) == notes_.end()) {
      notes_.push_back(text);
    }
  }
  void end_test() {
    if (current_.checks > 0) failures_.push_back(current_);
    current_ = {};
    running_ = false;
  }

  bool failed() const { return !failures_.empty() || current_.checks > 0; }
  bool running() const { return running_; }
  const std::string& current_test() const { return current_.name; }

  /// The end of a run of so many tests.
  std::string summary(unsigned tests, const std::string& program) {
    end_test();
    const std::size_t failed = failures_.size();
    std::string text = std::to_string(tests);
    if (failed == 0) {
      text += tests == 1 ? " test passes\n" : " tests pass\n";
    } else {
      text = std::to_string(failed) + " of " + text +
             (failed == 1 ? " tests fails:\n"
                          : " tests fail. Start with the first:\n");
    }
    return text + failures() + notes() + where(program);
  }

  /// The end of a run that did not come to its end, for this reason.
  std::string broken_off(const std::string& why, const std::string& program) {
    // What the test had said before is told below.
    end_test();
    std::string text = wrapped(why, "", 8);
    if (!failures_.empty()) {
      text += "Before that " + std::to_string(failures_.size()) +
              (failures_.size() == 1 ? " test" : " tests") + " had failed:\n";
    }
    return text + failures() + notes() + where(program);
  }

 private:
  static constexpr int first_lines = 9, golden_lines = 8, other_lines = 3;
  static constexpr std::size_t most_lines = 24, fewest_named = 3;

  static std::size_t lines_of(const std::string& text) {
    return static_cast<std::size_t>(
        std::count(text.begin(), text.end(), '\n'));
  }

  static std::string told(const FailedTest& one, int most) {
    std::string text = "\n  " + one.name + '\n';
    if (!one.place.empty()) text += "  (" + one.place + ")\n";
    text += wrapped(one.says, "    ", most);
    if (one.checks > 1) {
      text += "    (and " + std::to_string(one.checks - 1) +
              " more in this test)\n";
    }
    return text;
  }

  std::string failures() const {
    if (failures_.empty()) return "";
    std::vector<const FailedTest*> sorted;
    for (const FailedTest& one : failures_) sorted.push_back(&one);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const FailedTest* a, const FailedTest* b) {
                       return a->kind < b->kind;
                     });
    const auto golden = static_cast<int>(kinds.size()) - 1;
    std::string text = told(*sorted[0], failures_.size() == 1
                                            ? static_cast<int>(most_lines) - 4
                                            : first_lines);
    std::vector<const FailedTest*> rest;
    int kind = sorted[0]->kind;
    for (const FailedTest* one : sorted) {
      if (one == sorted[0]) continue;
      if (one->kind > kind) {
        kind = one->kind;
        text += told(*one, kind == golden ? golden_lines : other_lines);
      } else {
        rest.push_back(one);
      }
    }
    if (rest.empty()) return text;
    text += "\nand\n";
    const std::size_t used = lines_of(text) + 4;
    const std::size_t room = std::max(
        fewest_named, used < most_lines ? most_lines - used : std::size_t{0});
    for (std::size_t i = 0; i < std::min(room, rest.size()); ++i) {
      text += "  " + rest[i]->name + '\n';
    }
    if (rest.size() > room) {
      text += "  and " + std::to_string(rest.size() - room) + " more\n";
    }
    return text;
  }

  std::string notes() const {
    std::string text;
    for (const std::string& note : notes_) {
      text += wrapped("note: " + note, "", 2);
    }
    return text;
  }

  std::string where(const std::string& program) const {
    if (failures_.empty()) return "";
    return "\nAll that they say: " + program + '\n';
  }

  FailedTest current_;
  bool running_ = false;
  std::vector<FailedTest> failures_;
  std::vector<std::string> notes_;
};

// ## From one program to another
//
// A suite runs code that is not finished, which may end the program at any
// moment. So another program prints the report: run_suite, which reads lines
// of the suite's from a pipe. A line is what happened, and its fields:
//
//     begin <test> <kind>     fail <says> <place>     note <text>
//     end                     done <tests>

/// The environment variable with the pipe's number.
inline constexpr const char* pipe_variable = "LIGHTWALK_REPORT_PIPE";

inline std::string as_line(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) {
    if (!line.empty()) line += '\x1f';
    for (const char c : field) line += c == '\n' ? '\x1e' : c;
  }
  return line + '\n';
}

inline std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == '\x1f') {
      fields.emplace_back();
    } else {
      fields.back() += c == '\x1e' ? '\n' : c;
    }
  }
  return fields;
}

}  // namespace lightwalk::tests
