#pragma once
// The lowest frequencies of a pencil and their shapes, by block Lanczos with shift and inversion, full
// reorthogonalisation and thick restarts. A block finds what a single vector misses: the six zeros of a free body
// and the pairs of a square section. The shift lies below zero, so that a free body has a factor; where the body is
// unstable as it stands (a column beyond its buckling load) it moves further down.

#include <Eigen/Core>
#include <vector>

#include "fem/spectrum/pencil.h"

namespace argil::fem {

struct Modes {
  std::vector<double> squares;           // ω² ascending [1/s²]; negative where the body is unstable
  std::vector<Eigen::Matrix3Xd> shapes;  // 3 x all control points, vᵀ M̃ v = 1 kg, largest component positive
  std::vector<double> residuals;  // |K̃ v − ω² M̃ v| / |K̃ v|, and that over a mean |K̃ v| for ω = 0
  double rounding = 0;            // an ω² smaller than this is zero to working precision
};

/// `count` lowest modes, fewer if there are fewer unknowns. @throws Error (bad_input) for a count below 1;
/// (bad_geometry) as InverseMass; (not_converged) if 300 restarts do not reach `tolerance`, relative in the vectors
/// (the squares are then good to its square).
/// Cost: one sparse Cholesky factor, some solves a mode, memory 16 (3 count + 48) bytes an unknown beside the
/// factor.
[[nodiscard]] Modes lowest_modes(const Pencil& pencil, std::size_t control_point_count, int count,
                                 double tolerance = 1e-8);

/// ω/2π [Hz], zero for those within rounding, negative of what grows (growth rate/2π) for an unstable one.
[[nodiscard]] double frequency(const Modes& modes, std::size_t mode);

}  // namespace argil::fem
