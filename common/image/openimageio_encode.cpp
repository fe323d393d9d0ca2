// Image files in memory: what becomes of their bytes is not the library's
// business, for it does not notice all that can go wrong with them.

#include <OpenImageIO/filesystem.h>

#include <cstring>

#include "common/image/openimageio.hpp"

namespace lightwalk::openimageio {
namespace {

/// Where the library writes a file to: memory.
class Bytes final : public OIIO::Filesystem::IOProxy {
 public:
  /// `most` bytes are expected. If the memory is short this throws, here and
  /// not in the middle of a library that is written in C.
  Bytes(std::string& bytes, std::size_t most)
      : IOProxy("", Write), bytes_(bytes) {
    bytes.clear();
    bytes.reserve(most);
  }
  const char* proxytype() const override { return "bytes"; }
  std::size_t write(const void* data, std::size_t size) override {
    const std::size_t written = pwrite(data, size, m_pos);
    m_pos += static_cast<std::int64_t>(written);
    return written;
  }
  std::size_t pwrite(const void* data, std::size_t size,
                     std::int64_t offset) override {
    const auto at = static_cast<std::size_t>(offset);
    if (bytes_.size() < at + size) bytes_.resize(at + size);
    std::memcpy(bytes_.data() + at, data, size);
    return size;
  }
  std::size_t size() const override { return bytes_.size(); }

 private:
  std::string& bytes_;
};

}  // namespace

std::string encode(const std::string& format, const ImageSpec& spec,
                   const float* pixels, std::string& bytes) {
  std::unique_ptr<ImageOutput> out = ImageOutput::create(format);
  if (!out) return reason(OIIO::geterror(), "the format is not supported");
  // What does not get smaller is stored as it is, with a few bytes a row.
  const std::size_t most = spec.image_bytes() + spec.image_bytes() / 100 +
                           static_cast<std::size_t>(spec.height) * 64 + 65536;
  Bytes file(bytes, most);
  if (!out->set_ioproxy(&file)) {
    return "the image library cannot encode in memory";
  }
  if (!out->open("image." + format, spec)) {
    return reason(out->geterror(), "open failed");
  }
  if (!out->write_image(TypeDesc::FLOAT, pixels)) {
    return reason(out->geterror(), "write failed");
  }
  return out->close() ? "" : reason(out->geterror(), "close failed");
}

}  // namespace lightwalk::openimageio
