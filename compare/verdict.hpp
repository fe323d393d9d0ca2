#pragma once

// # What differs, in words and in a picture
//
// A failed comparison is useful if it says where and by how much. The
// differing tiles are grouped by what is seen in them, and the sentence names
// the thing that has most of the difference.

#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "compare/comparison.hpp"

namespace lightwalk {

/// What is seen in a region, such as "the sphere of 'glass'"; empty if that
/// is not known.
using NameRegion = std::function<std::string(const Region&)>;

/// "columns 8 to 15, rows 0 to 7 (upper left)".
inline std::string place_of(const Region& r, int width, int height) {
  const double x = (r.left + r.width / 2.0) / width;
  const double y = (r.top + r.height / 2.0) / height;
  const char* vertical = y < 1 / 3.0 ? "upper" : y > 2 / 3.0 ? "lower" : "";
  const char* horizontal = x < 1 / 3.0 ? "left" : x > 2 / 3.0 ? "right" : "";
  std::string where = vertical;
  if (*vertical && *horizontal) where += ' ';
  where += horizontal;
  if (where.empty()) where = "middle";
  return "columns " + std::to_string(r.left) + " to " +
         std::to_string(r.left + r.width - 1) + ", rows " +
         std::to_string(r.top) + " to " +
         std::to_string(r.top + r.height - 1) + " (" + where + ")";
}

/// "4.1 % too dark"; beyond twice as much "2.31 times too bright".
inline std::string amount_of(double test, double reference) {
  char text[64];
  const double ratio = test / reference;
  if (!(reference > 0)) return "light where it should be black";
  if (ratio < 0.005) return "all but black";
  if (ratio > 2) {
    std::snprintf(text, sizeof text, "%.3g times too bright", ratio);
  } else {
    std::snprintf(text, sizeof text, "%.2g %% too %s",
                  100 * std::abs(ratio - 1), ratio < 1 ? "dark" : "bright");
  }
  return text;
}

/// The region with the largest z, except one that is left out; null if there
/// is no other.
inline const RegionDifference* worst_of(
    const std::vector<RegionDifference>& differing,
    const Region& left_out = {}) {
  const RegionDifference* worst = nullptr;
  for (const RegionDifference& one : differing) {
    if (one.region == left_out) continue;
    if (!worst || !(one.z <= worst->z)) worst = &one;
  }
  return worst;
}

/// The named thing with the largest share of the tiles' differences.
struct Culprit {
  std::string name;
  double share = 0;  ///< 0 to 1
  double test = 0, reference = 0;
};

inline Culprit culprit_of(const std::vector<RegionDifference>& all,
                          const Bands& bands, const NameRegion& name_region) {
  int smallest = 1 << 30;
  for (const RegionDifference& one : all) {
    smallest = std::min(smallest, one.region.width * one.region.height);
  }
  std::map<std::string, Culprit> things;
  double total = 0;
  for (const RegionDifference& one : all) {
    const bool tile = one.region.width * one.region.height == smallest;
    if (!tile || one.same(bands)) continue;
    Culprit& thing = things[name_region(one.region)];
    const double size = std::abs(one.test - one.reference);
    thing.share += size;
    thing.test += one.test;
    thing.reference += one.reference;
    total += size;
  }
  Culprit largest;
  for (const auto& [name, thing] : things) {
    if (thing.share <= largest.share) continue;
    largest = thing;
    largest.name = name;
  }
  if (total > 0) largest.share /= total;
  return largest;
}

/// One sentence: by how much the image is off, and where most of it is.
inline std::string describe(const std::vector<RegionDifference>& all,
                            const std::vector<RegionDifference>& differing,
                            const Bands& bands, int width, int height,
                            const NameRegion& name_region) {
  double test = 0, reference = 0;
  for (int channel = 0; channel < 3; ++channel) {
    test += all[static_cast<std::size_t>(channel)].test;
    reference += all[static_cast<std::size_t>(channel)].reference;
  }
  const Region image = all[0].region;
  const RegionDifference* tile = worst_of(differing, image);
  std::string text = amount_of(test, reference) + " over the whole image";
  if (std::abs(test / reference - 1) < bands.image) {
    text = "right in the mean over the whole image";
  }
  if (!tile) return text + ", and no tile differs by itself";
  const Culprit culprit = culprit_of(all, bands, name_region);
  if (!culprit.name.empty() && culprit.share > 0.4) {
    const char* how = culprit.share > 0.9   ? "all of it"
                      : culprit.share > 0.6 ? "most of it"
                                            : "much of it";
    text += ", " + std::string(how) + " on " + culprit.name + ", " +
            amount_of(culprit.test, culprit.reference) + " there";
  }
  return text + "; worst at " + place_of(tile->region, width, height) + ": " +
         amount_of(tile->test, tile->reference) + " in " +
         channel_names[static_cast<std::size_t>(tile->channel)];
}

/// "the same: a tile that is 9 % off would have been seen (8 x 8 pixels)":
/// 49 times in 50, even in the noisiest tile that is not black.
inline std::string same_as_far_as_seen(
    const std::vector<RegionDifference>& all, const Bands& bands, int size) {
  double largest = 0;
  for (std::size_t i = 0; i < all.size(); i += 3) {
    const Region& r = all[i].region;
    double least = infinity;  // it shows best in one of the channels
    for (std::size_t c = 0; c < 3; ++c) {
      const RegionDifference& one = all[i + c];
      if (one.reference <= 0.01 * all[c].reference) continue;
      const double noise = (bands.z_critical + 2) * one.sigma;
      least = std::min(least, bands.tile + noise / one.reference);
    }
    const bool counts = r.width == size && r.height == size;
    if (counts && least < infinity) largest = std::max(largest, least);
  }
  if (largest == 0) return "the same";
  const std::string side = std::to_string(size);
  return "the same: a tile that is " +
         std::to_string(std::lround(std::ceil(100 * largest))) +
         " % off would have been seen (" + side + " x " + side + " pixels)";
}

/// Four pictures in a row: test, reference, the signed difference (red where
/// the test is brighter, blue where it is darker), and the z of each pixel.
/// Small images are enlarged so that their pixels can be seen.
inline Image difference_picture(const RenderResult& test,
                                const RenderResult& reference) {
  const int width = reference.radiance.width;
  const int height = reference.radiance.height;
  const int zoom = std::max(1, 256 / std::max(width, height));
  const int gap = 4;
  Image picture(4 * width * zoom + 3 * gap, height * zoom);
  for (Vec3& pixel : picture.pixels) pixel = Vec3(0.5f);
  // One exposure for both: white is where 98 % of the reference is darker.
  std::vector<float> values;
  for (const Vec3& pixel : reference.radiance.pixels) {
    values.push_back(max_component(pixel));
  }
  std::sort(values.begin(), values.end());
  const float white = std::max(1e-20f, values[values.size() * 98 / 100]);
  const auto displayed = [&](const Vec3& radiance) {
    const Vec3 scaled = glm::clamp(radiance / white, 0.0f, 1.0f);
    return Vec3(std::pow(scaled.x, 1 / 2.2f), std::pow(scaled.y, 1 / 2.2f),
                std::pow(scaled.z, 1 / 2.2f));
  };
  const auto signed_color = [](float x) {  // -1 blue, 0 white, 1 red
    const float strength = std::min(1.0f, std::abs(x));
    return x > 0 ? Vec3(1, 1 - strength, 1 - strength)
                 : Vec3(1 - strength, 1 - strength, 1);
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Vec3& a = test.radiance.at(x, y);
      const Vec3& b = reference.radiance.at(x, y);
      const float mean_difference = (a.x + a.y + a.z - b.x - b.y - b.z) / 3;
      const Vec3 va = test.variance.at(x, y),
                 vb = reference.variance.at(x, y);
      const float sigma =
          std::sqrt((va.x + va.y + va.z) / 9 /
                        static_cast<float>(test.info.samples_per_pixel) +
                    (vb.x + vb.y + vb.z) / 9 /
                        static_cast<float>(reference.info.samples_per_pixel));
      const Vec3 panels[4] = {
          displayed(a), displayed(b),
          signed_color(3 * mean_difference / white),
          signed_color(sigma > 0 ? mean_difference / sigma / 6 : 0)};
      for (int panel = 0; panel < 4; ++panel) {
        for (int i = 0; i < zoom * zoom; ++i) {
          picture.at(panel * (width * zoom + gap) + x * zoom + i % zoom,
                     y * zoom + i / zoom) = panels[panel];
        }
      }
    }
  }
  return picture;
}

}  // namespace lightwalk
