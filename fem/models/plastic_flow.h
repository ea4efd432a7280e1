#pragma once
// Plastic flow beneath any law of elasticity that is given by an energy density (models of laws/): at every
// quadrature point F = F_e F_p with det F_p = 1, and the law sees F_e. Since F_e is the gradient with respect to a
// rest shape that F_p has stretched, a body that has flowed is one whose elements have other rest Jacobians.
//   Flow (after Perzyna; Simo and Hughes 1998, §9): with the logarithmic strain ε of F_e, σ = √(3/2) 2μ |dev ε|
//   (von
// Mises; of every law to first order in ε) and its excess over the yield stress,
//   d σ/dt = −(σ − yield)/τ at fixed F,
// which is taken exactly over a step: the excess is multiplied by exp(−h/τ), by 0 for τ = 0. Volume is kept, since
// only dev ε changes, and elastic energy only falls. Yield 0 is a Maxwell fluid of relaxation time τ, τ = 0 perfect
// plasticity, both together Bingham's solid.

#include <memory>
#include <vector>

#include "fem/models/model_table.h"

namespace argil::fem {

struct FlowLaw {
  double yield = 0;       // von Mises stress [Pa]
  double relaxation = 0;  // τ [s]
};

/// Per block F_p⁻¹ at [element * point_count + point]; a body that has not flowed has no blocks.
struct PlasticFlow {
  std::vector<std::vector<Eigen::Matrix3d>> inverse;
  bool empty() const { return inverse.empty(); }
  bool operator==(const PlasticFlow&) const = default;
};

/// Whether it is of the points of these blocks.
[[nodiscard]] bool fits(const PlasticFlow& state, std::span<const ElementBlock> blocks);

/// What a step of flow did.
struct FlowReport {
  std::size_t points = 0;     // that flowed
  double largest_strain = 0;  // √(2/3) |Δε_p| at a point
  double dissipated = 0;  // [J], as ½ (2μ |dev ε|² before − after), to first order in ε what the law loses
};

/// Lets the body flow for `time_step` [s] at these nodes (3 x nodes). Points that are inside out, that have no
/// stiffness or that stay below the yield stress do not flow. A state that does not fit the blocks starts anew.
/// Cost O(points), in parallel.
FlowReport flow(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& nodes, const FlowLaw& law,
                double time_step, PlasticFlow& state);

/// @throws Error (unsupported) naming the model that cannot flow, with those that can.
void check_flow(const ModelChoice& choice);
// clang-format off
/// The model of a body that has flowed; as make_model(), and initial stress acts as before the flow. It keeps what
/// it needs of `state`, which must fit or be empty. @throws what make_model() and check_flow() throw.
[[nodiscard]] std::unique_ptr<ForceModel> make_flowed_model(const ModelChoice& choice,
                                                            std::span<const ElementBlock> blocks,
                                                            const Eigen::Matrix3Xd& rest_nodes,
                                                            const PlasticFlow& state,
                                                            std::shared_ptr<const double> prestress_share = nullptr);
// clang-format on
/// Accumulated √(2/3) |log of F_p's stretch| of every point, block by block: how far it has flowed from where it
/// began, not how long its way was.
[[nodiscard]] std::vector<std::vector<double>> plastic_strain(const PlasticFlow& state);

}  // namespace argil::fem
