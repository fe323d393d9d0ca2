#pragma once

// # Tone mapping
//
// Radiance has no upper limit; a screen has one. Each step here brings an
// image nearer to [0, 1], and several may follow one another:
//
// - *clamp* cuts off what is over 1, and a lamp becomes a white patch;
// - *equalize* divides by the largest value, and one bright pixel may leave
//   the rest black;
// - *gamma* raises to $1/\gamma$, which lifts the dark end: screens expect
//   it;
// - *reinhard* is $x/(1+x)$, where nothing is ever cut off (Reinhard et al.,
//   "Photographic Tone Reproduction for Digital Images", SIGGRAPH 2002).
//
// Tone mapping is for viewing. Files for measurements hold radiance itself.

#include <cmath>
#include <vector>

#include "common/image/image.hpp"

namespace lightwalk {

enum class ToneStep { clamp, equalize, gamma, reinhard };

struct ToneMapping {
  float exposure = 0;  ///< in stops, before the steps: x 2^exposure
  std::vector<ToneStep> steps{ToneStep::equalize, ToneStep::gamma};
  float gamma = 2.2f;
  float gamma_before = 1;  ///< of an image that is gamma-encoded already
};

/// The largest channel of all pixels; 0 for an image without light.
inline float max_value(const Image& image) {
  float largest = 0;
  for (const Vec3& pixel : image.pixels) {
    largest = std::max(largest, max_component(pixel));
  }
  return largest;
}

inline void apply(ToneStep step, float gamma, Image& image) {
  const float largest = max_value(image);
  const float divisor = largest > 0 ? largest : 1;
  for (Vec3& pixel : image.pixels) {
    switch (step) {
      case ToneStep::clamp:
        pixel = glm::clamp(pixel, 0.0f, 1.0f);
        break;
      case ToneStep::equalize:
        pixel /= divisor;
        break;
      case ToneStep::gamma:
        for (int c = 0; c < 3; ++c) {
          pixel[c] = std::pow(std::max(pixel[c], 0.0f), 1 / gamma);
        }
        break;
      case ToneStep::reinhard:
        pixel = pixel / (1.0f + pixel);
        break;
    }
  }
}

/// The image as a screen shows it: every channel in [0, 1].
inline Image tone_map(Image image, const ToneMapping& mapping) {
  for (Vec3& pixel : image.pixels) pixel *= std::exp2(mapping.exposure);
  for (const ToneStep step : mapping.steps) apply(step, mapping.gamma, image);
  apply(ToneStep::clamp, mapping.gamma, image);
  return image;
}

/// The gamma of the mapped image: its values are light to the power of one
/// over this. PNG files store it, so that viewers know the curve.
inline float encoding_gamma(const ToneMapping& mapping) {
  float gamma = mapping.gamma_before;
  for (const ToneStep step : mapping.steps) {
    if (step == ToneStep::gamma) gamma *= mapping.gamma;
  }
  return gamma;
}

}  // namespace lightwalk
