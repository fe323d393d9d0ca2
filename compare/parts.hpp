#pragma once

// # Which part of a picture is wrong?
//
// Who looks for an error renders simpler pictures: with one bounce, with the
// mirrors alone. Here that is done for him. Of each golden picture some parts
// are stored, rendered by the right stage; when the picture fails, the same
// parts are rendered by the failing one and compared.
//
// A part is stored as the means of its 4x4-pixel tiles. It is wrong where a
// tile, a block of 2x2 tiles or the image differs beyond noise and band, as
// in the comparison of pictures, in two renders with different seeds and to
// the same side. It is called right only if an error of a tenth of the light
// that it adds would have been seen; what is neither is not spoken of.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "compare/comparison.hpp"
#include "compare/diagnosis.hpp"

namespace lightwalk {

/// One part of a picture: its tiles, row by row, in three channels each.
struct Part {
  std::string name;    ///< "bounces-2", "kd"
  double samples = 0;  ///< per pixel
  std::vector<double> mean;
  std::vector<double> variance;  ///< of the mean

  std::size_t tile_count() const { return mean.size() / 3; }
  double mean_of(std::size_t tile, int channel) const {
    return mean[3 * tile + static_cast<std::size_t>(channel)];
  }
  double variance_of(std::size_t tile, int channel) const {
    return variance[3 * tile + static_cast<std::size_t>(channel)];
  }
};

inline Part part_of(const RenderResult& result, const std::string& name) {
  Signature tiles = signature_of(result, name);
  return {name, result.info.samples_per_pixel, std::move(tiles.mean),
          std::move(tiles.variance)};
}

/// One picture of two renders with as many samples each, or of one that is
/// given twice.
inline Part joined(const Part& a, const Part& b) {
  if (&a == &b || a.mean == b.mean) return a;
  Part result = a;
  result.samples += b.samples;
  for (std::size_t i = 0; i < a.mean.size(); ++i) {
    result.mean[i] = (a.mean[i] + b.mean[i]) / 2;
    result.variance[i] = (a.variance[i] + b.variance[i]) / 4;
  }
  return result;
}

// ## Files
//
// A file for each golden: the fingerprint of its scene, and a line for each
// part: its name, the samples, and mean and variance of each tile and
// channel.

inline std::string part_line(const Part& part) {
  char number[64];
  std::snprintf(number, sizeof number, " %.0f", part.samples);
  std::string line = part.name + number;
  for (std::size_t i = 0; i < part.mean.size(); ++i) {
    std::snprintf(number, sizeof number, " %.4g %.2g", part.mean[i],
                  part.variance[i]);
    line += number;
  }
  return line;
}

/// Those of this version of the scene; none where there is no file.
inline std::vector<Part> load_parts(const std::string& path,
                                    const std::string& scene_sha256) {
  std::vector<Part> parts;
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || line != scene_sha256) return parts;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    Part part;
    words >> part.name >> part.samples;
    for (double mean, variance; words >> mean >> variance;) {
      part.mean.push_back(mean);
      part.variance.push_back(variance);
    }
    if (!part.mean.empty()) parts.push_back(std::move(part));
  }
  return parts;
}

// ## Differences

using Tiles = std::vector<std::size_t>;

/// Compares the mean over some tiles in one channel. What is rounded in a
/// stored part is no difference.
inline RegionDifference compare_tiles(const Part& test, const Part& right,
                                      const Tiles& tiles, int channel,
                                      double share, double floor) {
  RegionDifference d;
  d.channel = channel;
  double variance = 0;
  for (const std::size_t tile : tiles) {
    d.test += test.mean_of(tile, channel);
    d.reference += right.mean_of(tile, channel);
    const double a = test.variance_of(tile, channel) * test.samples;
    const double b = right.variance_of(tile, channel) * right.samples;
    variance += std::max(a, b) / test.samples + b / right.samples;
  }
  const auto count = static_cast<double>(tiles.size());
  d.test /= count;
  d.reference /= count;
  d.sigma = std::sqrt(variance) / count;
  const double excess =
      std::abs(d.test - d.reference) - share * std::abs(d.reference) - floor;
  d.z = excess <= 0 ? 0 : excess / d.sigma;
  return d;
}

/// The image, blocks of 2x2 tiles, and every tile.
inline std::vector<Tiles> groups_of(std::size_t count, std::size_t columns) {
  std::vector<Tiles> groups(1);
  for (std::size_t i = 0; i < count; ++i) groups[0].push_back(i);
  const std::size_t rows = count / columns;
  for (std::size_t y = 0; y < rows; y += 2) {
    for (std::size_t x = 0; x < columns; x += 2) {
      Tiles block;
      for (std::size_t v = y; v < std::min(y + 2, rows); ++v) {
        for (std::size_t u = x; u < std::min(x + 2, columns); ++u) {
          block.push_back(v * columns + u);
        }
      }
      groups.push_back(block);
    }
  }
  for (std::size_t i = 0; i < count; ++i) groups.push_back({i});
  return groups;
}

