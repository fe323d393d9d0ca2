#pragma once

// # The materials that many paths meet

#include <vector>

#include "common/scene/material.hpp"
#include "stages/6_many_paths/rows/column.hpp"

#ifdef LIGHTWALK_ROWS

namespace lightwalk {

/// The material that each lane has met.
struct Materials {
  Vec3s kd, ks, kt;
  Floats eta;
  Mask emits, fresnel;
  Mask varies;  ///< where a coefficient is not the same everywhere
};

class MaterialTable {
 public:
  explicit MaterialTable(const std::vector<const Material*>& materials) {
    for (const Material* material : materials) add(*material);
    if (materials.empty()) add({});  // for paths that meet nothing
  }

  HWY_INLINE Materials at(const Ints& line) const {
    const Ints flags = flags_.at(line);
    const auto is = [&](std::int32_t flag)
                        HWY_ATTR { return (flags & Ints(flag)) != Ints(0); };
    return {.kd = kd_.at(line),
            .ks = ks_.at(line),
            .kt = kt_.at(line),
            .eta = eta_.at(line),
            .emits = is(emits),
            .fresnel = is(fresnel),
            .varies = is(varies)};
  }
  /// Radiance on the normal's side.
  HWY_INLINE Vec3s ke(const Ints& line) const { return ke_.at(line); }

 private:
  enum Flag : std::int32_t { emits = 1, fresnel = 2, varies = 4 };

  void add(const Material& m) {
    kd_.push_back(m.kd);
    ks_.push_back(m.ks);
    kt_.push_back(m.kt);
    ke_.push_back(m.ke);
    eta_.push_back(m.eta);
    flags_.push_back(
        (m.emits() ? emits : 0) | (m.fresnel ? fresnel : 0) |
        (m.varying_kd || m.varying_ks || m.varying_kt ? varies : 0));
  }

  Vec3Column kd_, ks_, kt_, ke_;
  Column<float> eta_;
  Column<std::int32_t> flags_;
};

}  // namespace lightwalk

#endif
