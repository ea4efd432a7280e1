#pragma once
// What a law is to the kernels: a struct of static functions over four lanes.
//   prepare<Isa>(f, material, state)          what density and stress need, and state.dilatation = θ
//   density(state, material)                  W, less its value and that of κ/2 θ² at F = I
//   stress(state, material, pressure)         ∂W/∂F + pressure ∂θ/∂F
//   spectrum(sigma, material, pressure)       second derivatives of W + pressure θ, and ∂θ/∂σ
//   dilatation(sigma, material)               θ

#include "fem/models/lane_eigen.h"
#include "fem/models/packet_points.h"

namespace argil::fem {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

struct LawState {
  LaneMatrix f;
  LaneMatrix auxiliary;  // the law's own: rotation, cofactors
  Lanes square;          // |F|²
  Lanes dilatation;
};

struct LawSpectrum {
  LaneSymmetric stretches;  // ∂²/∂σ_i∂σ_j
  LaneVector twist, flip;   // of the pairs (y,z), (x,z), (x,y)
  LaneVector slope;         // ∂θ/∂σ
};

ARGIL_LANES_INLINE Lanes bulk_modulus(const PointMaterial& m) {
  return m.lambda + (2.0 / 3) * m.mu;
}

#pragma GCC diagnostic pop

}  // namespace argil::fem
