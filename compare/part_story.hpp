#pragma once

// # The story of the parts
//
// First the bounces, for a path goes wrong at one of them and all later ones
// are wrong with it; then what goes wrong with one lobe or one kind of light
// alone.

#include <algorithm>
#include <string>
#include <vector>

#include "compare/part_amount.hpp"

namespace lightwalk {

inline const Part* find_part(const std::vector<Part>& parts,
                             const std::string& name) {
  for (const Part& part : parts) {
    if (part.name == name) return &part;
  }
  return nullptr;
}

/// "0", "0 and 1", "0, 1 and 2".
inline std::string in_a_list(const std::vector<std::string>& words,
                          const char* last = " and ") {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += (i == 0 ? "" : i + 1 < words.size() ? ", " : last) + words[i];
  }
  return text;
}

inline std::string bounces_name(std::size_t bounces) {
  return "bounces-" + std::to_string(bounces);
}

/// The bound itself may be what is wrong: the pictures are right, each for
/// another bound. Empty if that is not so.
inline std::string bound_in_words(const std::vector<PartVerdict>& bounces,
                                  const std::vector<Part>& right,
                                  const PartsView& view) {
  const auto shifted = [&](int by) {
    int told = 0;
    for (std::size_t i = 0; i < bounces.size(); ++i) {
      const int other = static_cast<int>(i) + by;
      if (other < 0) continue;
      const Part* part =
          find_part(right, bounces_name(static_cast<std::size_t>(other)));
      if (!part) continue;
      if (!same_parts(bounces[i].test, *part, view.columns)) return false;
      told += bounces[i].wrong ? 1 : 0;
    }
    return told >= 2;
  };
  if (shifted(1)) {
    return "With max_bounces N the picture is the right one of N + 1: the "
           "bound is off by one.";
  }
  if (shifted(-1)) {
    return "With max_bounces N the picture is the right one of N - 1: the "
           "bound is off by one.";
  }
  const Part* all = find_part(right, "all");
  int equal = 0;
  for (const PartVerdict& one : bounces) {
    if (!all || !same_parts(one.test, *all, view.columns)) return "";
    equal += one.wrong ? 1 : 0;
  }
  return equal < 2
             ? ""
             : "With any max_bounces the picture is the right one of no "
               "bound: max_bounces changes nothing.";
}

/// Whether a part is black.
inline bool no_light(const std::vector<Part>& parts,
                     const std::string& name) {
  const Part* part = find_part(parts, name);
  return part && std::all_of(part->mean.begin(), part->mean.end(),
                             [](double x) { return x == 0; });
}

/// What the pictures with 0, 1, 2, ... bounces say.
inline std::string bounces_in_words(const std::vector<PartVerdict>& bounces,
                                    const std::vector<Part>& right,
                                    const PartsView& view) {
  if (bounces.empty()) return "";
  const std::string bound = bound_in_words(bounces, right, view);
  if (!bound.empty()) return bound;
  std::vector<std::string> good;
  for (std::size_t i = 0; i < bounces.size(); ++i) {
    const PartVerdict& one = bounces[i];
    const std::string number = std::to_string(i);
    if (!one.wrong) {
      if (one.right) good.push_back(number);
      continue;
    }
    const Part* part = find_part(right, one.name);
    const Part* before =
        good.empty() ? nullptr : find_part(right, "bounces-" + good.back());
    const bool surely_first =
        i == 0 || (i == 1 && no_light(right, "bounces-0")) ||
        (before && good.back() == std::to_string(i - 1));
    const Place place = place_of(one, *part, view);
    std::string text =
        good.empty() ? "It is wrong with max_bounces " + number + " already"
        : surely_first
            ? "With max_bounces " + in_a_list(good) +
                  " it is right, and wrong from " + number + " on"
            : "With max_bounces " + in_a_list(good) +
                  " it is right, and wrong for sure with " + number;
    if (!place.words.empty()) text += ", " + place.words;
    const std::string amount =
        amount_in_words(one, *part, before, place, view);
    if (amount.empty()) return text + ".";
    text += i == 0          ? "; the light of the lamps themselves: "
            : !surely_first ? "; what is added: "
            : i == 1        ? "; the light of one bounce: "
                            : "; the light of " + number + " bounces: ";
    return text + amount + ".";
  }
  if (good.empty()) return "";
  return "With max_bounces " + in_a_list(good) + " it is right.";
}

/// What is wrong by itself and what is right. `what` is put behind each name.
inline std::string alone_in_words(const std::vector<PartVerdict>& parts) {
  std::vector<std::string> good, bad;
  for (const PartVerdict& one : parts) {
    if (one.wrong) {
      bad.push_back(one.name + " alone");
    } else if (one.right) {
      good.push_back(one.name + " alone");
    }
  }
  if (bad.empty() && good.size() < 2) return "";
  if (bad.empty()) return "With " + in_a_list(good) + " it is right.";
  return "With " + in_a_list(bad) + " it is wrong" +
         (good.empty() ? "." : ", with " + in_a_list(good) + " it is right.");
}

/// All that is sure, in two or three sentences; empty if nothing is. `right`
/// holds the parts and, as "all", the golden picture.
inline std::string tell_parts(const std::vector<PartVerdict>& verdicts,
                              const std::vector<Part>& right,
                              const PartsView& view) {
  std::vector<PartVerdict> bounces, lobes, lights;
  for (const PartVerdict& one : verdicts) {
    if (one.name.rfind("bounces-", 0) == 0) {
      bounces.push_back(one);
    } else if (one.name.size() == 2) {
      lobes.push_back(one);
    } else {
      lights.push_back(one);
    }
  }
  std::string text;
  for (const std::string& one :
       {bounces_in_words(bounces, right, view), alone_in_words(lobes),
        alone_in_words(lights)}) {
    if (!one.empty()) text += (text.empty() ? "" : " ") + one;
  }
  return text;
}

/// The names of the wrong ones, as a signature keeps them: "bounces-2,kd".
inline std::string wrong_parts(const std::vector<PartVerdict>& verdicts) {
  std::string text;
  for (const PartVerdict& one : verdicts) {
    if (one.wrong) text += (text.empty() ? "" : ",") + one.name;
  }
  return text.empty() ? "-" : text;
}

}  // namespace lightwalk
