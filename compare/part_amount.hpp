#pragma once

// # By how much, in words
//
// A factor is told if all tiles agree on it, or all of one thing's. Where the
// tiles have other things in them too, only their sum is.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "compare/part_place.hpp"
#include "compare/verdict.hpp"

namespace lightwalk {

/// Whether the light is wrong by a coefficient of what is seen, such as its
/// kd: the name. All things must agree, and not all by the same number.
inline std::string coefficient_of(const Part& test, const Part& right,
                                  const Part* before, const Place& place,
                                  const PartsView& view) {
  std::set<std::string> possible, impossible;
  std::map<std::string, std::set<int>> values;
  for (const SeenThing& thing : view.things) {
    if (thing.coefficients.empty()) continue;
    if (place.thing && place.thing->name != thing.name) continue;
    const Tiles full = full_tiles(thing, place.tiles, view);
    if (full.size() < 2) continue;
    for (int c = 0; c < 3; ++c) {
      const Factor factor = factor_of(test, right, before, full, c);
      if (!(factor.sigma > 0) || !factor.known) continue;
      for (const auto& [name, value] : thing.coefficients) {
        const double v = value[static_cast<std::size_t>(c)];
        const bool agrees = v > 0 && is_value(factor, v);
        (agrees ? possible : impossible).insert(name);
        values[name].insert(static_cast<int>(std::lround(1000 * v)));
      }
    }
  }
  for (const std::string& name : possible) {
    if (!impossible.count(name) && values[name].size() >= 2) return name;
  }
  return "";
}

inline std::string as_figure(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

/// "in all channels", "in red and green for sure": the others may be wrong.
inline std::string channels_in_words(const std::array<bool, 3>& channels) {
  std::string text;
  int count = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (!channels[c]) continue;
    text += std::string(count++ ? " and " : "in ") + channel_names[c];
  }
  return count == 3 ? "in all channels" : text + " for sure";
}

/// "0.8 times where 'red' or 'white' is seen, 0.6 times where 'plastic' is
/// seen", if that is so wherever enough of one material is seen; or empty.
inline std::string factors_of_things(const PartVerdict& verdict,
                                     const Part& right, const Part* before,
                                     const Place& place,
                                     const PartsView& view) {
  std::vector<std::pair<Factor, std::string>> groups;
  for (const SeenThing& thing : view.things) {
    if (thing.name[0] != '\'') continue;
    const Tiles full = full_tiles(thing, place.tiles, view);
    if (full.size() < 3) continue;
    std::array<Factor, 3> factors;
    for (int c = 0; c < 3; ++c) {
      const auto i = static_cast<std::size_t>(c);
      if (!verdict.channels[i]) continue;
      factors[i] = factor_of(verdict.test, right, before, full, c);
    }
    const auto factor = common_factor(factors);
    if (!factor) return "";
    bool found = false;
    for (auto& [other, names] : groups) {
      if (found || std::abs(other.ratio - factor->ratio) >
                       3 * (other.sigma + factor->sigma) + 0.01) {
        continue;
      }
      names += " or " + thing.name;
      found = true;
    }
    if (!found) groups.emplace_back(*factor, thing.name);
  }
  std::string text;
  for (const auto& [factor, names] : groups) {
    const bool same = std::abs(factor.ratio - 1) < 3 * factor.sigma + 0.01;
    text += (text.empty() ? "it is " : ", ") +
            (same ? "right"
                  : as_figure(factor.ratio) + " times what it should be") +
            " where " + names + " is seen";
  }
  return groups.size() > 3 ? "" : text;
}

/// "0.318 times as much as it should be, in all channels (1/pi is 0.318)".
inline std::string amount_in_words(const PartVerdict& verdict,
                                   const Part& right, const Part* before,
                                   const Place& place,
                                   const PartsView& view) {
  std::array<Factor, 3> factors;
  std::array<bool, 3> channels{};
  double test = 0, reference = 0;
  bool some_varies = false;
  double least = 1e30, most = 0;
  for (int c = 0; c < 3; ++c) {
    const auto i = static_cast<std::size_t>(c);
    for (const std::size_t tile : place.tiles) {
      const double b = before ? before->mean_of(tile, c) : 0;
      test += verdict.test.mean_of(tile, c) - b;
      reference += right.mean_of(tile, c) - b;
    }
    if (!verdict.channels[i]) continue;
    channels[i] = true;
    factors[i] = factor_of(verdict.test, right, before, place.tiles, c);
    some_varies = some_varies || factors[i].varies;
    if (factors[i].varies) {
      least = std::min(least, factors[i].least);
      most = std::max(most, factors[i].most);
    }
  }
  const std::string where = channels_in_words(channels);
  if (!(reference > 0)) return test > 0 ? "there should be none" : "";
  const bool missing =
      std::all_of(factors.begin(), factors.end(), [](const Factor& one) {
        return !(one.sigma > 0) ||
               std::abs(one.ratio) < std::min(0.05, 4 * one.sigma + 0.002);
      });
  if (missing) return "it is missing, " + where;
  const std::string coefficient =
      coefficient_of(verdict.test, right, before, place, view);
  if (!coefficient.empty()) {
    const bool inverse = coefficient.rfind("1/", 0) == 0;
    return inverse ? "the factor " + coefficient.substr(2) +
                         " of what is seen is missing"
                   : "it has the factor " + coefficient +
                         " of what is seen once too often";
  }
  if (const auto factor = common_factor(factors)) {
    std::vector<NamedValue> values = view.factors;
    if (place.thing) {
      for (const auto& [name, value] : place.thing->coefficients) {
        if (value[0] == value[1] && value[1] == value[2]) {
          values.push_back({value[0], name});
        }
      }
    }
    const std::string name = name_of(*factor, values);
    return "it is " + as_figure(factor->ratio) +
           " times what it should be, " + where +
           (name.empty() ? "" : " (that is " + name + ")");
  }
  if (!place.pure) {
    if (std::abs(test / reference - 1) < 0.03) return "";
    return "in all tiles together it is " + amount_of(test, reference) +
           ", " + where;
  }
  const bool each =
      std::all_of(factors.begin(), factors.end(), [](const Factor& one) {
        return !(one.sigma > 0) || (one.uniform && one.known);
      });
  if (each) {
    std::string text;
    for (std::size_t c = 0; c < 3; ++c) {
      if (!(factors[c].sigma > 0)) continue;
      text += (text.empty() ? "it is " : ", ") + as_figure(factors[c].ratio) +
              " times in " + channel_names[c];
    }
    return text + " what it should be";
  }
  const std::string things =
      factors_of_things(verdict, right, before, place, view);
  if (!things.empty()) return things + ", " + where;
  if (some_varies) {
    return "it is " + as_figure(std::max(0.0, least)) + " to " +
           as_figure(most) +
           " times what it should be, so by no constant factor, " + where;
  }
  return "it is " + amount_of(test, reference) + ", " + where;
}

}  // namespace lightwalk
