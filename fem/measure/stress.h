#pragma once
// Stress of isotropic models, from the principal stretches σ: T_i = ∂Ψ/∂σ_i, the principal Biot stresses, per rest
// area in axes that turn with the material (METHODS §4). For the corotational model T = 2μ(S − I) + λ tr(S − I) I.
// Von Mises stress is sqrt(3/2 s:s) of the deviator s of T. [Pa]

#include <Eigen/Core>
#include <span>
#include <string_view>

#include "fem/element_block.h"

namespace argil::fem {

/// T of stretches σ₀ ≥ σ₁ ≥ |σ₂| (σ₂ < 0 inside out); μ and λ are those of small strain [Pa].
using StressLaw = Eigen::Vector3d (*)(const Eigen::Vector3d& stretches, double mu, double lambda);

/// The law of a force model by its name: corotational, stable_neo_hookean, neo_hookean, st_venant_kirchhoff. Every
/// other model is small-strain elasticity in some rotating frame, lattices included, and gets the corotational law:
/// for the linear model that is its own stress as long as it is right, under small rotation.
[[nodiscard]] StressLaw stress_law(std::string_view model);

/// At the points of a block, 3 x points, in the order of the stretches; the block's prestress (a second
/// Piola–Kirchhoff stress s in all directions) adds s σ_i. In parallel.
[[nodiscard]] Eigen::Matrix3Xd principal_stresses(const ElementBlock& block, const Eigen::Matrix3Xd& nodes,
                                                  StressLaw law);

/// At the points of a block, by the corotational law without `law`.
[[nodiscard]] Eigen::VectorXd von_mises_stress(const ElementBlock& block, const Eigen::Matrix3Xd& nodes,
                                               StressLaw law = nullptr);

/// Per node of the table (recovery.h).
[[nodiscard]] Eigen::VectorXd von_mises_stress(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& nodes,
                                               StressLaw law = nullptr);

}  // namespace argil::fem
