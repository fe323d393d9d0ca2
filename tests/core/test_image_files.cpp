// Images in files, above all those of the image library: EXR and PNG.

#include <doctest/doctest.h>

#include <cstring>
#include <string>
#ifndef _WIN32
#include <sys/resource.h>

#include <csignal>
#endif

#include "common/image_file.hpp"
#include "tests/core/largest_allocation.hpp"
#include "tests/core/temporary_folder.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;
namespace fs = std::filesystem;

namespace {

/// A small picture with light beyond 1, and all that is said about it.
RenderResult picture(int width = 7, int height = 5) {
  RenderResult result;
  result.radiance = Image(width, height);
  result.variance = Image(width, height);
  Random random(1, 0, 0);
  for (Vec3& pixel : result.radiance.pixels) {
    pixel = {random.uniform(), 10 * random.uniform(), 1e-4f};
  }
  for (Vec3& pixel : result.variance.pixels) {
    pixel = {random.uniform(), 0, 1e6f * random.uniform()};
  }
  result.info.stage = "stage3";
  result.info.samples_per_pixel = 4096;
  result.info.seed = 18446744073709551615u;
  result.info.max_bounces = 8;
  result.info.scene_sha256 = std::string(64, 'a');
  result.info.rays = 9007199254740993u;  // 2^53 + 1: no double holds it
  result.info.dropped = 12345678901u;
  result.info.version = "1.2.3";
  return result;
}

bool same_bits(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height &&
         std::memcmp(a.pixels.data(), b.pixels.data(),
                     a.pixels.size() * sizeof(Vec3)) == 0;
}

/// What is said when an image cannot be read; "" if it can.
std::string read_complaint(const std::string& path) {
  try {
    read_image(path);
    return "";
  } catch (const ImageError& error) {
    return error.what();
  }
}

/// Why a failed write failed; "" if it worked.
std::string write_complaint(const std::string& path,
                            const RenderResult& result) {
  try {
    write_image(path, result, {});
    return "";
  } catch (const ImageError& error) {
    return error.what();
  }
}

#ifndef _WIN32
/// While it lives, no file of this program grows beyond some bytes.
class FullDisk {
 public:
  explicit FullDisk(std::size_t bytes) : handler_(signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};
#endif

constexpr const char* endings[] = {".exr", ".png", ".pfm", ".ppm"};

}  // namespace

TEST_CASE("an EXR file gives back radiance and variance to the last bit") {
  const TemporaryFolder folder;
  const RenderResult written = picture();
  write_image(folder / "a.exr", written, {});
  const RenderResult read = read_image(folder / "a.exr");
  CHECK(same_bits(read.radiance, written.radiance));
  CHECK(same_bits(read.variance, written.variance));
}

TEST_CASE("an EXR file gives back everything that is said about the picture") {
  const TemporaryFolder folder;
  const RenderInfo written = picture().info;
  write_image(folder / "a.exr", picture(), {});
  const RenderInfo read = read_image(folder / "a.exr").info;
  CHECK(read.stage == written.stage);
  CHECK(read.samples_per_pixel == written.samples_per_pixel);
  CHECK(read.seed == written.seed);
  CHECK(read.max_bounces == written.max_bounces);
  CHECK(read.scene_sha256 == written.scene_sha256);
  CHECK(read.rays == written.rays);
  CHECK(read.dropped == written.dropped);
  CHECK(read.version == written.version);
}

// The names are in the file's headers, each as text after its attribute's
// name, type and length.
TEST_CASE("the two parts of an EXR file are named radiance and variance") {
  const TemporaryFolder folder;
  write_image(folder / "a.exr", picture(), {});
  const std::string bytes = bytes_of(folder / "a.exr");
  const auto name = [](const std::string& value) {
    return std::string("name\0string\0\x08\0\0\0", 16) + value;
  };
  const std::size_t first = bytes.find(name("radiance"));
  const std::size_t second = bytes.find(name("variance"));
  CHECK(first != std::string::npos);
  CHECK(second != std::string::npos);
  CHECK(first < second);
}

TEST_CASE("equal renders are equal files") {
  const TemporaryFolder folder;
  for (const std::string ending : endings) {
    write_image(folder / ("a" + ending), picture(), {});
    write_image(folder / ("b" + ending), picture(), {});
    CAPTURE(ending);
    CHECK(bytes_of(folder / ("a" + ending)).size() > 50);
    const bool equal = bytes_of(folder / ("a" + ending)) ==
                       bytes_of(folder / ("b" + ending));
    CHECK(equal);
  }
}

TEST_CASE("a picture without variance is written without it") {
  const TemporaryFolder folder;
  RenderResult plain = picture();
  plain.variance = Image();
  CHECK(write_complaint(folder / "a.exr", plain) == "");
  const RenderResult read = read_image(folder / "a.exr");
  CHECK(same_bits(read.radiance, plain.radiance));
  CHECK(read.variance.pixels.empty());
  CHECK(read.info.seed == plain.info.seed);
}

TEST_CASE("a PNG file shows the tone-mapped image, to an 8-bit step") {
  const TemporaryFolder folder;
  const ToneMapping mapping{1, {ToneStep::reinhard, ToneStep::gamma}, 2.0f};
  write_image(folder / "a.png", picture(), mapping);
  const Image expected = tone_map(picture().radiance, mapping);
  const Image read = read_image(folder / "a.png").radiance;
  REQUIRE(read.width == expected.width);
  REQUIRE(read.height == expected.height);
  for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
    INFO(text(read.pixels[i]) << " for " << text(expected.pixels[i]));
    CHECK(max_abs_component(read.pixels[i] - expected.pixels[i]) <=
          0.501f / 255);
  }
}

