#pragma once

// # The headers of an EXR file, by tinyexr
//
// tinyexr believes what a header says, so what it says is compared with the
// file before a pixel is asked for.

#include <tinyexr.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lightwalk::small_images {

/// All headers of a file, which are given back to tinyexr at the end.
class ExrParts {
 public:
  ExrParts() = default;
  ExrParts(const ExrParts&) = delete;
  ExrParts& operator=(const ExrParts&) = delete;
  ~ExrParts();

  /// Reads them; returns what is wrong, or an empty text.
  std::string read(const std::string& bytes);

  /// Reads the pixels of all parts, channels of half floats as floats.
  /// Returns what is wrong, or an empty text.
  std::string read_pixels(const std::string& bytes);

  std::size_t size() const { return headers_.size(); }
  const EXRHeader& header(std::size_t part) const { return *headers_[part]; }
  const EXRImage& image(std::size_t part) const { return images_[part]; }

 private:
  std::string check_chunks(std::string_view bytes) const;

  bool multipart_ = false;
  std::vector<EXRHeader*> headers_;
  std::vector<EXRImage> images_;
};

}  // namespace lightwalk::small_images
