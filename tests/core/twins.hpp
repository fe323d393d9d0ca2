#pragma once

#include "common/geometry/geometry.hpp"

namespace lightwalk::tests {

/// The same shapes twice: searched one by one, and in a tree.
struct Twins {
  Geometry plain, prepared;

  template <class Shape>
  void add(const Shape& shape) {
    plain.add(shape);
    prepared.add(shape);
  }
};

}  // namespace lightwalk::tests
