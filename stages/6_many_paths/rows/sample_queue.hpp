#pragma once

// # The samples of a tile, in a queue
//
// Lanes take them one after the other. Their first rays are made for all
// lanes together.

#include <cstdint>

#include "common/render/render.hpp"
#include "stages/6_many_paths/rows/hit_row.hpp"
#include "stages/6_many_paths/rows/random_row.hpp"

#ifdef LIGHTWALK_ROWS

namespace lightwalk {

/// Pixel by pixel, and in each pixel sample by sample.
class SampleQueue {
 public:
  SampleQueue(const Tile& tile, const Camera& camera, std::uint64_t seed)
      : tile_(tile), camera_(camera), seed_(seed) {}

  std::size_t size() const {
    return static_cast<std::size_t>(tile_.right - tile_.left) *
           static_cast<std::size_t>(tile_.bottom - tile_.top) *
           (tile_.last - tile_.first);
  }
  bool empty() const { return taken_ == size(); }

  /// Gives a lane the direction and the random numbers of the next sample's
  /// path, and says which sample it is.
  std::size_t take(Vec3s& direction, Randoms& random, int lane) {
    const int next = static_cast<int>(taken_ % row_lanes);
    if (next == 0) prepare();
    direction.set(lane, directions_[next]);
    random.set(lane, random_[next]);
    return taken_++;
  }

  /// Adds the radiance of all samples, in their order.
  void add_to(Film& film, const Vec3* radiance) const {
    const Vec3* next = radiance;
    for (int row = tile_.top; row < tile_.bottom; ++row) {
      for (int column = tile_.left; column < tile_.right; ++column) {
        Pixel pixel = film.pixel(column, row);
        for (std::uint32_t i = tile_.first; i < tile_.last; ++i) {
          pixel.add(*next++);
        }
        film.pixel(column, row) = pixel;
      }
    }
  }

 private:
  void prepare() {
    Floats column, row;
    Bits pixel, sample;
    for (int lane = 0; lane < row_lanes; ++lane) {
      column.set(lane, static_cast<float>(column_));
      row.set(lane, static_cast<float>(row_));
      pixel.set(lane, pixel_index(camera_.width, column_, row_));
      sample.set(lane, sample_);
      advance();
    }
    random_ = Randoms(seed_, pixel, sample);
    const Vec2s u = random_.uniform_2d(!no_lanes());
    directions_ = camera_.direction<Vec3s>(column + u.x, row + u.y);
  }

  void advance() {
    if (++sample_ < tile_.last) return;
    sample_ = tile_.first;
    if (++column_ < tile_.right) return;
    column_ = tile_.left;
    if (++row_ == tile_.bottom) row_ = tile_.top;  // these are not used
  }

  const Tile& tile_;
  const Camera& camera_;
  std::uint64_t seed_;
  std::size_t taken_ = 0;
  int column_ = tile_.left, row_ = tile_.top;
  std::uint32_t sample_ = tile_.first;
  Vec3s directions_;
  Randoms random_;
};

}  // namespace lightwalk

#endif
