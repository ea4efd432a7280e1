#pragma once
// Compressible neo-Hookean with the isochoric part split off, as CalculiX and Abaqus have it (REFERENCES §5) with
// C10 = μ/2 and D1 = 2/κ:
//   Ψ = μ/2 (g(J) I_C − 3) + κ/2 θ²,  g = J^(−2/3),  θ = J − 1.
// The printed law has no value at J = 0 and is at rest again in the mirror image. Below J = J₀ = 1/10 it is
// continued: g by its tangent at J₀, and μ/2 · 3 (1 − J/J₀)² is added. Ψ is then finite and continuous with its
// first derivatives, grows no faster than the sixth power of F, and is zero at rest only: flat and mirrored cells
// are driven back. (Without the added square a point would have less energy than rest where κ < 3 μ; with it, a
// point is still a minimum of its own.)

#include <cstdint>
#include <cstring>

#include "fem/models/laws/law.h"
#include "fem/models/laws/strain_invariants.h"

namespace argil::fem {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/// x^(−1/3) of positive normal numbers to a few last digits, the same bits on every machine: a guess that divides
/// the exponent, 4 % off at most, and two iterations of fourth order.
ARGIL_LANES_INLINE Lanes inverse_cube_root(const Lanes& x) {
  std::int64_t bits[k_lanes];
  std::memcpy(bits, &x, sizeof bits);
  for (std::int64_t& b : bits) b = 0x553ef0ff289dd796 - b / 3;
  Lanes r;
  std::memcpy(&r, bits, sizeof r);
  for (int i = 0; i < 2; ++i) {
    const Lanes error = 1.0 - x * r * r * r;  // r (1 − error)^(−1/3)
    r += r * error * (1.0 / 3 + error * (2.0 / 9 + (14.0 / 81) * error));
  }
  return r;
}

struct NeoHookeanLaw {
  static constexpr double k_least_volume = 0.1;  // J₀

  template <class Isa>
  static ARGIL_LANES_INLINE void prepare(const LaneMatrix& f, const PointMaterial&, LawState& s) {
    s.f = f;
    cofactors(f, s.auxiliary);
    s.square = inner(f, f);
    s.dilatation = f.m[0] * s.auxiliary.m[0] + f.m[1] * s.auxiliary.m[1] + f.m[2] * s.auxiliary.m[2] - 1.0;
  }
  /// For J ≥ J₀ in the strain E: with c = J^(2/3), I_C − 3c = (2 tr E (c − 1)(c + 2) − 12 II − 24 III)/(1 + c +
  /// c²), where what is linear in E has cancelled on paper.
  static ARGIL_LANES_INLINE Lanes density(const LawState& s, const PointMaterial& m) {
    const Volume v = volume(s.dilatation);
    const auto [t, second, third] = strain_invariants(s.f);
    const Lanes c = 1.0 / v.factor, over = 1.0 / (1.0 + c + c * c);
    const Lanes c_less_one = (2.0 * t + 4.0 * second + 8.0 * third) * over;
    const Lanes above = (2.0 * t * c_less_one * (c + 2.0) - 12.0 * second - 24.0 * third) * over;
    const Lanes isochoric = v.regular ? v.factor * above : v.factor * s.square - 3.0;
    return 0.5 * m.mu * (isochoric + v.barrier);
  }
  static ARGIL_LANES_INLINE LaneMatrix stress(const LawState& s, const PointMaterial& m, const Lanes& pressure) {
    const Volume v = volume(s.dilatation);
    const Lanes shear = m.mu * v.factor;
    const Lanes along = pressure + 0.5 * m.mu * (v.slope * s.square + v.barrier_slope);
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
    const Volume v = volume(dilatation(sigma, m));
    const Lanes square = dot(sigma, sigma), shear = m.mu * v.factor, mixed = m.mu * v.slope;
    const Lanes along = pressure + 0.5 * m.mu * (v.slope * square + v.barrier_slope);
    const Lanes curvature = 0.5 * m.mu * (v.curvature * square + v.barrier_curvature);
    for (int i = 0; i < 3; ++i) {
      const Lanes &own = sigma.m[i], &j = sigma.m[(i + 1) % 3], &k = sigma.m[(i + 2) % 3];
      r.slope.m[i] = j * k;
      r.stretches.m[i] = shear + 2.0 * mixed * own * r.slope.m[i] + curvature * (r.slope.m[i] * r.slope.m[i]);
      r.twist.m[i] = shear + along * own;
      r.flip.m[i] = shear - along * own;
    }
    constexpr int k_row[3] = {0, 0, 1}, k_column[3] = {1, 2, 2};
    for (int entry = 0; entry < 3; ++entry) {
      const int i = k_row[entry], j = k_column[entry];
      r.stretches.m[3 + entry] = mixed * (sigma.m[i] * r.slope.m[j] + sigma.m[j] * r.slope.m[i]) +
                                 curvature * (r.slope.m[i] * r.slope.m[j]) + along * sigma.m[3 - i - j];
    }
    return r;
  }

 private:
  /// g and 3 (1 − J/J₀)² or 0 with their derivatives by J.
  struct Volume {
    Lanes factor, slope, curvature, barrier, barrier_slope, barrier_curvature;
    decltype(Lanes{} < Lanes{}) regular;
  };
  static ARGIL_LANES_INLINE Volume volume(const Lanes& dilatation) {
    const Lanes j = dilatation + 1.0;
    Volume v;
    v.regular = j >= k_least_volume;
    const Lanes at = v.regular ? j : broadcast(k_least_volume), below = j - at, over = 1.0 / at;
    v.factor = inverse_cube_root(at * at);
    v.slope = (-2.0 / 3) * v.factor * over;
    v.curvature = v.regular ? (-5.0 / 3) * v.slope * over : broadcast(0);
    v.factor += below * v.slope;
    const Lanes depth = (-1.0 / k_least_volume) * below;
    v.barrier = 3.0 * (depth * depth);
    v.barrier_slope = (-6.0 / k_least_volume) * depth;
    v.barrier_curvature = v.regular ? broadcast(0) : broadcast(6.0 / (k_least_volume * k_least_volume));
    return v;
  }
};

#pragma GCC diagnostic pop

}  // namespace argil::fem
