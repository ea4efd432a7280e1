#pragma once
// The seam between physics and time: forces, tangents and energy of the nodes, and what a model promises.
// Integrators and solvers know only this. All functions are const in meaning and give the same bits for any number
// of threads.

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "fem/element_block.h"

namespace argil::fem {

enum class Projection { none, positive_semidefinite };

struct Promises {
  bool has_energy = true;
  bool conserves_momentum = true;  // sums of force and of moment vanish
  bool rotation_invariant = true;
  double largest_rotation = 1e300;  // [rad] beyond which it is wrong
  bool exact_tangent = true;        // unprojected, −∂f/∂x
  bool symmetric_tangent = true;
  bool passes_patch_test = true;       // an affine motion leaves no force at interior nodes
  bool rest_tangent_is_linear = true;  // at rest, that of linear elasticity in the same formulation
  /// A cell that has turned inside out does not find back by itself: the guard takes such a step back.
  bool inversion_is_error = false;
};

/// The tangent at one state. stiffness_product gives ∂²Ψ/∂x² dx (= −∂f/∂x dx), 3 x nodes.
class Tangent {
 public:
  virtual ~Tangent() = default;
  virtual void stiffness_product(const Eigen::Matrix3Xd& dx, Eigen::Matrix3Xd& result) const = 0;
  /// Calls visit(nodes, K) for every element in a fixed order, in one thread; K is 3n x 3n, node-major (3 a +
  /// axis).
  using Visit = std::function<void(std::span<const std::uint32_t> nodes, const Eigen::MatrixXd& stiffness)>;
  virtual void element_tangents(const Visit& visit) const = 0;
};

class ForceModel {
 public:
  virtual ~ForceModel() = default;
  virtual std::string_view name() const = 0;
  virtual Promises promises() const = 0;
  virtual double energy(const Eigen::Matrix3Xd& x) const = 0;  // [J]
  /// Internal forces −∂Ψ/∂x [N], 3 x nodes, overwriting `forces`.
  virtual void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const = 0;
  virtual std::unique_ptr<Tangent> tangent(const Eigen::Matrix3Xd& x, Projection projection) const = 0;
  /// Forces that depend on velocity; zero by default.
  virtual void velocity_forces(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& v,
                               Eigen::Matrix3Xd& forces) const {
    (void)v;
    forces.setZero(3, x.cols());
  }
};

/// Ψ = μ|F−R|² + λ/2 (tr(RᵀF) − 3)² per quadrature point, R from the polar decomposition with det R = +1 (METHODS
/// §4). The blocks must outlive the model: nodes and rest geometry are taken now, mu and lambda are read at each
/// call, so that painting needs no new model; a tangent keeps the material that it was made with. `rest_nodes` is
/// 3 x nodes. The functions of one model, and those of one tangent, share working memory: one call at a time.
[[nodiscard]] std::unique_ptr<ForceModel> make_corotational(std::span<const ElementBlock> blocks,
                                                            const Eigen::Matrix3Xd& rest_nodes);
/// Small-strain linear elasticity in fixed axes: a reference, wrong under rotation.
[[nodiscard]] std::unique_ptr<ForceModel> make_linear(std::span<const ElementBlock> blocks,
                                                      const Eigen::Matrix3Xd& rest_nodes);

}  // namespace argil::fem
