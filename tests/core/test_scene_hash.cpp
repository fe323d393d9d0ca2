// The values that the authors of FNV publish, and the hash of a scene.

#include <doctest/doctest.h>

#include <string>

#include "common/scene_file/loaded_scene.hpp"

using lightwalk::fnv_1a;

TEST_CASE("a scene's hash is FNV-1a of all its bytes") {
  CHECK(fnv_1a("") == "cbf29ce484222325");
  CHECK(fnv_1a("a") == "af63dc4c8601ec8c");
  CHECK(fnv_1a("foobar") == "85944171f73967e8");
  CHECK(fnv_1a(std::string("a\0", 2)) != fnv_1a("a"));
  CHECK(fnv_1a("\xff") == "af64724c8602eb6e");
}
