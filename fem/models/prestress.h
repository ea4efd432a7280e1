#pragma once
// Initial stress (papers/004: initial stresses) on top of any force model: a second Piola–Kirchhoff stress S adds
// the energy S : E per rest volume, E the Green strain, so the stress F S and the constant geometric stiffness
// ∇N_a·S ∇N_b.

#include "fem/models/force_model.h"

namespace argil::fem {

/// Per block S at [element * point_count + point] [Pa], symmetric; a block without entries takes its `prestress`,
/// the same in all directions, as it is at each call.
using InitialStresses = std::vector<std::vector<Eigen::Matrix3d>>;

/// `model` with initial stress. In a projected tangent the negative principal stresses count as zero, beside the
/// projected tangent of the model. A free body under initial stress is not at equilibrium in its rest shape.
/// `share`, if given, multiplies all stress as it is at each call: stress that is made, as by muscles (an active
/// stress), whose work is what the energy at a place gains as the share changes.
[[nodiscard]] std::unique_ptr<ForceModel> make_prestressed(std::unique_ptr<ForceModel> model,
                                                           std::span<const ElementBlock> blocks,
                                                           const Eigen::Matrix3Xd& rest_nodes,
                                                           InitialStresses stresses = {},
                                                           std::shared_ptr<const double> share = nullptr);

}  // namespace argil::fem
