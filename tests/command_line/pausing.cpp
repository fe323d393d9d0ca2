// A program like those of the stages. It waits in the middle of its picture, so
// that a signal comes just then. At sample number PAUSE_AT it prints a line on
// stdout, and waits for a line on stdin.

#include <atomic>
#include <cstdio>
#include <cstdlib>

#include "common/program/run.hpp"

namespace {

struct Pausing {
  Pausing(const lightwalk::Scene&, const lightwalk::RenderSettings&) {}

  lightwalk::Vec3 radiance(const lightwalk::Ray&,
                           lightwalk::Random& random) const {
    static const char* const number = std::getenv("PAUSE_AT");
    static const long pause_at = number ? std::atol(number) : -1;
    static std::atomic<long> samples{0};
    if (samples++ == pause_at) {
      std::puts("paused");
      std::fflush(stdout);
      std::getchar();
    }
    return lightwalk::Vec3(random.uniform());
  }
};

}  // namespace

int main(int argc, char** argv) {
  return lightwalk::run<Pausing>(argc, argv,
                                 {.name = "pausing", .syllabus = {9, {}}});
}
