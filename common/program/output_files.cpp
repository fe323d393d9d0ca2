#include "common/program/output_files.hpp"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>

#include "common/files/file_path.hpp"
#include "common/image/image_file.hpp"
#include "common/scene_file/message_text.hpp"

namespace lightwalk {

namespace {

std::string cannot_write(const std::string& path, const char* why) {
  return escaped(shortened(path, max_shown_name)) +
         " cannot be written: " + one_line(why);
}

void check_file(const std::string& path,
                void (*check)(const std::string& path)) {
  try {
    check(path);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw std::runtime_error(cannot_write(path, error.what()));
  }
}

bool holds_something(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(file_path(path), error) &&
         std::filesystem::file_size(file_path(path), error) > 0 && !error;
}

}  // namespace

void check_files(const Options& options) {
  for (const std::string& path : options.outputs) {
    check_file(path, check_writable);
  }
  if (options.report) check_file(*options.report, check_file_place);
}

bool write_files(const std::string& program, const Options& options,
                 const RenderResult& result, Report& report) {
  const auto say = [&](const std::string& what) {
    std::fprintf(stderr, "%s: %s\n", program.c_str(), what.c_str());
  };
  bool all = true;
  const auto try_to = [&](const std::string& path, auto write) {
    try {
      write();
      return true;
    } catch (const std::bad_alloc&) {
      say(cannot_write(path, "there is not enough memory"));
    } catch (const std::exception& error) {
      say(cannot_write(path, error.what()));
    }
    all = false;
    return false;
  };
  const bool is_whole = report.info.samples_per_pixel >= 1;
  report.outputs.clear();
  for (const std::string& path : options.outputs) {
    if (!is_whole && holds_something(path)) {
      say(escaped(path) + " is kept as it was: the first pass over the " +
          "picture was not finished");
      continue;
    }
    const bool written = try_to(
        path, [&] { write_image(path, result, options.tone_mapping); });
    if (!written) continue;
    report.outputs.push_back(path);
    if (!is_whole) {
      say("parts of " + escaped(path) + " are black: the first pass over " +
          "the picture was not finished");
    }
  }
  if (const auto& path = options.report) {
    try_to(*path, [&] { write_report(*path, report); });
  }
  return all;
}

}  // namespace lightwalk
