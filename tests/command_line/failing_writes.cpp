// A library to preload, which makes calls fail on files that a program writes.
//
// LIGHTWALK_FAULTS lists faults, separated by commas:
//     PART:CALL:NTH:WHAT    such as out/:write:2:28
// The NTH of the calls (open, write, fsync, close, rename), counted over files
// whose path contains PART, fails once. WHAT is an errno, or "short": fewer
// bytes are written than were given; or "signal15": the signal comes first;
// or "plant": a link to LIGHTWALK_VICTIM is put under the name that is opened.
// Where fsync or close fails, half of the file is lost.
// LIGHTWALK_CALLS names a file to which each of the calls is logged, one a
// line: call, path, and for open the flags.

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <sstream>
#include <string>
#include <vector>

namespace {

struct Fault {
  std::string part, call, what;
  int calls_to_go = 0;
};

struct State {
  std::mutex mutex;
  std::vector<Fault> faults;
  std::map<int, std::string> open_files;  ///< those that are written
  int log = -1;

  State() {
    if (const char* path = std::getenv("LIGHTWALK_CALLS")) {
      log = static_cast<int>(syscall(SYS_openat, AT_FDCWD, path,
                                     O_WRONLY | O_APPEND | O_CREAT, 0600));
    }
    const char* list = std::getenv("LIGHTWALK_FAULTS");
    std::istringstream faults_text(list ? list : "");
    for (std::string text; std::getline(faults_text, text, ',');) {
      std::istringstream fields(text);
      Fault fault;
      std::string nth;
      std::getline(fields, fault.part, ':');
      std::getline(fields, fault.call, ':');
      std::getline(fields, nth, ':');
      std::getline(fields, fault.what, ':');
      fault.calls_to_go = std::atoi(nth.c_str());
      faults.push_back(fault);
    }
  }
};

State& state() {
  static State* const made = new State;
  return *made;
}

/// Logs the call, and returns what shall become of it; "" is nothing special.
std::string fate(const std::string& call, const std::string& path,
                 const std::string& more = "") {
  State& all = state();
  std::string what;
  {
    const std::lock_guard lock(all.mutex);
    if (all.log >= 0) {
      const std::string line = call + ' ' + path + more + '\n';
      syscall(SYS_write, all.log, line.data(), line.size());
    }
    for (Fault& fault : all.faults) {
      if (fault.call != call) continue;
      if (path.find(fault.part) == std::string::npos) continue;
      if (--fault.calls_to_go == 0) what = fault.what;
    }
  }
  if (what.rfind("signal", 0) == 0) {
    raise(std::atoi(what.c_str() + 6));
    return "";
  }
  return what;
}

/// Whether the call fails, with errno set.
bool fails(const std::string& what) {
  if (what.empty() || what == "short") return false;
  errno = std::atoi(what.c_str());
  return true;
}

std::string path_of(int descriptor) {
  State& all = state();
  const std::lock_guard lock(all.mutex);
  const auto found = all.open_files.find(descriptor);
  return found == all.open_files.end() ? "" : found->second;
}

/// What a disk that fails late has lost.
void lose_half(int descriptor) {
  if (errno == EINTR) return;
  const int error = errno;
  const off_t size = lseek(descriptor, 0, SEEK_END);
  if (ftruncate(descriptor, size / 2) != 0) std::abort();
  errno = error;
}

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

int open_logged(const char* name, const char* path, int flags, mode_t mode) {
  const auto call = real<int(const char*, int, ...)>(name);
  if ((flags & O_ACCMODE) == O_RDONLY) return call(path, flags, mode);
  char text[16];
  std::snprintf(text, sizeof text, " %o", static_cast<unsigned>(flags));
  const std::string what = fate("open", path, text);
  if (what == "plant") {
    if (symlink(std::getenv("LIGHTWALK_VICTIM"), path) != 0) std::abort();
  } else if (fails(what)) {
    return -1;
  }
  const int descriptor = call(path, flags, mode);
  if (descriptor >= 0) {
    State& all = state();
    const std::lock_guard lock(all.mutex);
    all.open_files[descriptor] = path;
  }
  return descriptor;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  std::va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return open_logged("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  std::va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = flags & O_CREAT ? va_arg(arguments, mode_t) : 0;
  va_end(arguments);
  return open_logged("open64", path, flags, mode);
}

ssize_t write(int descriptor, const void* data, size_t size) {
  const auto call = real<ssize_t(int, const void*, size_t)>("write");
  const std::string path = path_of(descriptor);
  if (path.empty()) return call(descriptor, data, size);
  const std::string what = fate("write", path);
  if (fails(what)) return -1;
  return call(descriptor, data, what == "short" ? (size + 1) / 2 : size);
}

int fsync(int descriptor) {
  const std::string path = path_of(descriptor);
  if (path.empty()) return real<int(int)>("fsync")(descriptor);
  if (!fails(fate("fsync", path))) return 0;  // no test pulls the plug
  lose_half(descriptor);
  return -1;
}

int close(int descriptor) {
  const std::string path = path_of(descriptor);
  const auto call = real<int(int)>("close");
  if (path.empty()) return call(descriptor);
  {
    State& all = state();
    const std::lock_guard lock(all.mutex);
    all.open_files.erase(descriptor);
  }
  const bool failed = fails(fate("close", path));
  const int error = errno;
  if (failed) lose_half(descriptor);
  const int result = call(descriptor);  // Linux closes whatever it returns
  if (failed) errno = error;
  return failed ? -1 : result;
}

int rename(const char* from, const char* to) noexcept {
  if (fails(fate("rename", to))) return -1;
  return real<int(const char*, const char*)>("rename")(from, to);
}

}  // extern "C"
