// PFM and PPM, the two formats that the core writes by hand.

#include <doctest/doctest.h>

#include <cstring>
#include <string>

#include "common/image/pfm.hpp"
#include "common/image/ppm.hpp"
#include "tests/core/largest_allocation.hpp"
#include "tests/core/vectors.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

Image random_image(int width, int height, float largest) {
  Image image(width, height);
  Random random(1, 0, 0);
  for (Vec3& pixel : image.pixels) {
    pixel = {random.uniform(), random.uniform(), random.uniform()};
    pixel *= largest;
  }
  return image;
}

std::string floats(std::initializer_list<float> values) {
  std::string bytes;
  for (const float value : values) {
    char raw[4];
    std::memcpy(raw, &value, 4);
    bytes.append(raw, 4);
  }
  return bytes;
}

/// What the decoder says about broken bytes; "" if it accepts them.
template <class Decode, class Bytes>
std::string complaint(Decode decode, const Bytes& bytes) {
  largest_allocation = 0;
  std::string message;
  try {
    decode(bytes);
  } catch (const FileError& error) {
    message = error.what();
  }
  const std::size_t largest = largest_allocation;
  CHECK(largest <= 4 * bytes.size() + 1000);
  return message;
}

std::string pfm_complaint(const std::string& bytes) {
  return complaint(decode_pfm, std::string_view(bytes));
}
std::string ppm_complaint(const std::string& bytes) {
  return complaint(decode_ppm, bytes);
}

bool contains(const std::string& text, const std::string& part) {
  INFO(text << "  --  " << part);
  const bool found = text.find(part) != std::string::npos;
  CHECK(found);
  return found;
}

/// The course's own example of a plain PPM file.
const std::string feep =
    "P3\n# feep.ppm\n#MAX=2.5\n4 4\n15\n"
    " 0  0  0    0  0  0    0  0  0   15  0 15\n"
    " 0  0  0    0 15  7    0  0  0    0  0  0\n"
    " 0  0  0    0  0  0    0 15  7    0  0  0\n"
    "15  0 15    0  0  0    0  0  0    0  0  0\n";

}  // namespace

TEST_CASE("a PFM image comes back to the last bit") {
  Image image = random_image(5, 3, 1000);
  image.at(0, 0) = {0.0f, -0.0f, 1e-44f};
  image.at(4, 2) = {3e38f, infinity, -infinity};
  const Image back = decode_pfm(encode_pfm(image)).radiance;
  REQUIRE(back.width == 5);
  REQUIRE(back.height == 3);
  CHECK(std::memcmp(back.pixels.data(), image.pixels.data(),
                    5 * 3 * sizeof(Vec3)) == 0);
}

TEST_CASE("a PFM file begins with its bottom row") {
  Image image(1, 2);
  image.at(0, 0) = {1, 2, 3};
  image.at(0, 1) = {4, 5, 6};
  CHECK(encode_pfm(image) == "PF\n1 2\n-1.0\n" + floats({4, 5, 6, 1, 2, 3}));
}

TEST_CASE("PFM files of the other byte order and gray ones are read") {
  std::string big = floats({1.5f, -2, 1e-3f});
  for (std::size_t i = 0; i < big.size(); i += 4) {
    std::swap(big[i], big[i + 3]);
    std::swap(big[i + 1], big[i + 2]);
  }
  CHECK(decode_pfm("PF\n1 1\n1.0\n" + big).radiance.at(0, 0) ==
        Vec3(1.5f, -2, 1e-3f));

  const Image gray = decode_pfm("Pf 2 1 -1\n" + floats({0.25f, 7})).radiance;
  CHECK(gray.at(0, 0) == Vec3(0.25f));
  CHECK(gray.at(1, 0) == Vec3(7));
}

// The white space behind the scale is one character, or CR LF.
TEST_CASE("PFM headers may have blanks, and lines that end in CR LF") {
  const std::string pixels = floats({1.5f, 2, 3, 4, 5, 6});
  for (const char* header :
       {"PF\r\n2 1\r\n-1.0\r\n", "PF 2 1 -1 ", "PF\n\n2  1\n-1\r",
        "PF\n2 1\n-1\n", "PF\n# a comment\n2 1\n-1\n"}) {
    CAPTURE(header);
    for (const char* trailing : {"", "\n", "more"}) {
      const RenderResult read = decode_pfm(header + pixels + trailing);
      CHECK(read.radiance.at(0, 0) == Vec3(1.5f, 2, 3));
      CHECK(read.radiance.at(1, 0) == Vec3(4, 5, 6));
      CHECK(read.variance.pixels.empty());
    }
  }
}

