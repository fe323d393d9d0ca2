#pragma once

// # Whose noise is believed?
//
// Two pictures are the same if their noise explains the difference, and each
// file says how noisy its picture is. A file that claims too much noise would
// be the same as anything: a black one with a variance of a million.
//
// But noise shows. If both pictures are right, pixel by pixel,
//
// $$\sum (a - b)^2 \approx
// \sum \left(\frac{v_a}{n_a} + \frac{v_b}{n_b}\right)$$
//
// and if one of them is wrong, the left side is larger. It is never much
// smaller, unless a file claims a variance that its pixels do not have. So
// the picture that claims more than the other must show it, in the image and
// in every large tile. A claim of more than four times what is shown is
// refused; a smaller claim costs a comparison at most half of its z.
//
// The sum says nothing if a few pixels have all of it: one bright path that
// came once, as it should, is a large variance and no difference. So only
// regions in which many pixels share the variance are judged.

#include <algorithm>
#include <cmath>
#include <optional>

#include "compare/comparison.hpp"

namespace lightwalk {

/// One picture claims more noise than its pixels show.
struct FalseClaim {
  bool by_test = true;  ///< or by the reference
  Region region{};
  double times = 0;  ///< as much noise as the other, in variance of the mean
  double shown = 0;  ///< the share of the claim that is seen
};

/// What two pictures claim in a region, and what they show.
struct Claims {
  double test = 0, reference = 0;  ///< sums of variances of pixels' means
  double shown = 0;                ///< sum of squared differences
  double sharing = 0;              ///< how many values share the claim
};

inline Claims claims_of(const RenderResult& test,
                        const RenderResult& reference, const Region& region) {
  Claims claims;
  double squares = 0;
  for (int y = region.top; y < region.top + region.height; ++y) {
    for (int x = region.left; x < region.left + region.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double a = static_cast<double>(test.variance.at(x, y)[c]) /
                         test.info.samples_per_pixel;
        const double b = static_cast<double>(reference.variance.at(x, y)[c]) /
                         reference.info.samples_per_pixel;
        const double difference =
            static_cast<double>(test.radiance.at(x, y)[c]) -
            static_cast<double>(reference.radiance.at(x, y)[c]);
        claims.test += a;
        claims.reference += b;
        claims.shown += difference * difference;
        squares += (a + b) * (a + b);
      }
    }
  }
  const double sum = claims.test + claims.reference;
  // The channels of a pixel are correlated: the three count as one.
  claims.sharing = squares > 0 ? sum * sum / squares / 3 : 0;
  return claims;
}

/// The first claim that cannot be believed, if there is one. Both pictures
/// must have variances and counts of samples.
inline std::optional<FalseClaim> false_claim(const RenderResult& test,
                                             const RenderResult& reference,
                                             int scale) {
  constexpr double fair = 2, least_shown = 0.25, least_sharing = 48;
  const Image& image = reference.radiance;
  for (const Region& region : regions_of(image.width, image.height, scale)) {
    if (region.width * region.height < least_sharing) continue;
    const Claims claims = claims_of(test, reference, region);
    if (claims.sharing < least_sharing) continue;
    const double sum = claims.test + claims.reference;
    if (claims.shown >= least_shown * sum) continue;
    const double larger = std::max(claims.test, claims.reference);
    const double smaller = std::min(claims.test, claims.reference);
    if (larger <= fair * smaller) continue;
    return FalseClaim{claims.test > claims.reference, region,
                      larger / smaller, claims.shown / sum};
  }
  return std::nullopt;
}

}  // namespace lightwalk
