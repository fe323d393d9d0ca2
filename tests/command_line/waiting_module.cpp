// An image module that waits for ever while it is loaded and has blocked all
// signals, as a library of OpenImageIO's may where memory is short.

#include <signal.h>
#include <unistd.h>

[[gnu::constructor]] static void wait_for_ever() {
  sigset_t all;
  sigfillset(&all);
  sigprocmask(SIG_BLOCK, &all, nullptr);
  for (;;) pause();
}
