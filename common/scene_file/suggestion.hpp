#pragma once

// What was typed, and what was meant: ", did you mean 'radius'?"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/scene_file/message_text.hpp"

namespace lightwalk {

/// A name as it is shown in messages.
inline std::string in_quotes(std::string_view name) {
  return '\'' + shortened(name, 60) + '\'';
}

/// "cosine, uniform".
template <class Names>
std::string listed(const Names& names) {
  std::string text;
  for (const auto& name : names) {
    if (!text.empty()) text += ", ";
    text += name;
  }
  return text;
}

/// "'cos' is none of cosine, uniform".
template <class Names>
std::string none_of(std::string_view word, const Names& names) {
  return in_quotes(word) + " is none of " + listed(names);
}

/// How many letters must be inserted, deleted, replaced or swapped with the
/// next to turn a into b: the optimal string alignment distance.
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1), above, above_that;
  for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    above_that = std::exchange(above, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t differs = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] =
          std::min({above[j - 1] + differs, above[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], above_that[j - 2] + 1);
      }
    }
  }
  return row.back();
}

/// Whether the two are words for one thing. In scene files people use words
/// of other programs and of the command line.
inline bool are_synonyms(std::string_view a, std::string_view b) {
  constexpr std::string_view things[][5] = {
      {"samples_per_pixel", "spp", "samples"},
      {"max_bounces", "bounces", "max_depth", "depth"},
      {"size", "resolution", "width", "height"},
      {"origin", "center", "position"},
      {"kd", "diffuse", "albedo", "color"},
      {"ks", "specular"},
      {"ke", "emission"},
      {"eta", "ior"},
  };
  const auto plain = [](std::string_view word) {
    std::string text(
        word.substr(std::min(word.find_first_not_of('-'), word.size())));
    std::replace(text.begin(), text.end(), '-', '_');
    return text;
  };
  const auto names = [](const auto& thing, const std::string& word) {
    return std::find(std::begin(thing), std::end(thing), word) !=
           std::end(thing);
  };
  const std::string plain_a = plain(a), plain_b = plain(b);
  return std::any_of(std::begin(things), std::end(things),
                     [&](const auto& thing) {
                       return names(thing, plain_a) && names(thing, plain_b);
                     });
}

/// The name that means the same, or else the nearest; "" if none is near.
template <class Names>
std::string nearest(std::string_view word, const Names& names) {
  if (word.empty() || word.size() > 40) return "";
  std::string best;
  std::size_t fewest = std::max<std::size_t>(word.size() / 2, 1) + 1;
  for (const auto& name : names) {
    if (are_synonyms(word, name)) return std::string(name);
    const std::size_t edits = edit_distance(word, name);
    if (edits < fewest) {
      fewest = edits;
      best = name;
    }
  }
  return best;
}

/// ", did you mean 'x'?" for the name that `nearest` finds, if any.
template <class Names>
std::string suggestion(std::string_view word, const Names& names) {
  const std::string best = nearest(word, names);
  return best.empty() ? "" : ", did you mean " + in_quotes(best) + "?";
}

}  // namespace lightwalk
