// Elementary functions of vectors, without branches and without a library, so that every processor gives the
// same bytes: no fused multiply-add, no table. README.md, "Elementary functions".
#pragma once

#include "base/units.h"
#include "numerics/lanes.h"

namespace stablecut::numerics {

/// The nearest whole number, of values below 2^51 in size: adding what leaves no fraction bits rounds.
template <typename V>
STABLECUT_INLINE V nearest_whole(const V& value) {
  constexpr double kShift = 6755399441055744.0;  // 1.5 * 2^52
  return (value + kShift) - kShift;
}

/// On |t| <= tan(pi/8): atan(t) = t + t^3 p(t^2), by scripts/derive/arctangent.py.
inline constexpr double kArctangent[11] = {-0.3333333333333333,  0.1999999999999552,   -0.14285714284666542,
                                           0.11111111015256292,  -0.09090904578121085, 0.07692183190760651,
                                           -0.0666451144646022,  0.05858148904795124,  -0.050854496960392584,
                                           0.039231657085083686, -0.019176885636589053};

/// The angle of (x, y) from the x axis, in (-pi, pi], to 3e-16; 0 where both are 0.
template <typename V>
STABLECUT_INLINE V angle_of(const V& y, const V& x) {
  // |y/x| or |x/y|, whichever is at most 1, and above tan(pi/8) the distance from pi/4.
  const V ax = absolute(x), ay = absolute(y);
  const V large = largest(ax, ay), small = least(ax, ay);
  const auto upper = small > 0.41421356237309503 * large;
  const V denominator = upper ? small + large : large;
  const V t = (upper ? small - large : small) / (denominator > 0 ? denominator : V{} + 1);
  const V s = t * t;
  V p = V{} + kArctangent[10];
  for (int i = 9; i >= 0; --i) p = p * s + kArctangent[i];
  V angle = t + t * s * p + (upper ? V{} + 0.25 * kPi : V{});
  angle = ay > ax ? 0.5 * kPi - angle : angle;
  angle = x < 0 ? kPi - angle : angle;
  return y < 0 ? -angle : angle;
}

/// Last powers of the series by Horner's rule, by scripts/derive/sine_cosine_series.py: of the cosine and
/// (less the factor r) the sine up to pi/4, and of the cosine up to pi/3.
inline constexpr int kCosinePower = 16, kSinePower = 14, kThirdPower = 18;

/// Sine and cosine of angles below 1e5 rad in size, to 3e-16. Reduced to |r| <= pi/4 by pi/2 in three parts,
/// whose products with a small whole number are exact; then the series, whose next terms are below 5e-17.
template <typename V>
STABLECUT_INLINE void sine_and_cosine(const V& angle, V& sine, V& cosine) {
  constexpr double kHigh = 0x1.921fb544p+0, kMiddle = 0x1.0b4611a6p-34, kLow = 0x1.3198a2e037073p-69;
  const V one = V{} + 1;
  const V k = nearest_whole(angle * (2 / kPi));
  const V r = ((angle - k * kHigh) - k * kMiddle) - k * kLow;
  const V r2 = r * r;
  V s = one, c = one;
  for (int n = kCosinePower; n >= 2; n -= 2) {
    c = 1 - r2 * c * (1.0 / (n * (n - 1)));
    if (n <= kSinePower) s = 1 - r2 * s * (1.0 / (n * (n + 1)));
  }
  s = r * s;
  const V quarter = k - 4 * nearest_whole(0.25 * k - 0.375);
  const V s_or_c = quarter == 1 || quarter == 3 ? c : s, c_or_s = quarter == 1 || quarter == 3 ? s : c;
  sine = quarter >= 2 ? -s_or_c : s_or_c;
  cosine = quarter == 1 || quarter == 2 ? -c_or_s : c_or_s;
}

/// Cosine on [0, pi/3] by its series; the next term is below 1e-17.
template <typename V>
STABLECUT_INLINE V cosine_of_small(const V& angle) {
  const V square = angle * angle;
  V cosine = V{} + 1;
  for (int n = kThirdPower; n >= 2; n -= 2) cosine = 1 - square * cosine * (1.0 / (n * (n - 1)));
  return cosine;
}

/// Sines and cosines of eight angles, as sine_and_cosine.
void sines_and_cosines(const double angle[kLanes], double sine[kLanes], double cosine[kLanes]);

}  // namespace stablecut::numerics
