#pragma once
// Von Mises stress of the corotational model, sqrt(3/2 s:s) of the deviator s of 2μ(S − I) + λ tr(S − I) I: stress
// per rest area in axes that turn with the material. [Pa]

#include <Eigen/Core>
#include <span>

#include "fem/element_block.h"

namespace argil::fem {

/// At the points of a block.
[[nodiscard]] Eigen::VectorXd von_mises_stress(const ElementBlock& block, const Eigen::Matrix3Xd& nodes);

/// Per node of the table (recovery.h).
[[nodiscard]] Eigen::VectorXd von_mises_stress(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& nodes);

}  // namespace argil::fem
