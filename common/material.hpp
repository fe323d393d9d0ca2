#pragma once

// # Materials
//
// A material is four coefficients, each a colour, as on the slide "Material
// coefficients". What they mean for light, the stages say.

#include "common/pattern.hpp"
#include "common/vector.hpp"

namespace lightwalk {

struct Material {
  Vec3 kd{0};        ///< diffuse reflectance, 0 to 1
  Vec3 ks{0};        ///< perfect specular reflectance, 0 to 1
  Vec3 kt{0};        ///< perfect refraction (transmittance), 0 to 1
  Vec3 ke{0};        ///< emitted radiance, W/(m^2 sr), on the normal's side
  float eta = 1.5f;  ///< index of refraction inside; outside is 1
  bool fresnel = false;  ///< ks and kt are shared out by Fresnel's equations

  /// Where a coefficient is not the same everywhere; null where it is.
  const Pattern* kd_pattern = nullptr;
  const Pattern* ks_pattern = nullptr;
  const Pattern* kt_pattern = nullptr;

  /// An emitter neither reflects nor refracts: a path ends at it.
  bool emits() const { return !is_black(ke); }
};

}  // namespace lightwalk
