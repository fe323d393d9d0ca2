#pragma once

// Reads values from a TOML file. The error for a wrong value says which value
// it is, where it stands and what was expected in its place.

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "common/math/vector.hpp"
#include "common/scene_file/message_text.hpp"
#include "common/scene_file/suggestion.hpp"

namespace lightwalk {

/// What is wrong with a scene file, as one line that begins with the place:
/// `file:line:column: ...`.
struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

[[noreturn]] inline void fail_at(const toml::source_region& place,
                                 const std::string& message) {
  const std::string file = place.path ? *place.path : "scene";
  throw SceneError(file + ':' + std::to_string(place.begin.line) + ':' +
                   std::to_string(place.begin.column) + ": " +
                   one_line(shortened(message, 500)));
}

[[noreturn]] inline void fail_at(const toml::node& node,
                                 const std::string& message) {
  fail_at(node.source(), message);
}

/// More values than any scene has. So many take 2.5 GB: a value of two
/// characters takes 80 bytes.
inline constexpr std::size_t max_values = std::size_t{1} << 25;

/// Refuses texts that are too much for toml++, before toml++ reads them:
/// those of very many values, and those with keys of very many parts, such as
/// a.a.a. ... Each part is a table in a table, which toml++ leaves again by
/// recursion, and its own bound on nesting does not count these tables. No
/// key of a scene has more than three parts.
inline void check_extent(std::string_view text, const std::string& path,
                         std::size_t most = max_values) {
  std::size_t values = 0;
  constexpr int max_dots = 15;
  int dots = 0;            // since the last character outside of a key
  std::string_view quote;  // what ends the string that we are in
  toml::source_position place{1, 1};
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = text.substr(i);
    std::size_t length = 1;
    if (!quote.empty()) {
      if (rest.starts_with(quote)) {
        length = quote.size();
        // """a""""" ends in two quotes that belong to the string.
        while (length >= 3 && length < 5 && length < rest.size() &&
               rest[length] == quote[0]) {
          ++length;
        }
        quote = {};
      } else if (rest[0] == '\\' && quote[0] == '"') {
        length = std::min<std::size_t>(2, rest.size());
      } else if (rest[0] == '\n' && quote.size() == 1) {
        quote = {};  // a syntax error, which toml++ reports
      }
    } else if (rest[0] == '#') {
      length = std::min(rest.find('\n'), rest.size());
    } else if (rest[0] == '"' || rest[0] == '\'') {
      const bool triple =
          rest.starts_with("\"\"\"") || rest.starts_with("'''");
      length = triple ? 3 : 1;
      quote = rest.substr(0, length);
    } else if (rest[0] == '.') {
      if (++dots > max_dots) {
        fail_at({place, place, std::make_shared<const std::string>(path)},
                "a key of more than 16 parts");
      }
    } else if (std::string_view("=,[]{}\n").find(rest[0]) !=
               std::string_view::npos) {
      dots = 0;
      // One of these is before each value and each [table].
      if (std::string_view("=,[{").find(rest[0]) != std::string_view::npos &&
          ++values > most) {
        fail_at({place, place, std::make_shared<const std::string>(path)},
                "the file has more than " + std::to_string(most) + " values");
      }
    }
    for (const char c : rest.substr(0, length)) {
      if (c == '\n') {
        ++place.line;
        place.column = 1;
      } else if ((c & '\xc0') != '\x80') {
        ++place.column;
      }
    }
    i += length;
  }
}

/// The type of a TOML value, in words.
inline std::string kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

/// A number that a float can hold, with room for its square.
inline float read_number(const toml::node& node, const std::string& name) {
  if (!node.is_number()) {
    fail_at(node, name + " must be a number, not " + kind_of(node));
  }
  // An integer that no double holds exactly has no value<double>().
  const double value = node.is_integer()
                           ? static_cast<double>(*node.value<std::int64_t>())
                           : *node.value<double>();
  if (!std::isfinite(value)) fail_at(node, name + " must be finite");
  if (std::abs(value) > 1e12) {
    fail_at(node, name + " must lie between -1e12 and 1e12");
  }
  return static_cast<float>(value);
}

