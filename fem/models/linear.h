#pragma once
// Small-strain linear elasticity in fixed axes (METHODS §3, §4) in every formulation: plain and B-bar at quadrature
// points (linear_kernels.h), incompatible modes by a matrix of each element (warped_stiffness.h).

#include "fem/models/force_model.h"
#include "fem/models/formulation.h"

namespace argil::fem {

/// As make_linear() of force_model.h, which is the plain one. Formulations are those of trilinear hexahedra; other
/// kinds are plain.
[[nodiscard]] std::unique_ptr<ForceModel> make_linear_as(std::span<const ElementBlock> blocks,
                                                         const Eigen::Matrix3Xd& rest_nodes,
                                                         Formulation formulation);

}  // namespace argil::fem
