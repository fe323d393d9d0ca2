// A program compiled for one machine may be started on an older one that
// shares its folder. It would crash somewhere with an illegal instruction.
// This check runs before all other code of the program and says why instead.
// It is compiled for any x86-64, and calls nothing that is not.

#include <errno.h>
#include <string.h>
#include <unistd.h>

namespace {

#if defined(NEEDS_avx512)
constexpr char set[] = "AVX-512";
#elif defined(NEEDS_avx2)
constexpr char set[] = "AVX2";
#else  // a discontinued extension, for the test of this file
constexpr char set[] = "XOP";
#endif

bool processor_has_set() {
  __builtin_cpu_init();
#if defined(NEEDS_avx512)
  return __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("avx512cd");
#elif defined(NEEDS_avx2)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
         __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("aes");
#else
  return __builtin_cpu_supports("xop");
#endif
}

void say(const char* text) {
  if (write(STDERR_FILENO, text, strlen(text)) < 0) _exit(1);
}

__attribute__((constructor(101))) void check() {
  if (processor_has_set()) return;
  say(program_invocation_short_name);
  say(": compiled for ");
  say(set);
  say(", which this machine's processor does not have. Compile it here, in a "
      "folder of its own: make BUILD=build-here\n");
  _exit(1);
}

}  // namespace
