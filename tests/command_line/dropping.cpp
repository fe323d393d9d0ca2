// A program like those of the stages. One in a hundred samples is infinite.

#include "common/program/run.hpp"

namespace {

struct Dropping {
  Dropping(const lightwalk::Scene&, const lightwalk::RenderSettings&) {}

  lightwalk::Vec3 radiance(const lightwalk::Ray&,
                           lightwalk::Random& random) const {
    return lightwalk::Vec3(random.uniform() < 0.01f ? lightwalk::infinity
                                                    : 1);
  }
};

}  // namespace

int main(int argc, char** argv) {
  return lightwalk::run<Dropping>(argc, argv,
                                  {.name = "dropping", .syllabus = {9, {}}});
}
