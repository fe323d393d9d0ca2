#pragma once

namespace lightwalk {

/// The registers that this program was compiled for. By default they are
/// those of the machine that builds it; LIGHTWALK_NATIVE=OFF is portable.
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

}  // namespace lightwalk
