#pragma once

// An open exercise reports itself once, with its place in the source.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <string_view>

// Code that is not written yet does not use its parameters. `make check` reads
// all warnings, and knows which exercises are open.
#if defined(LIGHTWALK_ALL_WARNINGS)
#elif defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#ifdef __clang__
#pragma GCC diagnostic ignored "-Wunused-private-field"
#endif
#elif defined(_MSC_VER)
#pragma warning(disable : 4100 4101 4189)
#endif

namespace lightwalk {

/// Prints on stderr that the exercise is open, at the first call from any
/// thread. Later calls are cheap.
inline void open_exercise(const char* number, const char* title,
                          const char* path = __builtin_FILE(),
                          int line = __builtin_LINE()) {
  static std::array<std::atomic<const char*>, 32> told{};
  for (std::atomic<const char*>& one : told) {
    const char* seen = one.load(std::memory_order_relaxed);
    if (seen == nullptr && one.compare_exchange_strong(seen, number)) {
      std::string_view file = path;
      const std::size_t folder = file.rfind("stages");
      if (folder != file.npos) file.remove_prefix(folder);
      std::fprintf(stderr, "exercise %s (%s) is still open: %.*s:%d\n",
                   number, title, static_cast<int>(file.size()), file.data(),
                   line);
      return;
    }
    // The same number may have another address in each translation unit.
    if (seen == number || std::string_view(seen) == number) return;
  }
}

}  // namespace lightwalk
