#pragma once

// # What there is under a name
//
// Before a file is written: where does its name lead, what is there already,
// and may it be replaced? Links are followed to the file that they stand for.

#include <cerrno>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include "common/image/file_path.hpp"
#include "common/image/image_error.hpp"

#ifndef _WIN32
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace lightwalk {

[[noreturn]] inline void throw_system_error(int error) {
  throw ImageError(std::generic_category().message(error));
}

inline void check_folder_of(const std::string& path) {
  std::error_code ignored;
  const auto folder = file_path(path).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, ignored)) {
    throw ImageError("there is no folder '" + name_of(folder) + "'");
  }
}

#ifndef _WIN32

/// Makes a system call again where a signal came between.
template <class Call>
auto uninterrupted(Call call) {
  for (;;) {
    const auto result = call();
    if (result >= 0 || errno != EINTR) return result;
  }
}

/// Where a name leads, links followed to their end.
struct FilePlace {
  std::string path;
  std::optional<struct stat> old = {};  ///< none where nothing is there yet
  int descriptor = -1;  ///< an open file of this program, such as /dev/stdout

  /// Pipes and devices have no old content that could be lost, and are not to
  /// be replaced by a file.
  bool is_stream() const {
    return descriptor >= 0 || (old && !S_ISREG(old->st_mode));
  }
};

/// The number in names such as /dev/fd/3, and -1 in others.
inline int descriptor_in(const std::string& path) {
  for (const std::string folder : {"/dev/fd/", "/proc/self/fd/"}) {
    const std::string number = path.substr(0, folder.size()) == folder
                                   ? path.substr(folder.size())
                                   : "";
    if (number.empty() || number.size() > 6 ||
        number.find_first_not_of("0123456789") != std::string::npos) {
      continue;
    }
    return std::stoi(number);
  }
  return -1;
}

/// Throws an ImageError where no file can be, or none that may be replaced.
inline FilePlace find_file_place(const std::string& name) {
  constexpr int most_links = 40;
  FilePlace place{name};
  struct stat status {};
  for (int links = 0;; ++links) {
    check_folder_of(place.path);
    place.descriptor = descriptor_in(place.path);
    if (place.descriptor >= 0) return place;
    if (lstat(place.path.c_str(), &status) != 0) {
      if (errno == ENOENT) return place;
      throw_system_error(errno);
    }
    if (!S_ISLNK(status.st_mode)) break;
    if (links == most_links) throw_system_error(ELOOP);
    std::error_code error;
    const auto target = std::filesystem::read_symlink(place.path, error);
    if (error) throw ImageError(error.message());
    place.path =
        (std::filesystem::path(place.path).parent_path() / target).string();
  }
  if (S_ISDIR(status.st_mode)) throw ImageError("it is a folder");
  if (S_ISSOCK(status.st_mode)) throw ImageError("it is a socket");
  if (faccessat(AT_FDCWD, place.path.c_str(), W_OK, AT_EACCESS) != 0) {
    throw_system_error(errno);
  }
  place.old = status;
  return place;
}

#endif

}  // namespace lightwalk
