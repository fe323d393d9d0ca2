#pragma once

#ifndef _WIN32

#include <sys/resource.h>

#include <csignal>
#include <cstddef>

namespace lightwalk::tests {

/// While this object exists, no file of this program grows beyond some bytes.
class FullDisk {
 public:
  explicit FullDisk(std::size_t bytes) : handler_(signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

}  // namespace lightwalk::tests

#endif
