// Tests that fail in all the ways in which a student's code can.
// test_runner.py runs one of them at a time; this suite is no test by itself.

#include <doctest/doctest.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "support/expectations.hpp"

using namespace lightwalk;
using namespace lightwalk::tests;

namespace {

// What the compiler must not optimize away.
volatile int zero = 0;
volatile int* volatile nowhere = nullptr;

int endless(int depth) {
  volatile char room[1000] = {};
  room[depth % 1000] = 1;
  return depth < 0 ? 0 : endless(depth + 1) + room[7];
}

}  // namespace

TEST_SUITE_BEGIN("units");

TEST_CASE("unit passes") {
  CHECK(zero == 0);
}
TEST_CASE("unit vector") {
  const Vec3 expected(1, 2, 3);
  CHECK(Vec3(0.1f, 0.2f, 0.3f) == expected);
}
TEST_CASE("unit sentence") {
  const char* const name = zero == 0 ? "a ball" : "a rectangle";
  CAPTURE(name);
  INFO(name, " is hit ", zero, " times, expected 1");
  CHECK(zero == 1);
}
TEST_CASE("unit factor") {
  check_value("f = kd/pi", 0.5, 0.5 / 3.14159265);
}
TEST_CASE("unit mean") {
  Pixel pixel;
  for (int i = 0; i < 10'000; ++i) pixel.add(Vec3(i % 2 == 0 ? 0.6f : 0.68f));
  check_mean("L = kd ke", pixel, 0, 0.64 * 2.25);
}
TEST_CASE("unit mean of nothing") {
  Pixel pixel;
  for (int i = 0; i < 10; ++i) pixel.add(Vec3(0));
  check_mean("L = kd ke", pixel, 0, 1);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("analytic scenes");

TEST_CASE("scene fails") {
  CAPTURE(zero);
  CHECK(zero == 1);
  CHECK(zero == 2);
}
TEST_CASE("scene fails again") {
  CHECK(zero == 3);
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("relations");

TEST_CASE("relation fails") {
  CHECK(zero == 4);
}
TEST_CASE("relation notes") {
  MESSAGE("box: its variance is 2.7 times the golden's");
}

TEST_SUITE_END();

TEST_SUITE_BEGIN("golden images");

TEST_CASE("golden fails") {
  FAIL_CHECK("the lamp is too dark");
}

TEST_CASE("ends exit") {
  std::exit(0);
}
TEST_CASE("ends _Exit") {
  std::_Exit(0);
}
TEST_CASE("ends quick_exit") {
  std::quick_exit(0);
}
TEST_CASE("ends abort") {
  std::abort();
}
TEST_CASE("ends segment") {
  *nowhere = 1;
}
TEST_CASE("ends division") {
  zero = 7 / zero;
}
TEST_CASE("ends recursion") {
  CHECK(endless(zero) == 1);
}
TEST_CASE("ends recursion in a thread") {
  std::thread([] { endless(zero); }).join();
}
TEST_CASE("ends exception") {
  CAPTURE(zero);
  throw std::runtime_error("no such thing");
}
TEST_CASE("ends exception in a subcase") {
  SUBCASE("the first") {
    CAPTURE(zero);
    throw std::runtime_error("no such thing");
  }
  SUBCASE("the second") {
    CHECK(zero == 0);
  }
}
TEST_CASE("ends assertion") {
  [[maybe_unused]] volatile float value = *std::optional<float>();
}
TEST_CASE("ends exception in a thread") {
  std::thread([] { throw std::runtime_error("nobody catches it"); }).join();
}
TEST_CASE("ends sleep") {
  std::this_thread::sleep_for(std::chrono::hours(1));
}
TEST_CASE("ends prints") {
  while (true) std::puts("a line of many");
}
TEST_CASE("ends checks") {
  while (zero == 0) CHECK(zero == 1);
}
TEST_CASE("ends forged") {
  std::puts("34 tests pass");
  std::puts("</TestCase></TestSuite></doctest>");
  std::exit(0);
}
TEST_CASE("ends child") {
  // One in the suite's own session, one in another.
  CHECK(std::system("sleep 1000 & setsid sleep 1000 &") == 0);
}
TEST_CASE("ends child and loop") {
  CHECK(std::system("sleep 1000 & setsid sleep 1000 &") == 0);
  while (zero == 0) {
  }
}
TEST_CASE("ends subcases") {
  for (int i = 0; i < 6; ++i) {
    SUBCASE(std::to_string(i).c_str()) {
      const std::clock_t start = std::clock();
      while (std::clock() < start + CLOCKS_PER_SEC / 10) {
      }
    }
  }
}
TEST_CASE("ends loop") {
  while (zero == 0) {
  }
}
TEST_CASE("ends lock") {
  std::timed_mutex lock;
  lock.lock();
  std::thread([&] { lock.try_lock_for(std::chrono::hours(1)); }).join();
}

TEST_SUITE_END();

// Before main, if the environment says so.
[[maybe_unused]] static const int before_main = [] {
  if (std::getenv("LIGHTWALK_EXIT_BEFORE_MAIN")) std::exit(0);
  return 0;
}();
