#pragma once
// Damping in proportion to stiffness (Rayleigh), by a field β [s]: at each quadrature point a second
// Piola–Kirchhoff stress β C : Ė with Ė = sym(Fᵀ Ḟ), C of isotropic elasticity. At small strain it is β times the
// stiffness, the bar of frequency ω decaying at β ω²/2; at any strain a rigid velocity gives Ė = 0, so that it
// neither slows a spin nor depends on the force model. Linear in the velocity with a positive semi-definite matrix.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fem/element_block.h"
#include "fem/models/force_model.h"

namespace argil::fem {

class ViscousDamping {
 public:
  /// `blocks` must outlive this; geometry, β and material are read at each set_state(). Cost O(elements).
  ViscousDamping(std::span<const ElementBlock> blocks, std::size_t node_count);

  /// False if β is zero everywhere: then there is nothing to call.
  bool present() const { return !parts_.empty(); }
  /// Takes F at these nodes (3 x nodes), until the next call.
  void set_state(const Eigen::Matrix3Xd& x);
  /// −forces [N] of node velocities `v` (3 x nodes) at that state. Uses working memory: one call at a time.
  void product(const Eigen::Matrix3Xd& v, Eigen::Matrix3Xd& result) const;
  /// The matrices of the elements at rest, 3n x 3n node-major, in order (for preconditioners).
  void element_matrices(const Tangent::Visit& visit) const;

 private:
  struct Part {
    const ElementBlock* block;
    std::size_t slot_begin, point_begin;
  };
  std::vector<Part> parts_;
  std::vector<Eigen::Matrix3d> gradients_;  // F per point of the parts
  std::vector<std::size_t> slots_begin_;    // [node], one more ends the last
  std::vector<std::size_t> slots_;          // in columns of forces_
  mutable Eigen::Matrix3Xd forces_;         // per part, element and node
};

}  // namespace argil::fem
