#pragma once

// # One program for all processors
//
// A program that may run on any x86-64 can only use what the first of them
// had: registers of four floats. Since 2013 they hold eight, and a whole pack
// of shapes fits; since 2017 some hold sixteen. So each stage is compiled
// again for AVX2, and what works on rows of paths for AVX-512 too. The one
// for everybody looks at the processor when it starts, and hands over to the
// best of its twins, `avx2/stage4` beside `stage4`. They give the same bits:
// they are compiled without fused multiply-adds, and lanes round like single
// numbers.
//
// The twins are whole programs, and not two versions of a function in one,
// for a reason. An inline function that is compiled twice in one program is
// kept once, and which of the two is kept nobody says: the old processor may
// then meet the new instructions in a function as innocent as `dot`.
//
// Where there is no twin, or on other processors, nothing happens.
// `LIGHTWALK_INSTRUCTIONS=baseline` in the environment keeps the first one,
// and `avx2` passes by AVX-512, to compare them.

#if defined(LIGHTWALK_VARIANTS) && defined(__linux__) && !defined(__AVX2__)
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string_view>
#endif

namespace lightwalk {

/// What this program was compiled for.
inline constexpr const char* instruction_set =
#if defined(__AVX512F__)
    "AVX-512";
#elif defined(__AVX2__)
    "AVX2";
#elif defined(__ARM_NEON)
    "NEON";
#else
    "baseline";
#endif

/// Becomes the variant of this program that suits the processor, if there is
/// one: same process, same arguments. Returns if there is none.
inline void run_variant_for_this_processor([[maybe_unused]] char** argv) {
#if defined(LIGHTWALK_VARIANTS) && defined(__linux__) && !defined(__AVX2__)
  const char* const set = std::getenv("LIGHTWALK_INSTRUCTIONS");
  const std::string_view wish = set ? set : "";
  std::error_code error;
  const std::filesystem::path self =
      std::filesystem::read_symlink("/proc/self/exe", error);
  if (error || wish == "baseline") return;
  const auto become = [&](const char* folder) {
    const std::filesystem::path variant =
        self.parent_path() / folder / self.filename();
    execv(variant.c_str(), argv);  // returns only if it could not
  };
  // What is compiled for each: see the folders' options in CMakeLists.txt.
  const bool has_avx2 =
      __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
      __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("pclmul") &&
      __builtin_cpu_supports("aes");
  if (!has_avx2) return;
  const bool has_avx512 = __builtin_cpu_supports("avx512bw") &&
                          __builtin_cpu_supports("avx512dq") &&
                          __builtin_cpu_supports("avx512vl") &&
                          __builtin_cpu_supports("avx512cd");
  if (has_avx512 && wish != "avx2") become("avx512");
  become("avx2");
#endif
}

}  // namespace lightwalk
