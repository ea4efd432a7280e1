#pragma once
// St. Venant–Kirchhoff: W = μ (|E|² − θ²/3), θ = tr E, E = (FᵀF − I)/2.

#include "fem/models/laws/law.h"

namespace argil::fem {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

struct StVenantKirchhoffLaw {
  template <class Isa>
  static ARGIL_LANES_INLINE void prepare(const LaneMatrix& f, const PointMaterial&, LawState& s) {
    s.f = f;
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) {
        Lanes e = f.m[i] * f.m[j] + f.m[3 + i] * f.m[3 + j] + f.m[6 + i] * f.m[6 + j];
        if (i == j) e -= 1.0;
        s.auxiliary.m[3 * i + j] = s.auxiliary.m[3 * j + i] = 0.5 * e;
      }
    s.dilatation = s.auxiliary.m[0] + s.auxiliary.m[4] + s.auxiliary.m[8];
    s.square = inner(s.auxiliary, s.auxiliary);
  }
  static ARGIL_LANES_INLINE Lanes density(const LawState& s, const PointMaterial& m) {
    return m.mu * (s.square - (1.0 / 3) * (s.dilatation * s.dilatation));
  }
  static ARGIL_LANES_INLINE LaneMatrix stress(const LawState& s, const PointMaterial& m, const Lanes& pressure) {
    const Lanes shear = 2.0 * m.mu, along = pressure - (2.0 / 3) * m.mu * s.dilatation;
    LaneMatrix second;  // second Piola–Kirchhoff stress
    for (int i = 0; i < 9; ++i) {
      second.m[i] = shear * s.auxiliary.m[i];
      if (i % 4 == 0) second.m[i] += along;
    }
    return product(s.f, second);
  }
  static ARGIL_LANES_INLINE Lanes dilatation(const LaneVector& sigma, const PointMaterial&) {
    return 0.5 * (dot(sigma, sigma) - 3.0);
  }
  static ARGIL_LANES_INLINE LawSpectrum spectrum(const LaneVector& sigma, const PointMaterial& m,
                                                 const Lanes& pressure) {
    LawSpectrum r;
    const Lanes third = (2.0 / 3) * m.mu;
    const Lanes g = pressure - m.mu - third * dilatation(sigma, m);  // ∂Ψ/∂σ_i = σ_i (μ σ_i² + g)
    for (int i = 0; i < 3; ++i) {
      const Lanes &own = sigma.m[i], &j = sigma.m[(i + 1) % 3], &k = sigma.m[(i + 2) % 3];
      r.stretches.m[i] = 3.0 * m.mu * own * own + g - third * own * own;
      const Lanes squares = j * j + k * k;
      r.twist.m[i] = m.mu * (squares - j * k) + g;
      r.flip.m[i] = m.mu * (squares + j * k) + g;
      r.slope.m[i] = own;
    }
    r.stretches.m[3] = -third * (sigma.m[0] * sigma.m[1]);
    r.stretches.m[4] = -third * (sigma.m[0] * sigma.m[2]);
    r.stretches.m[5] = -third * (sigma.m[1] * sigma.m[2]);
    return r;
  }
};

#pragma GCC diagnostic pop

}  // namespace argil::fem
