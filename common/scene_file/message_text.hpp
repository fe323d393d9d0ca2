#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lightwalk {

/// The text with blanks for control characters, ASCII's and those that UTF-8
/// writes as C2 80 to C2 9F. They would break the one line of an error, or
/// command the terminal.
inline std::string one_line(std::string_view text) {
  std::string result;
  unsigned char before = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (before == 0xc2 && byte < 0xa0) result.back() = ' ';
    const bool control =
        byte < ' ' || byte == 0x7f || (before == 0xc2 && byte < 0xa0);
    result += control ? ' ' : c;
    before = byte;
  }
  return result;
}

/// The text with its control characters spelled out, such as \x0a, for names
/// that people should find again.
inline std::string escaped(std::string_view text) {
  const auto spelt_out = [](unsigned char byte) {
    constexpr const char* digits = "0123456789abcdef";
    return std::string("\\x") + digits[byte / 16] + digits[byte % 16];
  };
  std::string result;
  unsigned char before = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool second = before == 0xc2 && byte >= 0x80 && byte < 0xa0;
    if (second) {
      result.pop_back();
      result += spelt_out(before);
    }
    if (second || byte < ' ' || byte == 0x7f) {
      result += spelt_out(byte);
    } else {
      result += c;
    }
    before = byte;
  }
  return result;
}

/// The text, or its first `most` bytes, but never half a character.
inline std::string shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  while (most > 0 && (text[most] & '\xc0') == '\x80') --most;
  return std::string(text.substr(0, most)) + "...";
}

/// Longer names of files are cut in messages.
inline constexpr std::size_t max_shown_name = 300;

}  // namespace lightwalk
