#pragma once
// The largest frequency of the pencil in use, matrix-free: Lanczos on M̃⁻¹ K̃ in the inner product of M̃. With a
// linear model and no damping, central difference, symplectic Euler and velocity Verlet are stable iff Δt < 2/ω_max
// (METHODS §5).

#include "fem/spectrum/pencil.h"

namespace argil::fem {

struct LargestFrequency {
  double value = 0;     // ω_max [rad/s]
  double residual = 0;  // |K̃ v − ω² M̃ v| in the norm of M̃⁻¹, relative to ω²: bounds the error of ω²
  int iterations = 0;
};

/// Linearised at `positions` (3 x control points). @throws Error (bad_geometry) as InverseMass, (unsupported) if
/// the tangent is not symmetric, (not_converged) after 1000 iterations. Cost: one product with K and one solve with
/// the mass an iteration, some 20 to 100 of them.
[[nodiscard]] LargestFrequency largest_frequency(const System& system, std::span<const AnchorSpring> springs,
                                                 const Eigen::Matrix3Xd& positions, double tolerance = 1e-6);
/// The same at the rest nodes that the system names.
[[nodiscard]] LargestFrequency largest_frequency_at_rest(const System& system,
                                                         std::span<const AnchorSpring> springs,
                                                         double tolerance = 1e-6);

}  // namespace argil::fem
