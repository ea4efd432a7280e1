#pragma once
// The model of papers/004 §3.2.2: forces K R d, with R d the displacements that edges and angles show
// (local_frame_operator.h) and K_e the dense stiffness of each element. Kept for the chart, with what is wrong with
// it (METHODS §4, each a test in tests/fem/models/local_frame_test.cpp):
// * R sees a small uniform strain twice on 8 nodes, hence the half below; on 64 nodes 0.33 of a stretch and 0.64 of
// a shear
//   (their mean over the element), which no single factor repairs;
// * the mirror image of the rest state has no force, so that an inside-out cell stays so;
// * K R is not symmetric: motion without damping grows at any time step. Damp with γ = 0.1 ω_max and take
//   Δt = 0.4 · 2/ω_max of the central difference.

#include <memory>
#include <span>

#include "fem/models/force_model.h"

namespace argil::fem {

/// f_e = −Q K_e Qᵀ ½R_e, K_e with the true Jacobian, Q the polar rotation of F at the middle of the cell. For
/// trilinear hexahedra, tricubic elements and pyramids (experimental on the latter two). There is no energy:
/// energy() is ½ ½Rᵀ Q K Qᵀ ½R, as a measure. The tangent is Q K_e Qᵀ, symmetric, not the derivative of the forces.
/// Dense matrices are shared between congruent elements; painted material has them made anew at the next call.
/// Memory: 288 KiB for each different tricubic element. @throws Error (unsupported) for another element kind.
[[nodiscard]] std::unique_ptr<ForceModel> make_local_frame(std::span<const ElementBlock> blocks,
                                                           const Eigen::Matrix3Xd& rest_nodes);

/// Equations 13–15 as printed: R d summed over elements into rows of the nodes first, and K_e = diag(K_x, K_y, K_z)
/// with K_x = 2 Σ_a ∫ B_aᵀ C B_x, derivatives by u, v, w taken for those by x, y, z, in fixed axes, integrated over
/// the unit cube. Under uniform strain it has no force in the interior; its forces have not the direction of the
/// true ones (cosine 0.73), nor their dimension where cells are not of size 1. To show where this fails.
[[nodiscard]] std::unique_ptr<ForceModel> make_local_frame_literal(std::span<const ElementBlock> blocks,
                                                                   const Eigen::Matrix3Xd& rest_nodes);

}  // namespace argil::fem
