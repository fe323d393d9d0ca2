#pragma once

// # The course's PPM
//
// Plain-text P3, with the comment `#MAX=` that says which linear value the
// largest whole number stands for: a stored number $s$ of a file with color
// resolution $c$ is the value $s \cdot \mathrm{MAX} / c$. Without the comment
// MAX is 1. So the file holds light beyond 1, in steps of MAX/65535.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

#include "common/files/file_error.hpp"
#include "common/files/read_file.hpp"
#include "common/image/image.hpp"
#include "common/image/image_limits.hpp"
#include "common/image/render_result.hpp"
#include "common/image/tone_mapping.hpp"

namespace lightwalk {

inline std::string encode_ppm(const Image& image) {
  constexpr int resolution = 65535;
  float largest = max_value(image);
  if (!(largest > 0)) largest = 1;
  char number[64];
  const auto written =
      std::to_chars(number, number + sizeof number, largest).ptr;
  std::string text = "P3\n#MAX=" + std::string(number, written) + '\n' +
                     std::to_string(image.width) + ' ' +
                     std::to_string(image.height) + '\n' +
                     std::to_string(resolution) + '\n';
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const Vec3 pixel =
          glm::clamp(image.at(column, row) / largest, 0.0f, 1.0f);
      for (int c = 0; c < 3; ++c) {
        text += std::to_string(std::lround(pixel[c] * resolution));
        text += c < 2 ? ' ' : column + 1 < image.width ? '\t' : '\n';
      }
    }
  }
  return text;
}

/// Splits a P3 file into its words, and takes `#MAX=` from its comments.
class PpmWords {
 public:
  explicit PpmWords(const std::string& text)
      : next_(text.data()), end_(next_ + text.size()) {}

  /// The value of the largest number; 1 if no comment gives it.
  float max() const { return max_; }
  bool has_max() const { return has_max_; }

  /// From here on a comment with `#MAX=` is an error.
  void begin_pixels() { in_pixels_ = true; }

  std::string_view word() {
    for (; next_ < end_ && (is_space(*next_) || *next_ == '#');) {
      if (*next_ == '#') {
        comment();
      } else {
        ++next_;
      }
    }
    const char* begin = next_;
    while (next_ < end_ && !is_space(*next_) && *next_ != '#') ++next_;
    return {begin, static_cast<std::size_t>(next_ - begin)};
  }

  /// A whole number; `what` is what the message calls it.
  long long number(const char* what) {
    const std::string_view text = word();
    long long value = 0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) {
      throw FileError(text.empty() ? "it is cut off: " + std::string(what) +
                                         " is missing"
                                   : std::string(what) + " is '" +
                                         std::string(text.substr(0, 20)) +
                                         "', not a whole number");
    }
    return value;
  }

 private:
  static bool is_space(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
  }

  /// Reads `#MAX=2.5`, also in lower case and with blanks.
  void comment() {
    const char* const begin = next_;
    while (next_ < end_ && *next_ != '\n' && *next_ != '\r') ++next_;
    std::string text;
    for (const char c : std::string_view(begin, next_)) {
      if (!is_space(c)) {
        text += c >= 'A' && c <= 'Z' ? static_cast<char>(c | 0x20) : c;
      }
    }
    constexpr std::string_view key = "#max=";
    if (!text.starts_with(key)) return;
    const auto fail = [&](const char* why) {
      const std::string quoted(begin, std::min(next_, begin + 40));
      throw FileError("its comment '" + quoted + "' " + why);
    };
    if (in_pixels_) fail("comes after the first pixel");
    if (has_max_) fail("is its second of this kind");
    const char* const number = text.c_str() + key.size();
    char* end = nullptr;
    max_ = std::strtof(number, &end);
    if (end == number || *end || !(max_ > 0) || !std::isfinite(max_)) {
      fail("does not give a number above 0");
    }
    has_max_ = true;
  }

  const char* next_;
  const char* end_;
  float max_ = 1;
  bool has_max_ = false, in_pixels_ = false;
};

/// The width and height of a P3 file, which are its first words.
struct PpmSize {
  long long width, height;
};

inline PpmSize read_ppm_size(PpmWords& words) {
  if (words.word() != "P3") {
    throw FileError("it is not a plain PPM (P3) file");
  }
  const long long width = words.number("its width");
  const long long height = words.number("its height");
  check_size(width, height);
  return {width, height};
}

/// `note` warns of a file that does not say what its numbers stand for.
inline RenderResult decode_ppm(const std::string& text) {
  PpmWords words(text);
  const auto [width, height] = read_ppm_size(words);
  const long long resolution = words.number("its color resolution");
  if (resolution < 1 || resolution > 0x7fffffff) {
    throw FileError("its color resolution is " + std::to_string(resolution));
  }
  // Each number takes a digit and a space.
  check_packed(width, height, 6 * static_cast<double>(width * height) - 6,
               text.size(), 1);
  RenderResult result;
  Image& image = result.radiance;
  image = Image(static_cast<int>(width), static_cast<int>(height));
  bool first = true;
  for (Vec3& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) {
      const long long value = words.number("a pixel");
      if (first) words.begin_pixels();
      first = false;
      if (value < 0 || value > resolution) {
        throw FileError("a pixel is " + std::to_string(value) +
                        ", outside 0 to " + std::to_string(resolution));
      }
      pixel[c] = static_cast<float>(static_cast<double>(value) *
                                    static_cast<double>(words.max()) /
                                    static_cast<double>(resolution));
    }
  }
  words.word();  // a comment at the end is read too
  if (!words.has_max()) {
    result.note =
        "has no comment #MAX=, so its largest number is taken to be 1";
  }
  return result;
}

/// Reads a PPM file, and of a file that is too long no more than it needs:
/// the size is at the beginning, and a number takes at most 11 bytes.
/// Comments have twice as much room. Throws a FileError.
inline RenderResult read_ppm(const std::string& name) {
  const std::string start = read_file(name, 1 << 16);
  PpmWords words(start);
  const auto [width, height] = read_ppm_size(words);
  return decode_ppm(read_file(
      name, 100 * static_cast<std::size_t>(width * height) + (1 << 20)));
}

}  // namespace lightwalk
