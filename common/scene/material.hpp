#pragma once

// # Materials
//
// A material is four coefficients, each a color, as on the slide "Material
// coefficients". The stages say what they mean for light.

#include "common/math/vector.hpp"
#include "common/scene/varying_coefficient.hpp"

namespace lightwalk {

struct Material {
  Vec3 kd{0};        ///< diffuse reflectance, 0 to 1
  Vec3 ks{0};        ///< perfect specular reflectance, 0 to 1
  Vec3 kt{0};        ///< perfect refraction (transmittance), 0 to 1
  Vec3 ke{0};        ///< emitted radiance, W/(m^2 sr), on the normal's side
  float eta = 1.5f;  ///< index of refraction inside; outside is 1
  bool fresnel = false;  ///< ks and kt are weighted by Fresnel's equations

  /// The pattern of a coefficient that varies; null if it is constant.
  const VaryingCoefficient* varying_kd = nullptr;
  const VaryingCoefficient* varying_ks = nullptr;
  const VaryingCoefficient* varying_kt = nullptr;

  /// An emitter neither reflects nor refracts: a path ends at it.
  bool emits() const { return !is_black(ke); }

  /// Whether light may go through.
  bool refracts() const { return !is_black(kt) || varying_kt; }
};

}  // namespace lightwalk
