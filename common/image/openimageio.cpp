// The functions of the image library that programs load: the core's compiled
// files, since OpenImageIO's header takes seconds and its libraries a second
// to load.

#include "common/image/openimageio.hpp"

#ifndef _WIN32
#include <fcntl.h>
#include <unistd.h>
#endif

namespace {

using lightwalk::Image;
using lightwalk::RenderResult;
using lightwalk::Texture;
using namespace lightwalk::openimageio;

/// libpng prints its errors itself, beside those that it returns. While one
/// of these lives, nobody prints to stderr.
class QuietStderr {
 public:
#ifndef _WIN32
  QuietStderr() : kept_(dup(STDERR_FILENO)) {
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) {
      dup2(nowhere, STDERR_FILENO);
      close(nowhere);
    }
  }
  ~QuietStderr() {
    if (kept_ >= 0) {
      dup2(kept_, STDERR_FILENO);
      close(kept_);
    }
  }
  QuietStderr(const QuietStderr&) = delete;
  QuietStderr& operator=(const QuietStderr&) = delete;

 private:
  int kept_;
#endif
};

/// No exception crosses the border between the library and the program.
template <auto function, class... Arguments>
std::string guarded(Arguments... arguments) {
  try {
    const QuietStderr quiet;
    return function(arguments...);
  } catch (const std::bad_alloc&) {
    return "there is not enough memory for it";
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace

#ifdef _WIN32
#define LIGHTWALK_EXPORT __declspec(dllexport)
#else
#define LIGHTWALK_EXPORT __attribute__((visibility("default")))
#endif

extern "C" LIGHTWALK_EXPORT const lightwalk::ImageCodecs*
lightwalk_image_codecs();

const lightwalk::ImageCodecs* lightwalk_image_codecs() {
  static const lightwalk::ImageCodecs library = {
      guarded<encode_exr, const RenderResult&, std::string&>,
      guarded<encode_png, const Image&, float, std::string&>,
      guarded<read_exr, const std::string&, RenderResult&>,
      guarded<read_png, const std::string&, Image&>,
      guarded<read_texture, const std::string&, Texture&>};
  return &library;
}
