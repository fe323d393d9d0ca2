#pragma once

// # One program for all processors
//
// A program that may run on any x86-64 can only use what the first of them
// had: registers of four floats. Since 2013 they hold eight, and a whole pack
// of shapes fits. So each stage is compiled twice, and the one for everybody
// looks at the processor when it starts. Where AVX2 is there, it hands over
// to its twin, `avx2/stage4` beside `stage4`, which gives the same bits: it
// was compiled without fused multiply-adds, and lanes round like single
// numbers.
//
// The twins are whole programs, and not two versions of a function in one,
// for a reason. An inline function that is compiled twice in one program is
// kept once, and which of the two is kept nobody says: the old processor may
// then meet the new instructions in a function as innocent as `dot`.
//
// Where there is no twin, or on other processors, nothing happens.
// `LIGHTWALK_INSTRUCTIONS=baseline` in the environment keeps the first one,
// to compare the two.

#if defined(LIGHTWALK_VARIANTS) && defined(__linux__) && !defined(__AVX2__)
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>
#endif

namespace lightwalk {

/// Becomes the variant of this program that suits the processor, if there is
/// one: same process, same arguments. Returns if there is none.
inline void run_variant_for_this_processor([[maybe_unused]] char** argv) {
#if defined(LIGHTWALK_VARIANTS) && defined(__linux__) && !defined(__AVX2__)
  const char* const wish = std::getenv("LIGHTWALK_INSTRUCTIONS");
  if (wish && std::string_view(wish) == "baseline") return;
  if (!__builtin_cpu_supports("avx2")) return;
  std::error_code error;
  const std::filesystem::path self =
      std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return;
  const std::filesystem::path variant =
      self.parent_path() / "avx2" / self.filename();
  execv(variant.c_str(), argv);  // returns only if it could not
#endif
}

}  // namespace lightwalk
