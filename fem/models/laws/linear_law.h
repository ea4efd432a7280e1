#pragma once
// Linear elasticity in fixed axes: W = μ (|ε|² − θ²/3), θ = tr ε, ε = sym F − I.

#include "fem/models/laws/law.h"

namespace argil::fem {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

struct LinearLaw {
  static constexpr bool k_isotropic = false;

  template <class Isa>
  static ARGIL_LANES_INLINE void prepare(const LaneMatrix& f, const PointMaterial&, LawState& s) {
    s.f = f;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        s.auxiliary.m[3 * i + j] = 0.5 * (f.m[3 * i + j] + f.m[3 * j + i]);
        if (i == j) s.auxiliary.m[3 * i + j] -= 1.0;
      }
    s.dilatation = s.auxiliary.m[0] + s.auxiliary.m[4] + s.auxiliary.m[8];
    s.square = inner(s.auxiliary, s.auxiliary);
  }
  static ARGIL_LANES_INLINE Lanes density(const LawState& s, const PointMaterial& m) {
    return m.mu * (s.square - (1.0 / 3) * (s.dilatation * s.dilatation));
  }
  static ARGIL_LANES_INLINE LaneMatrix stress(const LawState& s, const PointMaterial& m, const Lanes& pressure) {
    const Lanes shear = 2.0 * m.mu, along = pressure - (2.0 / 3) * m.mu * s.dilatation;
    LaneMatrix result;
    for (int i = 0; i < 9; ++i) {
      result.m[i] = shear * s.auxiliary.m[i];
      if (i % 4 == 0) result.m[i] += along;
    }
    return result;
  }
  static ARGIL_LANES_INLINE Lanes dilatation(const LaneVector&, const PointMaterial&) { return broadcast(0); }
  static ARGIL_LANES_INLINE LawSpectrum spectrum(const LaneVector&, const PointMaterial& m, const Lanes&) {
    LawSpectrum r;
    for (int i = 0; i < 3; ++i) {
      r.stretches.m[i] = (4.0 / 3) * m.mu;
      r.stretches.m[3 + i] = (-2.0 / 3) * m.mu;
      r.twist.m[i] = broadcast(0);
      r.flip.m[i] = 2.0 * m.mu;
      r.slope.m[i] = broadcast(1);
    }
    return r;
  }
};

#pragma GCC diagnostic pop

}  // namespace argil::fem
