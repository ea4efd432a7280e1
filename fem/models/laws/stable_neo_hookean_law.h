#pragma once
// Stable neo-Hookean of Smith, De Goes, Kim 2018 as METHODS §4 has it: with μ_S = 4μ/3, λ_S = λ + 5μ/6 and
// α = 1 + 3 μ_S/(4 λ_S), less its value at F = I,
//   Ψ = μ_S/2 (I_C − 3 − log((I_C + 1)/4)) + λ_S/2 (J − α)² = μ_S/2 (…) − μ θ + λ_S/2 θ²,  θ = J − 1.
// Of λ_S = κ + μ/6 the first part goes by the mean dilatation, so that B-bar elements at rest are the linear ones.

#include <cmath>

#include "fem/models/laws/law.h"
#include "fem/models/laws/strain_invariants.h"

namespace argil::fem {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/// y − log(1 + y) by the series of artanh, without cancellation about 0: the same bits on every machine.
ARGIL_LANES_INLINE Lanes above_logarithm(const Lanes& y) {
  Lanes mantissa, exponent;
  for (int lane = 0; lane < k_lanes; ++lane) {
    int e = 0;
    mantissa[lane] = std::frexp(1.0 + y[lane], &e);
    exponent[lane] = e;
  }
  const auto low = mantissa < 0.70710678118654752;
  mantissa = low ? 2.0 * mantissa : mantissa;
  exponent = low ? exponent - 1.0 : exponent;
  const auto near = exponent == 0.0;
  const Lanes s = near ? y / (near ? 2.0 + y : broadcast(1)) : (mantissa - 1.0) / (mantissa + 1.0);
  const Lanes square = s * s;
  Lanes series = broadcast(1.0 / 23);
  for (int k = 21; k > 1; k -= 2) series = 1.0 / k + square * series;
  const Lanes cubic = 2.0 * (s * square * series);  // log(1 + y) = 2s + cubic + exponent log 2; y − 2s = y s
  return near ? y * s - cubic : y - 2.0 * s - cubic - exponent * 0.69314718055994531;
}

struct StableNeoHookeanLaw {
  template <class Isa>
  static ARGIL_LANES_INLINE void prepare(const LaneMatrix& f, const PointMaterial&, LawState& s) {
    s.f = f;
    cofactors(f, s.auxiliary);
    s.square = inner(f, f);
    s.dilatation = f.m[0] * s.auxiliary.m[0] + f.m[1] * s.auxiliary.m[1] + f.m[2] * s.auxiliary.m[2] - 1.0;
  }
  /// In the strain E, where the parts that are linear in it cancel on paper instead of in the last digits:
  /// I_C − 3 = 2t, J² − 1 = 2t + 4 II + 8 III with t, II, III the invariants of E.
  static ARGIL_LANES_INLINE Lanes density(const LawState& s, const PointMaterial& m) {
    const auto [t, second, third] = strain_invariants(s.f);
    const auto upright = s.dilatation > -0.5;
    const Lanes over = 1.0 / (upright ? 2.0 + s.dilatation : broadcast(1));
    const Lanes theta = upright ? (2.0 * t + 4.0 * second + 8.0 * third) * over : s.dilatation;
    const Lanes above = upright ? (theta * t - 4.0 * second - 8.0 * third) * over : t - s.dilatation;  // t − θ
    return m.mu * ((2.0 / 3) * above_logarithm(0.5 * t) + above + (1.0 / 12) * (theta * theta));
  }
  static ARGIL_LANES_INLINE LaneMatrix stress(const LawState& s, const PointMaterial& m, const Lanes& pressure) {
    const Lanes shear = (4.0 / 3) * m.mu * (1.0 - 1.0 / (s.square + 1.0));
    const Lanes along = pressure + m.mu * ((1.0 / 6) * s.dilatation - 1.0);
    LaneMatrix result;
    for (int i = 0; i < 9; ++i) result.m[i] = shear * s.f.m[i] + along * s.auxiliary.m[i];
    return result;
  }
  static ARGIL_LANES_INLINE Lanes dilatation(const LaneVector& sigma, const PointMaterial&) {
    return sigma.m[0] * sigma.m[1] * sigma.m[2] - 1.0;
  }
  static ARGIL_LANES_INLINE LawSpectrum spectrum(const LaneVector& sigma, const PointMaterial& m,
                                                 const Lanes& pressure) {
    LawSpectrum r;
    const Lanes over = 1.0 / (dot(sigma, sigma) + 1.0), shear = (4.0 / 3) * m.mu * (1.0 - over);
    const Lanes curvature = (8.0 / 3) * m.mu * (over * over), sixth = (1.0 / 6) * m.mu;
    const Lanes along = pressure + m.mu * ((1.0 / 6) * dilatation(sigma, m) - 1.0);
    for (int i = 0; i < 3; ++i) {
      const Lanes &own = sigma.m[i], &j = sigma.m[(i + 1) % 3], &k = sigma.m[(i + 2) % 3];
      r.slope.m[i] = j * k;
      r.stretches.m[i] = shear + curvature * (own * own) + sixth * (r.slope.m[i] * r.slope.m[i]);
      r.twist.m[i] = shear + along * own;
      r.flip.m[i] = shear - along * own;
    }
    constexpr int k_row[3] = {0, 0, 1}, k_column[3] = {1, 2, 2};
    for (int entry = 0; entry < 3; ++entry) {
      const int i = k_row[entry], j = k_column[entry];
      r.stretches.m[3 + entry] = curvature * (sigma.m[i] * sigma.m[j]) + sixth * (r.slope.m[i] * r.slope.m[j]) +
                                 along * sigma.m[3 - i - j];
    }
    return r;
  }
};

#pragma GCC diagnostic pop

}  // namespace argil::fem