/// Every group in every channel.
inline std::vector<RegionDifference> compare_parts(const Part& test,
                                                   const Part& right,
                                                   std::size_t columns,
                                                   const Bands& bands = {}) {
  std::vector<RegionDifference> all;
  double whole[3] = {};
  for (std::size_t i = 0; i < right.mean.size(); ++i) {
    whole[i % 3] += right.mean[i] / static_cast<double>(right.tile_count());
  }
  for (const Tiles& tiles : groups_of(right.tile_count(), columns)) {
    const double share = all.size() < 3 ? bands.image : bands.tile;
    for (int channel = 0; channel < 3; ++channel) {
      all.push_back(compare_tiles(test, right, tiles, channel, share,
                                  bands.floor * whole[channel]));
    }
  }
  return all;
}

inline bool same_parts(const Part& test, const Part& right,
                       std::size_t columns) {
  const auto all = compare_parts(test, right, columns);
  return std::all_of(all.begin(), all.end(), [](const RegionDifference& one) {
    return one.same({});
  });
}

/// What has become of one part.
struct PartVerdict {
  std::string name;
  bool wrong = false;              ///< for sure
  bool right = false;              ///< for sure, and there is light in it
  std::vector<bool> tiles;         ///< which of them differ
  std::array<bool, 3> channels{};  ///< in which of them
  Part test;                       ///< all that was rendered of it
};

/// Whether the light that a part adds to the one before it, over some tiles
/// and all channels, is known to a tenth and right to that. No light at all
/// is neither.
inline bool surely_right(const Part& test, const Part& right,
                         const Part* before, const Tiles& tiles) {
  double added = 0, difference = 0, sigma = 0;
  for (const std::size_t tile : tiles) {
    double deviation = 0;
    for (int c = 0; c < 3; ++c) {
      const double b = before ? before->mean_of(tile, c) : 0;
      added += right.mean_of(tile, c) - b;
      difference += test.mean_of(tile, c) - right.mean_of(tile, c);
      deviation +=
          std::sqrt(test.variance_of(tile, c) + right.variance_of(tile, c));
    }
    sigma += deviation * deviation;  // channels are noisy together
  }
  return added > 0 &&
         std::abs(difference) + 3 * std::sqrt(sigma) < 0.1 * added;
}

/// The same for the image and for each of the things in it, but for those in
/// which hardly any light is added.
inline bool surely_right(const Part& test, const Part& right,
                         const Part* before,
                         const std::vector<Tiles>& things) {
  Tiles image;
  const auto added = [&](const Tiles& tiles) {
    double sum = 0;
    for (const std::size_t tile : tiles) {
      for (int c = 0; c < 3; ++c) {
        sum +=
            right.mean_of(tile, c) - (before ? before->mean_of(tile, c) : 0);
      }
    }
    return sum;
  };
  for (std::size_t i = 0; i < right.tile_count(); ++i) image.push_back(i);
  return surely_right(test, right, before, image) &&
         std::all_of(things.begin(), things.end(), [&](const Tiles& thing) {
           return thing.empty() || added(thing) < 2e-3 * added(image) ||
                  surely_right(test, right, before, thing);
         });
}

/// Two renders of a part against the right one. `before` is the right part
/// that this one adds light to, or null, and `things` the tiles of each thing
/// that is seen.
inline PartVerdict judge_part(const Part& first, const Part& second,
                              const Part& right, const Part* before,
                              const std::vector<Tiles>& things,
                              std::size_t columns) {
  PartVerdict verdict;
  verdict.name = right.name;
  verdict.test = joined(first, second);
  const auto a = compare_parts(first, right, columns);
  const auto b = compare_parts(second, right, columns);
  const auto both = compare_parts(verdict.test, right, columns);
  const std::size_t tiles = right.tile_count();
  verdict.tiles.assign(tiles, false);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].same({}) || b[i].same({}) || a[i].sign() != b[i].sign())
      continue;
    verdict.wrong = true;
    verdict.channels[i % 3] = true;
  }
  if (!verdict.wrong) {
    verdict.right = surely_right(verdict.test, right, before, things);
    return verdict;
  }
  for (std::size_t i = 0; i < 3 * tiles; ++i) {
    const RegionDifference& one = both[both.size() - 3 * tiles + i];
    if (!one.same({})) verdict.tiles[i / 3] = true;
  }
  return verdict;
}

}  // namespace lightwalk
