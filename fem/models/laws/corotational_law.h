#pragma once
// Corotational: W = μ (|F − R|² − θ²/3), θ = tr RᵀF − 3 (METHODS §4).

#include "fem/models/laws/law.h"

namespace argil::fem {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

struct CorotationalLaw {
  // σ_j + σ_k of a flat, mirrored element may vanish, where the energy has no second derivative.
  static constexpr double k_least_pair = 1e-6;

  template <class Isa>
  static ARGIL_LANES_INLINE void prepare(const LaneMatrix& f, const PointMaterial&, LawState& s) {
    s.f = f;
    nearest_rotation(f, s.auxiliary, Isa::svd);
    s.dilatation = inner(s.auxiliary, f) - 3.0;
    s.square = broadcast(0);
    for (int i = 0; i < 9; ++i) s.square += (f.m[i] - s.auxiliary.m[i]) * (f.m[i] - s.auxiliary.m[i]);
  }
  static ARGIL_LANES_INLINE Lanes density(const LawState& s, const PointMaterial& m) {
    return m.mu * (s.square - (1.0 / 3) * (s.dilatation * s.dilatation));
  }
  static ARGIL_LANES_INLINE LaneMatrix stress(const LawState& s, const PointMaterial& m, const Lanes& pressure) {
    const Lanes shear = 2.0 * m.mu, along = pressure - (2.0 / 3) * m.mu * s.dilatation;
    LaneMatrix result;
    for (int i = 0; i < 9; ++i) result.m[i] = shear * (s.f.m[i] - s.auxiliary.m[i]) + along * s.auxiliary.m[i];
    return result;
  }
  static ARGIL_LANES_INLINE Lanes dilatation(const LaneVector& sigma, const PointMaterial&) {
    return sum(sigma) - 3.0;
  }
  static ARGIL_LANES_INLINE LawSpectrum spectrum(const LaneVector& sigma, const PointMaterial& m,
                                                 const Lanes& pressure) {
    LawSpectrum r;
    const Lanes k = 2.0 * (pressure - 2.0 * m.mu - (2.0 / 3) * m.mu * dilatation(sigma, m));
    for (int i = 0; i < 3; ++i) {
      r.stretches.m[i] = (4.0 / 3) * m.mu;
      r.stretches.m[3 + i] = (-2.0 / 3) * m.mu;
      const Lanes pair = sigma.m[(i + 1) % 3] + sigma.m[(i + 2) % 3];
      r.twist.m[i] = 2.0 * m.mu + k / larger(pair, broadcast(k_least_pair));
      r.flip.m[i] = 2.0 * m.mu;
      r.slope.m[i] = broadcast(1);
    }
    return r;
  }
};

#pragma GCC diagnostic pop

}  // namespace argil::fem
