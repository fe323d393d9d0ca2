#pragma once

// # Sine and cosine
//
// Directions are drawn with an angle from anywhere in the circle. The
// standard library's functions branch on the part of the circle that the
// angle is in, and the processor often mispredicts such a branch. Each
// library also rounds the last bit in its own way. The two functions here
// have no branch, and give the same bits everywhere.
//
// Sine and cosine are one wave. It has a piece, from $-\pi/2$ to $\pi/2$,
// that is made of nothing but odd powers with quickly falling coefficients:
// $x - x^3/6 + x^5/120 - \dots$ Stop after $x^9$, move the coefficients a
// little so that the largest error is as small as it can be ($5 \cdot
// 10^{-9}$), and what is left is rounding. The rest of the wave is this piece
// over and over, forwards and backwards, so an angle anywhere is folded into
// it. Counted in turns of the circle instead of radians the folding is exact.
//
// `Number` is a float, or a row of them: see stage 6.

#include <cmath>

#include "common/math/vector.hpp"

namespace lightwalk {

// #region sine-cosine
/// The sine of an angle of -1/4 to 1/4 turns.
template <class Number>
Number sine_of_turns(const Number& turns) {
  const Number x = two_pi * turns;
  const Number y = x * x;
  const Number higher =
      y * (-1.6666657e-1f +
           y * (8.333017e-3f + y * (-1.9806615e-4f + y * 2.6000548e-6f)));
  return x + x * higher;
}

/// How far from the half-turn the angle is, in [-1/2, 1/2] turns: 1/2 at 0,
/// 0 at pi and -1/2 just before 2 pi.
template <class Number>
Number turns_to_half(const Number& radians) {
  const Number turns = radians * (1 / two_pi);
  return 0.5f - (turns - floor(turns));
}

template <class Number>
Number sine(const Number& radians) {
  const Number turns = turns_to_half(radians);
  const Number folded = 0.25f - abs(abs(turns) - 0.25f);
  return sine_of_turns<Number>(copysign(folded, turns));
}
template <class Number>
Number cosine(const Number& radians) {
  return sine_of_turns<Number>(abs(turns_to_half(radians)) - 0.25f);
}

/// Sine and cosine of an angle in radians, to 5e-7 from 0 to 2 pi. Outside
/// that range the error grows with the rounding of the angle.
inline float sin(float radians) {
  return sine(radians);
}
inline float cos(float radians) {
  return cosine(radians);
}
// #endregion sine-cosine

}  // namespace lightwalk
