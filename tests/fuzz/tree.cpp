// Many shapes, searched one by one and in a tree of boxes: the tree finds
// every hit that lies within its shape's box, and nothing else. A ray
// that grazes a flat shape may hit it beyond its edges, outside its box; there
// the tree may miss it. And the start of a box is rounded as a hit is, so of
// two hits at nearly the same distance either may be found.

#include "common/math/random.hpp"
#include "tests/core/twins.hpp"
#include "tests/fuzz/geometry.hpp"

using namespace lightwalk;
using namespace lightwalk::fuzz;
using lightwalk::tests::Twins;

namespace {

/// Some shapes from the bytes, and copies of each in a row or a cloud, so
/// that a few bytes make enough shapes for a tree.
template <class Shape, class Move>
void add_copies(Twins& twins, Numbers& numbers, Shape shape, Move move) {
  const Vec3 step = numbers.vector();
  const bool cloud = numbers.below(2) == 1;
  const int copies = numbers.below(48);
  Random random(static_cast<std::uint64_t>(copies), 0, 0);
  twins.add(shape);
  for (int i = 0; i < copies; ++i) {
    const Vec2 u = random.uniform_2d();
    move(shape, cloud ? step * Vec3(u.x, u.y, random.uniform()) : step);
    twins.add(shape);
  }
}

/// The box around the shape of a hit, enlarged by half as much as the tree's
/// boxes.
Bounds box_of(const Geometry& geometry, const Hit& hit) {
  const auto around = [&](const auto& shape) {
    Bounds box = bounds(shape);
    const float less = 0x1p-19f * std::max(max_abs_component(box.low),
                                           max_abs_component(box.high));
    return Bounds{box.low + less, box.high - less};
  };
  if (hit.shape_type == ShapeType::sphere) {
    return around(geometry.spheres()[hit.shape_index]);
  }
  return hit.shape_type == ShapeType::rectangle
             ? around(geometry.rectangles()[hit.shape_index])
             : around(geometry.triangles()[hit.shape_index]);
}

bool lies_in(const Bounds& box, const Vec3& place) {
  return glm::min(box.low, place) == box.low &&
         glm::max(box.high, place) == box.high;
}

/// Whether the tree may miss what the list finds.
bool may_be_missed(const Geometry& geometry, const Ray& ray, const Hit& hit) {
  return !lies_in(box_of(geometry, hit),
                  ray.origin + hit.distance * ray.direction);
}

constexpr float rounding = 0x1p-20f;

/// A copy is at most 48 steps of 128 away from a shape of that size.
constexpr float largest_coordinate = 50 * 128;

void check_ray(const Twins& twins, const Ray& ray) {
  const auto plain = twins.plain.nearest_hit(ray);
  const auto found = twins.prepared.nearest_hit(ray);
  if (found) {
    check_hit(ray, *found, largest_coordinate);
    expect(plain.has_value(), "a tree finds nothing that is not there");
    expect(found->distance >= plain->distance,
           "a tree finds nothing before the first hit");
  }
  const float first = plain ? plain->distance : infinity;
  const float last = first * (1 + rounding);
  expect(!twins.prepared.occluded(ray, first),
         "nothing is in front of the first hit");
  if (!plain || may_be_missed(twins.plain, ray, *plain)) return;
  expect(found && found->distance <= last, "a tree finds the first hit",
         text(plain->position) + " at " + std::to_string(first));
  expect(twins.prepared.occluded(ray, last),
         "a hit is in the way of what is behind it",
         text(plain->position) + " at " + std::to_string(first));
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Numbers numbers(data, size);
  Twins twins;
  const int groups = 2 + numbers.below(6);
  for (int i = 0; i < groups; ++i) {
    const auto move_flat = [](FlatShape& flat, const Vec3& step) {
      flat.corner += step;
    };
    switch (numbers.below(3)) {
      case 0:
        add_copies(twins, numbers, numbers.sphere(),
                   [](Sphere& one, const Vec3& step) { one.center += step; });
        break;
      case 1:
        add_copies(twins, numbers, numbers.flat<Rectangle>(), move_flat);
        break;
      default:
        add_copies(twins, numbers, numbers.flat<Triangle>(), move_flat);
    }
  }
  twins.prepared.prepare();
  for (int i = 0; i < 64 && !numbers.empty(); ++i) {
    const Vec3 origin = numbers.vector();
    check_ray(twins, {origin, numbers.direction()});
  }
  return 0;
}
