#pragma once

// # Writing a file whole or not at all
//
// The wanted name always stands for a whole file, the old one or the new one.
// The bytes first go to a new file in the same folder. When all of them are
// written, this file is renamed, which replaces the old one in one step. Its
// first name is random, so that two programs can write the same file.

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <string_view>
#include <system_error>

#include "common/files/file_error.hpp"
#include "common/files/file_path.hpp"

namespace lightwalk {

/// Where the bytes of a file go, and what is already there.
struct FilePlace {
  std::filesystem::path path;  ///< links followed to their end
  std::filesystem::file_status old;

  /// Pipes and devices have no old content that could be lost.
  bool is_stream() const { return exists(old) && !is_regular_file(old); }
};

/// Throws a FileError if no file can be there, or none may be replaced.
inline FilePlace find_file_place(const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code error;
  FilePlace place{file_path(name), {}};
  place.old = fs::status(place.path, error);
  if (!status_known(place.old)) throw FileError(error.message());
  if (is_directory(place.old)) throw FileError("it is a folder");
  if (is_socket(place.old)) throw FileError("it is a socket");
  if (place.is_stream()) return place;
  while (is_symlink(fs::symlink_status(place.path, error))) {
    place.path =
        place.path.parent_path() / fs::read_symlink(place.path, error);
  }
  const fs::path folder = place.path.parent_path();
  if (!folder.empty() && !fs::is_directory(folder, error)) {
    throw FileError("there is no folder '" + name_of(folder) + "'");
  }
  const auto add = std::ios::binary | std::ios::app;  // changes nothing yet
  if (exists(place.old) && !std::ofstream(place.path, add)) {
    throw FileError("it may not be written");
  }
  return place;
}

/// A new file in the folder of a place. It becomes the file of that place,
/// with the mode of the old one, or is removed.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(const FilePlace& place)
      : target_(place.path),
        path_(target_.parent_path() / random_name()),
        file_(path_, std::ios::binary) {
    if (!file_) {
      const auto folder = target_.parent_path();
      throw FileError("no file can be made in '" +
                      (folder.empty() ? "." : name_of(folder)) + "'");
    }
    std::error_code ignored;
    if (!exists(place.old)) return;
    std::filesystem::permissions(path_, place.old.permissions(), ignored);
  }
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  ~UnfinishedFile() {
    file_.close();
    std::error_code ignored;
    if (!renamed_) std::filesystem::remove(path_, ignored);
  }

  void finish(std::string_view bytes) {
    file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file_.close();
    if (!file_) throw FileError("it cannot be written whole; is there room?");
    std::error_code error;
    std::filesystem::rename(path_, target_, error);
    if (error) throw FileError(error.message());
    renamed_ = true;
  }

 private:
  static std::string random_name() {
    std::random_device random;
    char name[40];
    std::snprintf(name, sizeof name, ".unfinished-%08x%08x",
                  static_cast<unsigned>(random()),
                  static_cast<unsigned>(random()));
    return name;
  }

  std::filesystem::path target_, path_;
  std::ofstream file_;
  bool renamed_ = false;
};

/// Writes a file, or replaces the old one; follows links. Writes to pipes and
/// devices, too. If it throws a FileError, the old file is unchanged.
inline void write_file(const std::string& name, std::string_view bytes) {
  const FilePlace place = find_file_place(name);
  if (!place.is_stream()) return UnfinishedFile(place).finish(bytes);
  std::ofstream stream(place.path, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) throw FileError("it does not take all of the bytes");
}

/// Throws the FileError that `write_file` would throw, as far as that can be
/// found out without writing.
inline void check_file_place(const std::string& name) {
  const FilePlace place = find_file_place(name);
  if (place.is_stream()) return;
  const UnfinishedFile trial(place);
}

}  // namespace lightwalk
