#pragma once

// # The course's PPM
//
// Plain-text P3, with the comment `#MAX=` that says which linear value the
// largest whole number stands for: a stored number $s$ of a file with color
// resolution $c$ is the value $s \cdot \mathrm{MAX} / c$. Without the comment
// MAX is 1. So the file holds light beyond 1, in steps of MAX/65535.

#include <charconv>
#include <cmath>
#include <string>

#include "common/image/image.hpp"
#include "common/files/file_error.hpp"
#include "common/image/image_limits.hpp"
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

  /// The value of the largest number; 1 where no comment has said it.
  float max() const { return max_; }
  bool has_max() const { return has_max_; }

  /// From here on a comment with `#MAX=` comes too late.
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

  /// Takes `#MAX=2.5`, in small letters and with blanks too. What nearly is
  /// one is refused: without its MAX a picture has other values.
  void comment() {
    const char* begin = next_;
    while (next_ < end_ && *next_ != '\n' && *next_ != '\r') ++next_;
    const std::string text(begin, next_);
    std::size_t at = 1;
    const auto skip_blanks = [&] {
      while (at < text.size() && (text[at] == ' ' || text[at] == '\t')) ++at;
    };
    skip_blanks();
    std::string key;
    for (; at < text.size() && is_letter(text[at]); ++at) {
      key += static_cast<char>(text[at] | 0x20);
    }
    if (key.rfind("max", 0) != 0) return;
    skip_blanks();
    const char next = at < text.size() ? text[at] : ' ';
    const bool number = next == '.' || (next >= '0' && next <= '9');
    if (next != '=' && next != ':' && !(key == "max" && number)) return;
    const std::string quoted = "its comment '" + text.substr(0, 40) + "'";
    if (next != '=' || key != "max") {
      throw FileError(quoted + " is not understood: expected is #MAX=2.5");
    }
    if (in_pixels_) throw FileError(quoted + " comes after the first pixel");
    if (has_max_) throw FileError(quoted + " is its second of this kind");
    ++at;
    skip_blanks();
    const char* first = text.c_str() + at;
    char* after = nullptr;
    max_ = std::strtof(first, &after);
    const bool empty = after == first;
    while (*after == ' ' || *after == '\t') ++after;
    if (empty || *after || !(max_ > 0) || !std::isfinite(max_)) {
      throw FileError(quoted + " does not give a number above 0");
    }
    has_max_ = true;
  }

  static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
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
  if (words.word() != "P3")
    throw FileError("it is not a plain PPM (P3) file");
  const long long width = words.number("its width");
  const long long height = words.number("its height");
  if (const std::string error = check_written_size(width, height);
      !error.empty()) {
    throw FileError(error);
  }
  return {width, height};
}

/// Its size stands in the first bytes of a file, but for very long comments.
inline constexpr std::size_t longest_ppm_header = 1 << 16;

/// More bytes than a file of this size has: a number takes 11 at most, and
/// there is twice as much room for comments.
inline std::size_t most_ppm_bytes(const std::string& first_bytes) {
  PpmWords words(first_bytes);
  const auto [width, height] = read_ppm_size(words);
  return 100 * static_cast<std::size_t>(width * height) + (1 << 20);
}

/// Sets `note` for a file that does not say what its numbers stand for.
inline Image decode_ppm_with_note(const std::string& text,
                                  std::string& note) {
  PpmWords words(text);
  const auto [width, height] = read_ppm_size(words);
  const long long resolution = words.number("its color resolution");
  if (resolution < 1 || resolution > 0x7fffffff) {
    throw FileError("its color resolution is " + std::to_string(resolution));
  }
  // Each number takes a digit and a space, so this much must be there.
  if (static_cast<std::size_t>(width * height) > text.size() / 6 + 1) {
    throw FileError("it is cut off: " + std::to_string(text.size()) +
                     " bytes cannot hold " + std::to_string(width) + " x " +
                     std::to_string(height) + " pixels");
  }
  Image image(static_cast<int>(width), static_cast<int>(height));
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
    note = "has no comment #MAX=, so its largest number is taken to be 1";
  }
  return image;
}

inline Image decode_ppm(const std::string& text) {
  std::string note;
  return decode_ppm_with_note(text, note);
}

}  // namespace lightwalk