// Nothing renders so much, but a file may say so.
TEST_CASE(
    "settings of a PFM file that are too large for us are our largest") {
  RenderResult written;
  written.radiance = written.variance = Image(1, 1);
  const std::string pixels = encode_pfm(written.radiance);
  for (const char* number : {"4294967295", "99999999999999999999", "-1"}) {
    CAPTURE(number);
    const std::string settings = std::string("# samples_per_pixel ") +
                                 number + "\n# max_bounces " + number + "\n";
    const RenderInfo info =
        decode_pfm(pixels + encode_pfm(written.variance, settings)).info;
    CHECK(info.samples_per_pixel == 4294967295.0);
    CHECK(info.max_bounces == 2147483647);
    CHECK(texts_of(info).at("samples_per_pixel") == "4294967295");
  }
}

TEST_CASE("behind the pixels a PFM file has the variance and its settings") {
  RenderResult written;
  written.radiance = random_image(3, 2, 1);
  written.variance = random_image(3, 2, 7);
  written.info.seed = 7;
  const std::string bytes = encode_pfm(written);
  // For other programs it is a plain PFM file.
  CHECK(bytes.starts_with(encode_pfm(written.radiance) + "PF\n# "));
  const RenderResult read = decode_pfm(bytes);
  CHECK(read.variance.pixels == written.variance.pixels);
  CHECK(read.info.seed == 7);
  const std::string other = encode_pfm(random_image(2, 3, 1), "# seed 7\n");
  contains(pfm_complaint(encode_pfm(written.radiance) + other),
           "its variance has another size than its picture");
  contains(pfm_complaint(bytes.substr(0, bytes.size() - 1)), "cut off");
}

TEST_CASE("broken PFM files are refused with the reason") {
  const std::string good = encode_pfm(random_image(4, 4, 1));
  for (std::size_t size = 0; size < good.size(); ++size) {
    CAPTURE(size);
    CHECK(pfm_complaint(good.substr(0, size)) != "");
  }
  contains(pfm_complaint(""), "not a PFM file");
  contains(pfm_complaint(good.substr(0, 100)), "cut off: 100 bytes");
  contains(pfm_complaint("P6\n1 1\n-1\n" + floats({1, 1, 1})), "not a PFM");
  contains(pfm_complaint("PF\nfour 4\n-1\n"), "not a PFM file");
  contains(pfm_complaint("PF\n1 1\n0\n" + floats({1, 1, 1})), "not a PFM");
  contains(pfm_complaint("PF\n1 1\nnan\n" + floats({1, 1, 1})), "not a PFM");
  contains(pfm_complaint("PF\n0 4\n-1\n"), "claims 0 x 4 pixels");
  contains(pfm_complaint("PF\n-4 4\n-1\n"), "claims -4 x 4 pixels");
  contains(pfm_complaint("PF\n65537 1\n-1\n"), "claims 65537 x 1 pixels");
  contains(pfm_complaint("PF\n16384 16384\n-1\n"), "cut off");
  contains(pfm_complaint("PF\n1000 1000\n-1\n"), "promises 12000016");
  contains(pfm_complaint("PF\n99999999999999999999 1\n-1\n"), "not a PFM");
}

// A stored number is off by at most half of MAX / 65535, and floats of about
// MAX have a rounding of 2^-24 MAX, twice.
TEST_CASE("a PPM image comes back within half a step of its numbers") {
  for (const float largest : {1e-6f, 0.3f, 1.0f, 17.25f, 1e9f}) {
    const Image image = random_image(7, 5, largest);
    const Image back = decode_ppm(encode_ppm(image)).radiance;
    REQUIRE(back.width == 7);
    REQUIRE(back.height == 5);
    float worst = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      worst = std::max(worst,
                       max_abs_component(back.pixels[i] - image.pixels[i]));
    }
    CAPTURE(largest);
    CHECK(worst <= max_value(image) * (0.5f / 65535 + 0x1p-22f));
    CHECK(max_value(back) == doctest::Approx(max_value(image)).epsilon(1e-6));
  }
}

TEST_CASE("a PPM file says in #MAX which value its largest number is") {
  Image image(2, 1);
  image.at(0, 0) = {0, 1.25f, 2.5f};
  image.at(1, 0) = {2.5f, 0, 0};
  CHECK(encode_ppm(image) ==
        "P3\n#MAX=2.5\n2 1\n65535\n0 32768 65535\t65535 0 0\n");
}

TEST_CASE("a black image is a PPM file too") {
  const Image back = decode_ppm(encode_ppm(Image(3, 2))).radiance;
  CHECK(back.width == 3);
  for (const Vec3& pixel : back.pixels) CHECK(pixel == Vec3(0));
}

// 7 of 15 at MAX = 2.5 is 1.1667.
TEST_CASE("the course's example of a PPM file is read correctly") {
  const Image image = decode_ppm(feep).radiance;
  REQUIRE(image.width == 4);
  REQUIRE(image.height == 4);
  CHECK(image.at(3, 0) == Vec3(2.5f, 0, 2.5f));
  CHECK(image.at(1, 1) == Near{{0, 2.5f, 2.5f * 7 / 15}, 1e-6f});
  CHECK(image.at(2, 2) == image.at(1, 1));
  CHECK(image.at(0, 3) == image.at(3, 0));
  CHECK(image.at(0, 0) == Vec3(0));
}

