#pragma once
// Models that multiply by a stiffness matrix of each element (element_stiffness.h): stiffness warping of papers/000
// and 002, f = −Σ R K_e (Rᵀ x − X) with one rotation an element, and linear elasticity, R = I.

#include "fem/models/force_model.h"
#include "fem/models/formulation.h"

namespace argil::fem {

/// R from the polar decomposition of F at the element's centre, det R = +1. Not a gradient: moments of an element
/// that is not a parallelepiped do not sum to zero (ghost torque; METHODS §4), and the tangent R K_e Rᵀ leaves the
/// turning of R out. Blocks, nodes and materials as for make_corotational(); when a material has changed, the
/// matrices are computed anew at the next call.
[[nodiscard]] std::unique_ptr<ForceModel> make_warped_stiffness(std::span<const ElementBlock> blocks,
                                                                const Eigen::Matrix3Xd& rest_nodes,
                                                                Formulation formulation);
/// Linear elasticity by matrices: for incompatible modes, which have no form at quadrature points.
[[nodiscard]] std::unique_ptr<ForceModel> make_linear_by_matrices(std::span<const ElementBlock> blocks,
                                                                  const Eigen::Matrix3Xd& rest_nodes,
                                                                  Formulation formulation);

}  // namespace argil::fem