TEST_CASE("PFM and PPM files hold linear radiance, not what is shown") {
  const TemporaryFolder folder;
  const RenderResult written = picture();
  write_image(folder / "a.pfm", written, {});
  write_image(folder / "a.ppm", written, {});
  CHECK(same_bits(read_image(folder / "a.pfm").radiance, written.radiance));
  const Image read = read_image(folder / "a.ppm").radiance;
  for (std::size_t i = 0; i < read.pixels.size(); ++i) {
    CHECK(max_abs_component(read.pixels[i] - written.radiance.pixels[i]) <=
          max_value(written.radiance) * 0.51f / 65535);
  }
}

TEST_CASE("the ending tells the format in capitals too") {
  const TemporaryFolder folder;
  write_image(folder / "A.PFM", picture(), {});
  CHECK(bytes_of(folder / "A.PFM").substr(0, 3) == "PF\n");
  CHECK(same_bits(read_image(folder / "A.PFM").radiance, picture().radiance));
}

TEST_CASE("files that are empty, cut off or text are refused with a reason") {
  const TemporaryFolder folder;
  for (const std::string ending : endings) {
    CAPTURE(ending);
    write_image(folder / ("good" + ending), picture(), {});
    const std::string good = bytes_of(folder / ("good" + ending));
    const std::string path = folder / ("broken" + ending);
    for (const std::size_t size : {std::size_t{0}, std::size_t{1},
                                   std::size_t{4}, good.size() / 4,
                                   good.size() / 2, good.size() * 3 / 4}) {
      store(path, good.substr(0, size));
      CAPTURE(size);
      CHECK(read_complaint(path) != "");
    }
    store(path, "This is not an image, whatever its name says.\n");
    CHECK(read_complaint(path) != "");
  }
  CHECK(read_complaint(folder / "none.exr") == "there is no such file");
  fs::create_directory(folder / "folder.exr");
  CHECK(read_complaint(folder / "folder.exr") == "it is not a file");
  store(folder / "a.gif", "GIF89a");
  CHECK(read_complaint(folder / "a.gif") ==
        "its name ends in none of .exr, .png, .pfm, .ppm");
}

// The data window of the first part, made a million pixels wide and high.
TEST_CASE("an EXR header that claims too much is refused, not allocated") {
  const TemporaryFolder folder;
  const std::string path = folder / "a.exr";
  write_image(path, picture(), {});
  std::string bytes = bytes_of(path);
  for (const std::string name : {"dataWindow", "displayWindow"}) {
    const std::size_t at = bytes.find(name + '\0' + "box2i");
    REQUIRE(at != std::string::npos);
    const std::size_t corner = at + name.size() + 1 + 6 + 4 + 8;
    bytes.replace(corner, 8, std::string("\x3f\x42\x0f\0\x3f\x42\x0f\0", 8));
  }
  store(path, bytes);
  largest_allocation = 0;
  CHECK(read_complaint(path) != "");
  CHECK(largest_allocation < 100'000'000);
}

#ifndef _WIN32
// A full disk, simulated: no file may grow beyond some bytes. With one byte
// too few it is the very last write that fails, which libraries like to miss,
// and of a small file it is the only one.
TEST_CASE("a full disk leaves the old image and nothing unfinished") {
  const TemporaryFolder folder;
  for (const int size : {4, 60}) {
    const RenderResult result = picture(size, size);
    for (const std::string ending : endings) {
      const std::string path = folder / ("a" + ending);
      write_image(path, result, {});
      const std::string whole = bytes_of(path);
      store(path, "the old image");
      for (const std::size_t room : {std::size_t{0}, std::size_t{10},
                                     whole.size() / 2, whole.size() - 1}) {
        std::string why;
        {
          const FullDisk full(room);
          why = write_complaint(path, result);
        }
        CAPTURE(size);
        CAPTURE(ending);
        CAPTURE(room);
        CHECK(why != "");
        CHECK(bytes_of(path) == "the old image");
        CHECK_FALSE(fs::exists(unfinished_name(path)));
      }
      {
        const FullDisk just_enough(whole.size());
        write_image(path, result, {});
      }
      const bool same = bytes_of(path) == whole;
      CHECK(same);
    }
  }
  CHECK(folder.entries() == 4);
}
#endif

TEST_CASE("a write into a folder that is not there fails with a reason") {
  const TemporaryFolder folder;
  for (const std::string ending : endings) {
    CAPTURE(ending);
    CHECK(write_complaint(folder / ("none/a" + ending), picture()) != "");
  }
  CHECK(folder.entries() == 0);
}

TEST_CASE("a new image replaces the old one, and nothing else is left") {
  const TemporaryFolder folder;
  for (const std::string ending : endings) {
    const std::string path = folder / ("a" + ending);
    store(path, "the old image");
    write_image(path, picture(), {});
    CAPTURE(ending);
    CHECK(read_complaint(path) == "");
  }
  CHECK(folder.entries() == 4);
}
