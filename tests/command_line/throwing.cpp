// A program like those of the stages. Its samples throw; the seed selects what.

#include <new>
#include <stdexcept>

#include "common/program/run.hpp"

namespace {

struct Throwing {
  std::uint64_t seed;

  Throwing(const lightwalk::Scene&, const lightwalk::RenderSettings& settings)
      : seed(settings.seed) {}

  lightwalk::Vec3 radiance(const lightwalk::Ray&,
                           lightwalk::Random& random) const {
    if (random.uniform() < 0.99f) return lightwalk::Vec3(1);
    if (seed == 1) throw std::runtime_error("a pixel\nis wrong");
    if (seed == 2) throw std::bad_alloc();
    throw 3;
  }
};

}  // namespace

int main(int argc, char** argv) {
  return lightwalk::run<Throwing>(argc, argv,
                                  {.name = "throwing", .syllabus = {9, {}}});
}
