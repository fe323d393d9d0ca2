#pragma once

// Writing a file on Windows so that none is lost: as write_file.hpp does it
// elsewhere, with Windows' own calls. Names are UTF-8.

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "common/image/file_path.hpp"
#include "common/image/file_place.hpp"
#include "common/image/image_error.hpp"
#include "common/image/windows.hpp"

#ifdef _WIN32

namespace lightwalk {

[[noreturn]] inline void throw_windows_error() {
  const auto error = static_cast<int>(GetLastError());
  throw ImageError(std::system_category().message(error));
}

/// A new file beside a place, which becomes the file of that place or is
/// removed. One at a time.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(const std::string& path)
      : target_(file_path(path)), name_(unfinished_name(path)) {
    // Known before it exists: a signal may come at once.
    unfinished_file = name_.c_str();
    // Never what is there already.
    file_ = CreateFileW(file_path(name_).c_str(), GENERIC_WRITE, 0, nullptr,
                        CREATE_NEW, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (file_ != INVALID_HANDLE_VALUE) return;
    unfinished_file = nullptr;
    throw_windows_error();
  }
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  ~UnfinishedFile() {
    close();
    if (!renamed_) DeleteFileW(file_path(name_).c_str());
    unfinished_file = nullptr;
  }

  /// All bytes: the system takes at most 4 GB at a time.
  void write(std::string_view bytes) const {
    constexpr std::size_t most_at_once = std::size_t{1} << 30;
    while (!bytes.empty()) {
      const auto next =
          static_cast<DWORD>(std::min(bytes.size(), most_at_once));
      DWORD written = 0;
      if (!WriteFile(file_, bytes.data(), next, &written, nullptr)) {
        throw_windows_error();
      }
      bytes.remove_prefix(written);
    }
  }

  void take_its_place() {
    if (!FlushFileBuffers(file_)) throw_windows_error();
    close();
    if (!MoveFileExW(file_path(name_).c_str(), target_.c_str(),
                     MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH)) {
      throw_windows_error();
    }
    renamed_ = true;
  }

 private:
  void close() {
    if (file_ != INVALID_HANDLE_VALUE) CloseHandle(file_);
    file_ = INVALID_HANDLE_VALUE;
  }

  std::filesystem::path target_;
  std::string name_;
  HANDLE file_ = INVALID_HANDLE_VALUE;
  bool renamed_ = false;
};

/// Throws an ImageError where no file can be, or none that may be replaced.
inline void check_file_place(const std::string& path) {
  check_folder_of(path);
  const std::filesystem::path place = file_path(path);
  // NTFS: a name has at most 255 units of UTF-16.
  if (place.filename().native().size() > 255) {
    throw ImageError("its name is too long");
  }
  const DWORD attributes = GetFileAttributesW(place.c_str());
  if (attributes == INVALID_FILE_ATTRIBUTES) return;
  if (attributes & FILE_ATTRIBUTE_DIRECTORY) {
    throw ImageError("it is a folder");
  }
  if (attributes & FILE_ATTRIBUTE_READONLY) {
    throw ImageError("it may not be written");
  }
}

/// Writes a file, or replaces what it holds. Throws an ImageError, and then
/// the old file is as it was.
inline void write_file(const std::string& path, std::string_view bytes) {
  check_file_place(path);
  UnfinishedFile file(path);
  file.write(bytes);
  file.take_its_place();
}

/// Throws the ImageError that `write_file` would throw, if that can be known.
inline void check_place(const std::string& path) {
  check_file_place(path);
  const UnfinishedFile trial(path);
}

}  // namespace lightwalk

#endif
