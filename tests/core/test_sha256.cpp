// The examples of FIPS 180-2, appendix B, and lengths around the padding.

#include <doctest/doctest.h>

#include "common/scene_file/sha256.hpp"

using lightwalk::sha256;

TEST_CASE("the fingerprint of nothing is the well-known one") {
  CHECK(sha256("") ==
        "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST_CASE("fingerprints of one, two and many blocks are the standard's") {
  CHECK(sha256("abc") ==
        "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(sha256(std::string(1000000, 'a')) ==
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

// The length takes 8 bytes and the mark 1, so from 56 bytes on a second block
// is needed. Expected values are those of coreutils' sha256sum.
TEST_CASE("fingerprints are right where the padding fills or opens a block") {
  const auto of = [](std::size_t n) { return sha256(std::string(n, 'a')); };
  CHECK(of(55) ==
        "9f4390f8d30c2dd92ec9f095b65e2b9ae9b0a925a5258e241c9f1e910f734318");
  CHECK(of(56) ==
        "b35439a4ac6f0948b6d6f9e3c6af0f5f590ce20f1bde7090ef7970686ec6738a");
  CHECK(of(63) ==
        "7d3e74a05d7db15bce4ad9ec0658ea98e3f06eeecf16b4c6fff2da457ddc2f34");
  CHECK(of(64) ==
        "ffe054fe7ae0cb6dc65c3af9b61d5209f439851db43d0ba5997337df154668eb");
  CHECK(of(65) ==
        "635361c48bb9eab14198e76ea8ab7f1a41685d6ad62aa9146d301d4f17eb0ae0");
}

TEST_CASE("bytes beyond ASCII and zeros count like any other") {
  CHECK(sha256(std::string("\x80\xff\x00\x01", 4)) ==
        "f8bb6e5331d72e37f694fd42d0ee991cd1881b33d053806cee119b0e70372e66");
}
