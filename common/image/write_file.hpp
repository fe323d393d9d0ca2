#pragma once

// # Writing a file so that none is lost
//
// Under the wanted name there is always a whole file: the old one, or the new
// one. The bytes go to a file beside it first, under a name that nobody can
// foresee. Only when they are on the disk is that file renamed, which
// replaces the old one in one step. Where anything fails, the file with the
// odd name is removed, and the old one has not been touched. It is only left
// behind where nothing can be done any more: where the power fails, say.
//
// What is at the other name of a hard link stays as it was: the new picture
// is a new file. To write into the old one would keep the link, and would
// lose both pictures where the disk is full.

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>
#include <string_view>
#include <system_error>

#include "common/image/file_path.hpp"
#include "common/image/file_place.hpp"
#include "common/image/image_error.hpp"

#ifndef _WIN32
#include <fcntl.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace lightwalk {

/// The name under which a file is written before it is renamed: in the same
/// folder, short, and another one each time.
inline std::string unfinished_name(const std::string& path) {
  std::random_device random;
  char name[40];
  std::snprintf(name, sizeof name, ".unfinished-%08x%08x",
                static_cast<unsigned>(random()),
                static_cast<unsigned>(random()));
  return name_of(file_path(path).parent_path() / name);
}

/// The unfinished file that there is now, for whoever ends the program.
inline std::atomic<const char*> unfinished_file{nullptr};
static_assert(std::atomic<const char*>::is_always_lock_free);

#ifndef _WIN32

// ## Files that are open

/// A descriptor that is closed again.
class OpenFile {
 public:
  explicit OpenFile(int descriptor) : descriptor_(descriptor) {
    if (descriptor < 0) throw_system_error(errno);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  int descriptor() const { return descriptor_; }

  /// All bytes: the system may take fewer at a time than it is given.
  void write(std::string_view bytes) const {
    constexpr std::size_t most_at_once = std::size_t{1} << 30;
    while (!bytes.empty()) {
      const std::string_view next = bytes.substr(0, most_at_once);
      const auto written = uninterrupted(
          [&] { return ::write(descriptor_, next.data(), next.size()); });
      if (written < 0) throw_system_error(errno);
      if (written == 0) throw_system_error(EIO);
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  /// Some systems say only now that what was written is lost.
  void close() {
    const int descriptor = descriptor_;
    descriptor_ = -1;
    // After a signal it is closed all the same.
    if (::close(descriptor) != 0 && errno != EINTR) throw_system_error(errno);
  }

 private:
  int descriptor_;
};

/// A new file beside a place, which becomes the file of that place or is
/// removed. One at a time.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(const FilePlace& place)
      : target_(place.path),
        name_(unfinished_name(place.path)),
        file_(create(place.old ? 0600 : 0666)) {
    if (place.old) become_like(*place.old);
  }
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  ~UnfinishedFile() {
    if (!renamed_) unlink(name_.c_str());
    unfinished_file = nullptr;
  }

  void write(std::string_view bytes) const { file_.write(bytes); }

  void take_its_place() {
    const int synced =
        uninterrupted([&] { return fsync(file_.descriptor()); });
    // EINVAL and ENOTSUP: this file system has nothing to wait for.
    if (synced != 0 && errno != EINVAL && errno != ENOTSUP) {
      throw_system_error(errno);
    }
    file_.close();
    if (uninterrupted([&] {
          return std::rename(name_.c_str(), target_.c_str());
        }) != 0) {
      throw_system_error(errno);
    }
    renamed_ = true;
  }

 private:
  /// Never what is there already, be it a file or a link that was planted.
  int create(mode_t mode) const {
    // Known before it exists: a signal may come at once.
    unfinished_file = name_.c_str();
    const int descriptor = uninterrupted([&] {
      return open(name_.c_str(),
                  O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode);
    });
    if (descriptor >= 0) return descriptor;
    const int error = errno;
    unfinished_file = nullptr;
    const auto folder = file_path(name_).parent_path();
    throw ImageError("no file can be made in '" +
                     (folder.empty() ? "." : name_of(folder)) +
                     "': " + std::generic_category().message(error));
  }

  /// Takes over who may read the old file, as far as the system lets us.
  void become_like(const struct stat& old) const {
    const int file = file_.descriptor();
    struct stat now {};
    mode_t mode = old.st_mode & 07777;
    if (fstat(file, &now) != 0) return;
    if (now.st_uid != old.st_uid || now.st_gid != old.st_gid) {
      if (fchown(file, old.st_uid, old.st_gid) != 0 &&
          fchown(file, static_cast<uid_t>(-1), old.st_gid) != 0) {
        mode &= 0777;  // not in the name of somebody else
      }
    }
    if (fchmod(file, mode) != 0) return;  // then it is its owner's alone
  }

  std::string target_, name_;
  OpenFile file_;
  bool renamed_ = false;
};

/// Into a pipe or device. A reader who went away is an error, no signal.
inline void write_stream(const FilePlace& place, std::string_view bytes) {
  struct NoSignal {
    NoSignal() = default;
    NoSignal(const NoSignal&) = delete;
    NoSignal& operator=(const NoSignal&) = delete;
    ~NoSignal() { std::signal(SIGPIPE, before); }
    void (*before)(int) = std::signal(SIGPIPE, SIG_IGN);
  } no_signal;
  OpenFile file(
      place.descriptor >= 0 ? dup(place.descriptor) : uninterrupted([&] {
        return open(place.path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC);
      }));
  file.write(bytes);
  file.close();
}

// ## All of it

/// Writes a file, or replaces what it holds: the file that a link leads to,
/// with its mode and, where the system allows that, its owner. Pipes and
/// devices are written to. Throws an ImageError, and then the old file is as
/// it was.
inline void write_file(const std::string& path, std::string_view bytes) {
  const FilePlace place = find_file_place(path);
  if (place.is_stream()) return write_stream(place, bytes);
  UnfinishedFile file(place);
  file.write(bytes);
  file.take_its_place();
}

/// Throws the ImageError that `write_file` would throw, if that can be known.
inline void check_place(const std::string& path) {
  const FilePlace place = find_file_place(path);
  if (place.is_stream()) return;
  // Nobody handles signals yet that would remove the trial.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  struct Restore {
    const sigset_t& mask;
    ~Restore() { pthread_sigmask(SIG_SETMASK, &mask, nullptr); }
  } const restore{before};
  const UnfinishedFile trial(place);
}

#endif

}  // namespace lightwalk

#ifdef _WIN32
#include "common/image/write_file_windows.hpp"
#endif