TEST_CASE("PPM files are read however they are laid out") {
  CHECK(decode_ppm("P3 1 1 255 255 0 51").radiance.at(0, 0) ==
        Near{{1, 0, 0.2f}, 1e-7f});
  CHECK(decode_ppm("P3\r\n#MAX=4\r\n1 1\r\n100\r\n25\r\n50\r\n100\r\n")
            .radiance.at(0, 0) == Vec3(1, 2, 4));
  CHECK(decode_ppm("P3\n1 # wide\n1#high\n2\n#\n0 1 # half\n2#end")
            .radiance.at(0, 0) == Vec3(0, 0.5f, 1));
  CHECK(decode_ppm("P3\n#MAX=1e-3\n1 1\n1\n1 1 0").radiance.at(0, 0) ==
        Vec3(1e-3f, 1e-3f, 0));
}

TEST_CASE("#MAX is read however its letters and blanks are") {
  for (const char* comment :
       {"#MAX=2.5", "# MAX=2.5", "#max=2.5", "#MAX =2.5", "# Max = 2.5 ",
        "#\tMAX\t=\t2.5\t", "#MAX=2.5\r"}) {
    CAPTURE(comment);
    const std::string text =
        std::string("P3\n") + comment + "\n1 1\n255\n255 0 51\n";
    const RenderResult read = decode_ppm(text);
    CHECK(read.radiance.at(0, 0) == Near{{2.5f, 0, 0.5f}, 1e-6f});
    CHECK(read.note == "");
  }
}

TEST_CASE("a #MAX that is broken is refused, other comments are not") {
  const auto with_comment = [](const std::string& comment) {
    return ppm_complaint("P3\n" + comment + "\n1 1\n255\n255 0 51\n");
  };
  contains(with_comment("#MAX=2.5\n#MAX=3"), "'#MAX=3' is its second");
  contains(with_comment("#MAX=2,5"), "does not give a number above 0");
  for (const char* comment : {"# maximum of the scene", "# Max Planck",
                              "# maxval = 255", "#", "# the max = 3"}) {
    CHECK(with_comment(comment) == "");
  }
  for (const char* late :
       {"P3 1 1 1 1 #MAX=2\n1 1", "P3 1 1 1 1 1 1 #MAX=2"}) {
    contains(ppm_complaint(late), "'#MAX=2' comes after the first pixel");
  }
  CHECK(decode_ppm("P3 1 1 1 1 1 1").note ==
        "has no comment #MAX=, so its largest number is taken to be 1");
}

TEST_CASE("broken PPM files are refused with the reason") {
  const std::size_t last_digit = feep.find_last_of("0");
  for (std::size_t size = 0; size < last_digit; ++size) {
    CAPTURE(size);
    CHECK(ppm_complaint(feep.substr(0, size)) != "");
  }
  contains(ppm_complaint(""), "not a plain PPM");
  contains(ppm_complaint("P6\n1 1\n255\n..."), "not a plain PPM");
  contains(ppm_complaint("P3"), "cut off: its width is missing");
  contains(ppm_complaint("P3 4 4 15 0 0 0"), "cut off");
  contains(ppm_complaint("P3 four 4 15"), "its width is 'four'");
  contains(ppm_complaint("P3 4 4.5 15"), "its height is '4.5'");
  contains(ppm_complaint("P3 0 4 15"), "claims 0 x 4 pixels");
  contains(ppm_complaint("P3 -1 4 15"), "claims -1 x 4 pixels");
  contains(ppm_complaint("P3 65537 1 15 0"), "claims 65537 x 1 pixels");
  contains(ppm_complaint("P3 16384 16384 15 0"), "cut off");
  contains(ppm_complaint("P3 1000 1000 15 0"), "cut off: 17 bytes cannot");
  contains(ppm_complaint("P3 99999999999999999999 1 1 0"), "its width is");
  contains(ppm_complaint("P3 1 1 0 0 0 0"), "color resolution is 0");
  contains(ppm_complaint("P3 1 1 -5 0 0 0"), "color resolution is -5");
  contains(ppm_complaint("P3 1 1 15 0 16 0"),
           "a pixel is 16, outside 0 to 15");
  contains(ppm_complaint("P3 1 1 15 0 -1 0"), "a pixel is -1, outside");
  contains(ppm_complaint("P3 1 1 15 0 x 0"), "a pixel is 'x'");
  contains(ppm_complaint("P3 1 1 15 0 0"), "cut off: a pixel is missing");
  for (const char* max : {"0", "-1", "nan", "inf", "1e999", "", "light"}) {
    const std::string comment = std::string("#MAX=") + max;
    contains(ppm_complaint("P3\n" + comment + "\n1 1\n1\n1 1 1\n"),
             "'" + comment + "' does not give a number above 0");
  }
}
