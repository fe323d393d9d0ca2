#pragma once

// # Channels of no known type
//
// An EXR file's channels are half, float or whole numbers. A file may claim
// another type, and then the image library does not refuse it but ends the
// program. So the lists of channels are looked at before the library does:
// after the words `channels` and `chlist`, each ended by a NUL, and a number
// of bytes, there are for each channel its name, ended by a NUL, and 16 bytes
// of which the first four are the type.

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "common/image/picture_file.hpp"

namespace lightwalk {

/// What is wrong with the types of the channels in the headers, with which an
/// EXR file begins; empty where nothing is.
inline std::string check_channel_types(std::string_view headers) {
  using namespace std::string_view_literals;
  constexpr std::string_view key = "channels\0chlist\0"sv;
  constexpr std::uint32_t types = 3;
  for (std::size_t at = headers.find(key); at != std::string_view::npos;
       at = headers.find(key, at)) {
    at += key.size();
    const std::size_t bytes = number_at(headers, at, 4, false);
    if (headers.size() - at < 4) break;
    std::string_view list = headers.substr(at + 4, bytes);
    for (std::size_t end = list.find('\0'); end != 0 && end < list.size();
         end = list.find('\0')) {
      const std::uint32_t type = number_at(list, end + 1, 4, false);
      if (type >= types) {
        return "its channel " +
               std::string(list.substr(0, 40).substr(0, end)) +
               " is of type " + std::to_string(type) +
               ": 0, 1 and 2 are known";
      }
      list.remove_prefix(std::min(end + 17, list.size()));
    }
  }
  return "";
}

}  // namespace lightwalk
