#pragma once
// Strain of large deformation as the corotational model sees it: S − I, where F = R S with the rotation R taken off
// (METHODS §4), in one number for pictures and expectations.

#include <Eigen/Core>
#include <span>

#include "fem/element_block.h"

namespace argil::fem {

/// F = ∂x/∂X at a quadrature point; `nodes` are present positions, 3 x nodes of the table.
[[nodiscard]] Eigen::Matrix3d deformation_gradient(const ElementBlock& block, std::size_t element, int point,
                                                   const Eigen::Matrix3Xd& nodes);

/// Eigenvalues of S at the points of a block, 3 x points, σ₀ ≥ σ₁ ≥ |σ₂|; σ₂ is negative where the element is
/// inside out. `nodes` are present positions, 3 x nodes of the table. In parallel.
[[nodiscard]] Eigen::Matrix3Xd principal_stretches(const ElementBlock& block, const Eigen::Matrix3Xd& nodes);

/// Equivalent strain sqrt(2/3 e':e') at the points of a block, e' the deviator of S − I.
[[nodiscard]] Eigen::VectorXd equivalent_strain(const ElementBlock& block, const Eigen::Matrix3Xd& nodes);

/// The same per node of the table (recovery.h), for pictures and files.
[[nodiscard]] Eigen::VectorXd equivalent_strain(std::span<const ElementBlock> blocks,
                                                const Eigen::Matrix3Xd& nodes);

}  // namespace argil::fem
