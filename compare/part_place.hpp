#pragma once

// # Where, in words
//
// Only what is sure is said: "only where 'glass' is seen" if every tile that
// differs has some of it and the other tiles are right together.

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/factors.hpp"
#include "compare/parts.hpp"

namespace lightwalk {

/// Something in the picture, and what may be multiplied by mistake where it
/// is seen.
struct SeenThing {
  std::string name;         ///< "'glass'", "the sphere of 'white'"
  std::vector<int> pixels;  ///< of each tile
  std::vector<std::pair<std::string, std::array<double, 3>>> coefficients;
};

/// What the parts are seen against.
struct PartsView {
  std::size_t columns = 8;  ///< of tiles
  std::vector<int> pixels;  ///< of each tile
  std::vector<SeenThing> things;
  std::vector<NamedValue> factors;  ///< that have a name
};

/// Where light is wrong: words, and the tiles to measure it in.
struct Place {
  std::string words;  ///< empty if there is no simple answer
  Tiles tiles;
  bool pure = false;  ///< the tiles have nothing else
  std::optional<SeenThing> thing;
};

/// The tiles in which at least half is this thing.
inline Tiles tiles_of(const SeenThing& thing, const PartsView& view) {
  Tiles tiles;
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    if (2 * thing.pixels[i] >= view.pixels[i]) tiles.push_back(i);
  }
  return tiles;
}

/// Those of the tiles that have nothing else in them.
inline Tiles full_tiles(const SeenThing& thing, const Tiles& tiles,
                        const PartsView& view) {
  Tiles full;
  for (const std::size_t i : tiles) {
    if (thing.pixels[i] == view.pixels[i]) full.push_back(i);
  }
  return full;
}

/// The things, and what is one of two materials.
inline std::vector<SeenThing> things_and_pairs(const PartsView& view) {
  std::vector<SeenThing> all = view.things;
  for (const SeenThing& a : view.things) {
    for (const SeenThing& b : view.things) {
      if (a.name[0] != '\'' || b.name[0] != '\'' || a.name >= b.name)
        continue;
      SeenThing pair{a.name + " or " + b.name, a.pixels, {}};
      for (std::size_t i = 0; i < b.pixels.size(); ++i) {
        pair.pixels[i] += b.pixels[i];
      }
      all.push_back(pair);
    }
  }
  return all;
}

/// Whether the tiles that have nothing of the thing are right together.
inline bool rest_is_right(const PartVerdict& verdict, const Part& right,
                          const SeenThing& thing) {
  Tiles rest;
  for (std::size_t i = 0; i < verdict.tiles.size(); ++i) {
    if (thing.pixels[i] == 0) rest.push_back(i);
  }
  if (rest.size() < 3) return false;
  for (int channel = 0; channel < 3; ++channel) {
    const auto d = compare_tiles(verdict.test, right, rest, channel, 0.01, 0);
    if (!d.same({}) ||
        std::abs(d.test - d.reference) > 0.03 * d.reference + 4 * d.sigma) {
      return false;
    }
  }
  return true;
}

inline Place place_of(const PartVerdict& verdict, const Part& right,
                      const PartsView& view) {
  Place place;
  double bright = 0;
  for (const double one : right.mean) bright = std::max(bright, one);
  std::size_t wrong = 0, wrong_and_lit = 0;
  for (std::size_t i = 0; i < verdict.tiles.size(); ++i) {
    bool lit = false;
    for (int c = 0; c < 3; ++c) {
      lit = lit || verdict.test.mean_of(i, c) > 1e-3 * bright ||
            right.mean_of(i, c) > 1e-3 * bright;
    }
    if (lit) place.tiles.push_back(i);
    wrong += verdict.tiles[i] ? 1 : 0;
    wrong_and_lit += lit && verdict.tiles[i] ? 1 : 0;
  }
  if (10 * wrong_and_lit >= 9 * place.tiles.size()) {
    const bool whole = place.tiles.size() == verdict.tiles.size();
    place.words = whole ? "everywhere" : "wherever there is light";
    place.pure = true;
    return place;
  }
  std::size_t fewest = 7 * verdict.tiles.size() / 10;
  for (const SeenThing& thing : things_and_pairs(view)) {
    std::size_t seen = 0, missed = 0, full = 0, full_wrong = 0;
    for (std::size_t i = 0; i < verdict.tiles.size(); ++i) {
      const bool here = thing.pixels[i] > 0;
      seen += here ? 1 : 0;
      missed += verdict.tiles[i] && !here ? 1 : 0;
      if (2 * thing.pixels[i] < view.pixels[i]) continue;
      ++full;
      full_wrong += verdict.tiles[i] ? 1 : 0;
    }
    if (wrong < 3 || missed > 0 || seen >= fewest || 2 * full_wrong < full ||
        full == 0 || !rest_is_right(verdict, right, thing)) {
      continue;
    }
    fewest = seen;
    place.thing = thing;
  }
  if (!place.thing) return place;
  place.words = "only where " + place.thing->name + " is seen";
  const Tiles half = tiles_of(*place.thing, view);
  const Tiles full = full_tiles(*place.thing, half, view);
  place.pure = full.size() >= 3;
  place.tiles = place.pure ? full : half;
  return place;
}

}  // namespace lightwalk
