// The functions that programs load where OpenImageIO is not there.

#include "common/image/small_images.hpp"

#include <exception>
#include <new>

namespace {

using namespace lightwalk;

/// No exception crosses the border between the library and the program.
template <auto function, class... Arguments>
std::string guarded(Arguments... arguments) {
  try {
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

extern "C" LIGHTWALK_EXPORT const ImageCodecs* lightwalk_image_codecs();

const ImageCodecs* lightwalk_image_codecs() {
  using namespace lightwalk::small_images;
  static const ImageCodecs library = {
      guarded<encode_exr, const RenderResult&, std::string&>,
      guarded<encode_png, const Image&, float, std::string&>,
      guarded<read_exr, const std::string&, RenderResult&>,
      guarded<read_png, const std::string&, Image&>,
      guarded<read_texture, const std::string&, Texture&>};
  return &library;
}
