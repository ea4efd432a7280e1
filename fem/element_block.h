#pragma once
// Elements of one kind, together in arrays: which nodes each names, and per quadrature point its rest geometry and
// material. No virtual call inside a loop over them.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "fem/elements/element_kind.h"

namespace argil::fem {

/// Where an element came from, for fields, messages and pictures.
struct ElementOrigin {
  std::uint16_t level = 0;
  std::uint32_t cell = 0;  // cell of that level
  std::uint32_t part = 0;  // which pyramid of the cell
};

struct ElementBlock {
  const ElementKind* kind = nullptr;
  std::vector<std::uint32_t> nodes;    // [element * node_count + node], rows of the node table
  std::vector<ElementOrigin> origins;  // [element]
  // Per [element * point_count + point]:
  std::vector<Eigen::Matrix3d> inverse_rest_jacobians;  // ∂(u,v,w)/∂X
  std::vector<double> volumes;                          // weight · det(∂X/∂(u,v,w)) [m³]
  std::vector<double> mu, lambda;                       // [Pa]; both 0 where the point gives no stiffness
  std::vector<double> density;                          // [kg/m³]
  std::vector<double> damping;                          // [1/s]
  // Empty where they are zero everywhere:
  std::vector<double> stiffness_damping;  // Rayleigh: viscous stress = this · rate of elastic stress [s]
  std::vector<double> prestress;  // initial second Piola–Kirchhoff stress, the same in all directions [Pa]

  std::size_t element_count() const { return origins.size(); }
  std::size_t point_index(std::size_t element, int point) const {
    return element * static_cast<std::size_t>(kind->point_count) + static_cast<std::size_t>(point);
  }
};

/// Fills inverse_rest_jacobians and volumes from rest node positions (3 x nodes of the table). Material arrays are
/// resized and left as they are. Returns the index of the first point whose Jacobian is not positive, or npos.
inline constexpr std::size_t k_no_point = static_cast<std::size_t>(-1);
[[nodiscard]] std::size_t set_rest_geometry(ElementBlock& block, const Eigen::Matrix3Xd& rest_nodes);

}  // namespace argil::fem