inline Vec3 read_vector(const toml::node& node, const std::string& name) {
  const toml::array* array = node.as_array();
  if (!array || array->size() != 3) {
    fail_at(node, name + " must be three numbers, like [0, 1, 0]" +
                      (array ? ", not " + std::to_string(array->size())
                             : ", not " + kind_of(node)));
  }
  Vec3 result;
  for (int i = 0; i < 3; ++i) {
    result[i] = read_number(*array->get(static_cast<std::size_t>(i)), name);
  }
  return result;
}

/// A gray as one number, or [red, green, blue]; nothing below 0.
inline Vec3 read_color(const toml::node& node, const std::string& name) {
  if (!node.is_number() && !node.is_array()) {
    fail_at(node, name + " must be a number or [red, green, blue], not " +
                      kind_of(node));
  }
  const Vec3 result = node.is_number() ? Vec3(read_number(node, name))
                                       : read_vector(node, name);
  if (std::min({result.x, result.y, result.z}) < 0) {
    fail_at(node, name + " must not be negative");
  }
  return result;
}

inline int read_integer(const toml::node& node, const std::string& name,
                        int least, int most) {
  // Only an integer: toml++ would cast 1e300 to one, to see if it fits.
  const toml::value<std::int64_t>* const value = node.as_integer();
  if (!value || value->get() < least || value->get() > most) {
    fail_at(node, name + " must be a whole number from " +
                      std::to_string(least) + " to " + std::to_string(most));
  }
  return static_cast<int>(value->get());
}

inline std::string read_string(const toml::node& node,
                               const std::string& name) {
  if (!node.is_string()) {
    fail_at(node, name + " must be a string, not " + kind_of(node));
  }
  return *node.value<std::string>();
}

inline bool read_boolean(const toml::node& node, const std::string& name) {
  if (!node.is_boolean()) {
    fail_at(node, name + " must be true or false, not " + kind_of(node));
  }
  return *node.value<bool>();
}

/// A table of known keys. Its constructor refuses all others.
class TomlTable {
 public:
  /// Messages call the table `name`, such as "material 'white'".
  TomlTable(const toml::node& node, std::string name,
            std::initializer_list<const char*> known)
      : name_(std::move(name)) {
    if (!node.is_table()) {
      fail_at(node, name_ + " must be a table, not " + kind_of(node));
    }
    table_ = node.as_table();
    for (const auto& [key, value] : *table_) {
      if (std::find(known.begin(), known.end(), key.str()) == known.end()) {
        fail_at(key.source(), "unknown key " + in_quotes(key.str()) + " in " +
                                  name_ + suggestion(key.str(), known));
      }
    }
  }

  const std::string& name() const { return name_; }
  const toml::table& table() const { return *table_; }

  /// The value of a key, or null if there is none.
  const toml::node* find(const char* key) const { return table_->get(key); }

  /// The value of a key that must be there. Throws a SceneError.
  const toml::node& at(const char* key) const {
    const toml::node* node = find(key);
    if (!node) fail_at(*table_, name_ + " needs '" + std::string(key) + "'");
    return *node;
  }

  std::string label(const char* key) const {
    return "'" + std::string(key) + "' of " + name_;
  }
  float number(const char* key) const {
    return read_number(at(key), label(key));
  }
  Vec3 vector(const char* key) const {
    return read_vector(at(key), label(key));
  }
  Vec3 color(const char* key) const {
    return read_color(at(key), label(key));
  }
  std::string string(const char* key) const {
    return read_string(at(key), label(key));
  }
  int integer(const char* key, int least, int most) const {
    return read_integer(at(key), label(key), least, most);
  }

 private:
  const toml::table* table_;
  std::string name_;
};

}  // namespace lightwalk
