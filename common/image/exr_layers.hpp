#pragma once

// # Which of an EXR file's channels are the picture
//
// An EXR file holds any number of channels, in one or more parts. A layer is
// a name before the channel's: `R` belongs to the layer without a name, which
// every reader shows, and `variance.R` to the layer `variance`. Where the
// file has several parts, their names are the layers' names.
//
// The picture is the layer without a name. Files of other programs may have
// none: then it is the layer that is called like a picture, or the only one.
// A guess would show the albedo and call it light.

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace lightwalk {

/// A layer with colors, or with grey, where all three channels are one.
struct ExrLayer {
  std::string name;  ///< empty for the one without a name
  int part = 0;
  std::array<int, 3> channels{};  ///< of R, G, B: their places in the part
  bool grey = false;
};

/// One part of a file: its name, and its channels' full names.
struct ExrPart {
  std::string name;
  std::vector<std::string> channels;
};

namespace exr {

/// "ViewLayer.Combined" of "ViewLayer.Combined.R".
inline std::string layer_of(const std::string& channel) {
  const std::size_t dot = channel.rfind('.');
  return dot == std::string::npos ? "" : channel.substr(0, dot);
}

/// The place of a layer's channel in its part, or -1.
inline int place_of(const ExrPart& part, const std::string& layer,
                    const char* channel) {
  const std::string name = layer.empty() ? channel : layer + '.' + channel;
  const auto found =
      std::find(part.channels.begin(), part.channels.end(), name);
  return found == part.channels.end()
             ? -1
             : static_cast<int>(found - part.channels.begin());
}

/// Whether programs call the whole picture so, and not one part of its light.
inline bool is_picture_name(const std::string& layer) {
  std::string last = layer.substr(layer.rfind('.') + 1);
  for (char& c : last)
    c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
  constexpr const char* names[] = {"radiance", "combined", "composite",
                                   "beauty",   "rgba",     "rgb",
                                   "color",    "image",    "c"};
  return std::find(std::begin(names), std::end(names), last) !=
         std::end(names);
}

}  // namespace exr

/// The layers that hold R, G and B, or nothing but Y. X, Y, Z is a place or a
/// normal, and Y beside RY and BY is not all of the picture.
inline std::vector<ExrLayer> color_layers(const std::vector<ExrPart>& parts) {
  std::vector<ExrLayer> layers;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    std::vector<std::string> seen;
    for (const std::string& channel : parts[i].channels) {
      const std::string layer = exr::layer_of(channel);
      if (std::find(seen.begin(), seen.end(), layer) != seen.end()) continue;
      seen.push_back(layer);
      const auto place = [&](const char* name) {
        return exr::place_of(parts[i], layer, name);
      };
      ExrLayer found{layer, static_cast<int>(i), {}, false};
      if (parts.size() > 1 && layer.rfind(parts[i].name, 0) != 0) {
        found.name = parts[i].name + (layer.empty() ? "" : "." + layer);
      }
      found.channels = {place("R"), place("G"), place("B")};
      if (*std::min_element(found.channels.begin(), found.channels.end()) <
          0) {
        found.grey = place("Y") >= 0 && place("X") < 0 && place("Z") < 0 &&
                     place("RY") < 0 && place("BY") < 0;
        if (!found.grey) continue;
        found.channels.fill(place("Y"));
      }
      layers.push_back(found);
    }
  }
  return layers;
}

/// What is taken for the picture. `error` says why nothing is; `note` says
/// what was chosen where the file left a choice.
struct ExrChoice {
  ExrLayer picture;
  std::string error, note;
};

/// Names in a row, or the first few of them.
inline std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < 8; ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  return names.size() > 8 ? text + ", ..." : text;
}

inline ExrChoice choose_picture(const std::vector<ExrPart>& parts) {
  std::vector<ExrLayer> layers = color_layers(parts);
  std::erase_if(
      layers, [](const ExrLayer& layer) { return layer.name == "variance"; });
  if (layers.empty()) {
    std::vector<std::string> channels;
    for (const ExrPart& part : parts) {
      channels.insert(channels.end(), part.channels.begin(),
                      part.channels.end());
    }
    return {{},
            "it has no colors: its channels are " + listed(channels) +
                ", and R, G, B or Y are expected",
            ""};
  }
  // Colors before grey, and then the name decides.
  std::stable_partition(layers.begin(), layers.end(),
                        [](const ExrLayer& layer) { return !layer.grey; });
  for (const ExrLayer& layer : layers) {
    if (layer.name.empty()) return {layer, "", ""};
  }
  std::vector<std::string> names;
  for (const ExrLayer& layer : layers) names.push_back(layer.name);
  const auto found = std::find_if(
      layers.begin(), layers.end(),
      [](const ExrLayer& layer) { return exr::is_picture_name(layer.name); });
  if (found == layers.end() && layers.size() > 1) {
    return {{},
            "none of its layers " + listed(names) +
                " is called like a picture (Combined, beauty, rgba)",
            ""};
  }
  const ExrLayer& picture = found == layers.end() ? layers[0] : *found;
  if (picture.name == "radiance" && layers.size() == 1) {
    return {picture, "", ""};  // of this program, in two parts
  }
  return {picture, "",
          layers.size() == 1
              ? "takes " + picture.name + ", its only layer with colors"
              : "takes " + picture.name + " of " + listed(names)};
}

}  // namespace lightwalk
