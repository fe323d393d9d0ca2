#include "common/image/small_exr_parts.hpp"

#include <cstdlib>
#include <memory>

#include "common/image/image_limits.hpp"
#include "common/image/picture_file.hpp"

namespace lightwalk::small_images {
namespace {

std::string said(const char* message) {
  std::string text = message ? message : "it cannot be read";
  FreeEXRErrorMessage(message);
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (char& c : text) c = c == '\n' ? ' ' : c;
  return text;
}

const unsigned char* data_of(const std::string& bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

std::int64_t width_of(const EXRBox2i& box) {
  return std::int64_t{box.max_x} - box.min_x + 1;
}
std::int64_t height_of(const EXRBox2i& box) {
  return std::int64_t{box.max_y} - box.min_y + 1;
}

/// How many rows are packed into a piece.
std::int64_t rows_of(const EXRHeader& header) {
  return header.compression_type == TINYEXR_COMPRESSIONTYPE_ZIP ? 16 : 1;
}

}  // namespace

ExrParts::~ExrParts() {
  for (EXRImage& image : images_) FreeEXRImage(&image);
  for (EXRHeader* header : headers_) {
    FreeEXRHeader(header);
    std::free(header);
  }
}

std::string ExrParts::read(const std::string& bytes) {
  EXRVersion version;
  const unsigned char* data = data_of(bytes);
  if (ParseEXRVersionFromMemory(&version, data, bytes.size()) !=
      TINYEXR_SUCCESS) {
    return "it is not an EXR file";
  }
  multipart_ = version.multipart != 0;
  const char* why = nullptr;
  int result = TINYEXR_SUCCESS;
  if (multipart_) {
    EXRHeader** list = nullptr;
    int count = 0;
    result = ParseEXRMultipartHeaderFromMemory(&list, &count, &version, data,
                                               bytes.size(), &why);
    if (list) headers_.assign(list, list + count);
    std::free(list);
  } else {
    auto* header = static_cast<EXRHeader*>(std::malloc(sizeof(EXRHeader)));
    if (!header) return "there is not enough memory for it";
    InitEXRHeader(header);
    headers_.push_back(header);
    result =
        ParseEXRHeaderFromMemory(header, &version, data, bytes.size(), &why);
  }
  if (result != TINYEXR_SUCCESS) return said(why);
  return headers_.empty() ? "it has no parts" : check_chunks(bytes);
}

/// Behind the headers is a table for each part of where its pieces are. A
/// piece is the number of its part, where there are several; its first row;
/// its size; and so many bytes.
std::string ExrParts::check_chunks(std::string_view bytes) const {
  std::uint64_t table = 8 + (multipart_ ? 1 : 0);
  for (const EXRHeader* header : headers_) table += header->header_len;
  double all_bytes = 0;
  for (const EXRHeader* header : headers_) {
    const std::int64_t width = width_of(header->data_window);
    const std::int64_t height = height_of(header->data_window);
    std::string error = check_size(width, height);
    if (!error.empty()) return error;
    const std::int64_t chunks =
        (height + rows_of(*header) - 1) / rows_of(*header);
    if (header->chunk_count != chunks &&
        (multipart_ || header->chunk_count != 0)) {
      return "it claims to be in " + std::to_string(header->chunk_count) +
             " pieces, and its rows make " + std::to_string(chunks);
    }
    all_bytes += static_cast<double>(width) * static_cast<double>(height) *
                 header->num_channels * 4;
    const std::uint64_t start = multipart_ ? 4 : 0;
    for (std::int64_t i = 0; i < chunks; ++i, table += 8) {
      if (table + 8 > bytes.size()) return "it is cut off";
      const std::uint64_t at =
          std::uint64_t{number_at(bytes, table, 4, false)} |
          std::uint64_t{number_at(bytes, table + 4, 4, false)} << 32;
      if (at == 0 || at > bytes.size() || bytes.size() - at <= start + 8) {
        return "it is cut off: rows of it are not there";
      }
      const std::uint32_t size = number_at(bytes, at + start + 4, 4, false);
      if (size == 0 || size > bytes.size() - at - start - 8) {
        return "it is cut off: rows of it are not whole";
      }
      const auto row =
          static_cast<std::int32_t>(number_at(bytes, at + start, 4, false));
      if (row != header->data_window.min_y + i * rows_of(*header)) {
        return "its rows are not where its table says";
      }
    }
  }
  // Known before tinyexr, which does not ask whether it got its memory.
  constexpr double most = 2 * 6 * 4 * static_cast<double>(most_pixels);
  if (all_bytes > most) return "its channels are too many";
  const std::unique_ptr<char[]> trial(
      new char[static_cast<std::size_t>(all_bytes)]);
  return "";
}

std::string ExrParts::read_pixels(const std::string& bytes) {
  for (EXRHeader* header : headers_) {
    // Rows are where their number says, in whatever order they are stored.
    header->line_order = 0;
    for (int c = 0; c < header->num_channels; ++c) {
      if (header->pixel_types[c] == TINYEXR_PIXELTYPE_HALF) {
        header->requested_pixel_types[c] = TINYEXR_PIXELTYPE_FLOAT;
      }
    }
    EXRImage& image = images_.emplace_back();
    InitEXRImage(&image);
    // So that what is left of an image that is broken is released.
    image.num_channels = header->num_channels;
  }
  std::vector<const EXRHeader*> constant(headers_.begin(), headers_.end());
  const char* why = nullptr;
  const int result =
      multipart_ ? LoadEXRMultipartImageFromMemory(
                       images_.data(), constant.data(),
                       static_cast<unsigned>(constant.size()), data_of(bytes),
                       bytes.size(), &why)
                 : LoadEXRImageFromMemory(images_.data(), headers_[0],
                                          data_of(bytes), bytes.size(), &why);
  if (result == TINYEXR_SUCCESS) return "";
  if (!multipart_) InitEXRImage(images_.data());  // it was released
  return said(why);
}

}  // namespace lightwalk::small_images
