// PNG and JPEG files, as pictures and as textures: refused with a reason, or
// read whole. OpenImageIO, libpng and libjpeg are not instrumented, so this is
// about what we do before and after them, and about what they hand on.

#include "common/image/orientation.hpp"
#include "common/image/picture_file.hpp"
#include "tests/core/temporary_folder.hpp"
#include "tests/fuzz/codecs.hpp"
#include "tests/fuzz/limited_memory.hpp"

using namespace lightwalk;
using namespace lightwalk::fuzz;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const tests::TemporaryFolder folder;
  const std::string bytes = text_of(data, size);
  const PictureFile file = inspect_picture(bytes);
  expect(file.orientation >= 1 && file.orientation <= 8,
         "an orientation is one of eight", std::to_string(file.orientation));
  const bool is_jpeg = bytes.rfind("\xff\xd8", 0) == 0;
  const std::string path = folder / (is_jpeg ? "a.jpg" : "a.png");
  tests::store(path, bytes);

  const LimitedMemory limited;
  Texture texture;
  std::string error = lightwalk_image_codecs()->read_texture(path, texture);
  if (error.empty())
    check_pixels(texture.width, texture.height, texture.texels.size());
  expect(error.empty() || !file.error.empty() || !bytes.empty(),
         "an empty file is refused");
  expect(!error.empty() || file.error.empty(),
         "what inspection refuses is not read", file.error);

  Image image;
  const bool texture_was_read = error.empty();
  error = lightwalk_image_codecs()->read_png(path, image);
  // A picture may be larger than a texture, never smaller.
  expect(error.empty() || !texture_was_read, "a texture is a picture", error);
  if (!error.empty()) return 0;
  check_pixels(image.width, image.height, image.pixels.size());
  for (const Vec3& pixel : image.pixels) {
    for (int c = 0; c < 3; ++c) {
      expect(pixel[c] >= 0 && pixel[c] <= 1, "a value is from 0 to 1",
             text(pixel));
    }
  }
  return 0;
}
