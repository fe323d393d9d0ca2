#pragma once

// What the harnesses share. A harness takes any bytes, and ends the program if
// a check fails; then libFuzzer keeps the bytes.

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "tests/core/exact_text.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size);

namespace lightwalk::fuzz {

using tests::text;

/// Where a harness reports, even if libFuzzer discards stderr.
inline std::FILE* const report = fdopen(dup(STDERR_FILENO), "w");

/// Ends the program with a finding unless `what` holds.
inline void expect(bool holds, const char* what,
                   const std::string& but = "") {
  if (holds) return;
  std::fprintf(report, "fuzz: it does not hold that %s%s%s\n", what,
               but.empty() ? "" : ": ", but.c_str());
  std::fflush(report);
  std::abort();
}

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return size == 0 ? std::string()
                   : std::string(reinterpret_cast<const char*>(data), size);
}

/// Whether a message is one line, without control characters.
inline bool is_one_line(std::string_view message) {
  for (const char c : message) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < ' ' || byte == 0x7f) return false;
  }
  return !message.empty();
}

/// Fails if an image that was read is incomplete.
inline void check_pixels(int width, int height, std::size_t count) {
  expect(width > 0 && height > 0, "an image has pixels");
  expect(count == static_cast<std::size_t>(width) *
                      static_cast<std::size_t>(height),
         "an image has width x height pixels",
         std::to_string(width) + " x " + std::to_string(height) + " and " +
             std::to_string(count));
}

}  // namespace lightwalk::fuzz
