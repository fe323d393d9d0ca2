#pragma once

// # What an EXR file claims
//
// The header of an EXR file is a list of attributes: a name, a type, a number
// of bytes, and the bytes. Files of several parts have several headers. The
// image library takes memory for what they claim as soon as it opens a file,
// so they are looked at before that. Whatever is strange in another way is
// left to the library.

#include <algorithm>
#include <array>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/image/image_limits.hpp"

namespace lightwalk {

/// What a smaller library may not be able to read.
struct ExrTraits {
  bool tiled = false, deep = false, subsampled = false;
  bool whole = true;              ///< each header ends, and lacks nothing
  std::vector<int> compressions;  ///< of the parts, as EXR numbers them
};

/// Looks through the headers of an EXR file of `size` bytes.
class ExrHeader {
 public:
  ExrHeader(std::istream& file, std::uintmax_t size)
      : file_(file), size_(size) {}

  /// What is wrong with them, or an empty text.
  std::string check() {
    if (number() != 20000630) return "it is not an EXR file";
    const bool has_parts = (number() & 0x1000) != 0;
    do {
      const std::string error = check_part();
      if (!error.empty()) return error;
    } while (has_parts && file_ && file_.peek() > 0);
    return "";
  }

  /// After the check.
  const ExrTraits& traits() const { return traits_; }

 private:
  struct Window {
    std::int64_t width = 0, height = 0;
    double pixels() const {
      return static_cast<double>(width) * static_cast<double>(height);
    }
  };

  std::string check_part() {
    Window data, display, tile;
    double pixel_bytes = 0;
    int compression = 0;
    bool deep = false;
    std::size_t required = 0;
    for (;;) {
      const std::string name = text();
      if (!file_ || name.empty()) break;
      required += is_required(name) ? 1 : 0;
      text();  // the type
      const std::int64_t bytes = number();
      const std::istream::pos_type begin = file_.tellg();
      if (!file_) break;
      if (bytes < 0 || static_cast<std::uintmax_t>(begin) +
                               static_cast<std::uintmax_t>(bytes) >
                           size_) {
        return "it is cut off: its attribute '" + shown(name) +
               "' claims to be " + std::to_string(bytes) + " bytes";
      }
      if (name == "dataWindow") data = window();
      if (name == "displayWindow") display = window();
      if (name == "tiles") tile.width = size_number();
      if (name == "tiles") tile.height = size_number();
      if (name == "type") deep = text().starts_with("deep");
      if (name == "compression") compression = file_.get();
      if (name == "channels") {
        std::string error = read_channels(pixel_bytes);
        if (!error.empty()) return error;
      }
      file_.seekg(begin + std::istream::off_type(bytes));
    }
    traits_.whole =
        traits_.whole && file_ && required == required_names.size();
    traits_.tiled = traits_.tiled || tile.width != 0;
    traits_.deep = traits_.deep || deep;
    traits_.compressions.push_back(compression);
    // Cut off, which the library finds, too; or not an image that is read.
    if (!file_ || deep) return "";
    for (const Window& claimed : {data, display}) {
      std::string error = check_size(claimed.width, claimed.height);
      if (!error.empty()) return error;
    }
    // Black around a picture costs nothing in the file.
    if (display.pixels() > std::max(0x1p24, 16 * data.pixels())) {
      return "its display window of " + std::to_string(display.width) +
             " x " + std::to_string(display.height) +
             " pixels is nearly empty";
    }
    if (tile.pixels() > std::max(0x1p20, 4 * data.pixels())) {
      return "its tiles of " + std::to_string(tile.width) + " x " +
             std::to_string(tile.height) +
             " pixels are much larger than its picture";
    }
    if (pixel_bytes * data.pixels() > most_bytes) {
      return "its header claims " + std::to_string(data.width) + " x " +
             std::to_string(data.height) + " pixels of " +
             std::to_string(static_cast<std::int64_t>(pixel_bytes)) +
             " bytes";
    }
    return check_packed(data.width, data.height, pixel_bytes * data.pixels(),
                        size_, packed_by(compression));
  }

  /// Twice what the largest picture with its variance takes.
  static constexpr double most_bytes =
      2 * 6 * 4 * static_cast<double>(most_pixels);

  static constexpr std::array<std::string_view, 8> required_names = {
      "channels",           "compression",      "dataWindow",
      "displayWindow",      "lineOrder",        "pixelAspectRatio",
      "screenWindowCenter", "screenWindowWidth"};

  static bool is_required(const std::string& name) {
    return std::find(required_names.begin(), required_names.end(), name) !=
           required_names.end();
  }

  /// How many bytes become one at best, as EXR numbers its compressions.
  static double packed_by(int compression) {
    if (compression == 0) return 1;
    // DWA keeps one number of each block of 8 x 8, and deflates those.
    return compression >= 8 ? 64 * most_packed : 2 * most_packed;
  }

  std::uint32_t unsigned_number() {
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i) {
      value |= static_cast<std::uint32_t>(file_.get() & 0xff) << 8 * i;
    }
    return value;
  }
  std::int64_t number() {
    return static_cast<std::int32_t>(unsigned_number());
  }
  std::int64_t size_number() { return unsigned_number(); }

  /// A text up to its NUL; names have at most 255 characters.
  std::string text() {
    std::string result;
    for (int c = file_.get(); c > 0 && result.size() < 256; c = file_.get()) {
      result += static_cast<char>(c);
    }
    traits_.whole = traits_.whole && result.size() < 256;
    return result;
  }

  static std::string shown(const std::string& name) {
    return name.substr(0, 40);
  }

  Window window() {
    const std::int64_t left = number(), top = number();
    const std::int64_t right = number(), bottom = number();
    return {right - left + 1, bottom - top + 1};
  }

  /// Channels are a name, a type (0 whole numbers, 1 halves, 2 floats), 4
  /// bytes of no interest, and of how many columns and rows one is stored.
  /// For another type the image library would end the program.
  std::string read_channels(double& pixel_bytes) {
    pixel_bytes = 0;
    for (;;) {
      const std::string name = text();
      const std::uint32_t type = unsigned_number();
      if (!file_ || name.empty()) return "";
      if (type > 2) {
        return "its channel '" + shown(name) + "' is of type " +
               std::to_string(type) + ": 0, 1 and 2 are known";
      }
      number();
      const double columns =
          static_cast<double>(std::max<std::int64_t>(number(), 1));
      const double rows =
          static_cast<double>(std::max<std::int64_t>(number(), 1));
      traits_.subsampled = traits_.subsampled || columns * rows != 1;
      pixel_bytes += (type == 1 ? 2 : 4) / (columns * rows);
    }
  }

  std::istream& file_;
  std::uintmax_t size_;
  ExrTraits traits_;
};

}  // namespace lightwalk
