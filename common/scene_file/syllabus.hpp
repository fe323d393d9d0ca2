#pragma once

// A scene may use what a later stage introduces. Then the program names it,
// instead of painting a wrong picture.

#include <optional>
#include <span>
#include <string_view>

namespace lightwalk {

/// A word of the scene format, and the stage that introduces what it means.
struct Introduction {
  std::string_view word;
  int stage;
};

/// What a program can render: everything up to its own stage.
struct Syllabus {
  int stage;
  std::span<const Introduction> introductions;

  /// The stage that introduces `word`, if it is a later one.
  std::optional<int> still_to_come(std::string_view word) const {
    for (const Introduction& introduction : introductions) {
      if (introduction.word == word && introduction.stage > stage) {
        return introduction.stage;
      }
    }
    return std::nullopt;
  }
};

}  // namespace lightwalk
