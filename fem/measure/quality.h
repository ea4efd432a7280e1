#pragma once
// Shape of cells as integration sees it: Jacobians at quadrature points, never at corners (METHODS §1).

#include <Eigen/Core>
#include <span>

#include "fem/element_block.h"
#include "subdiv/solid.h"

namespace argil::fem {

struct WorstJacobian {
  double value = 1;  // 1 where a cell is a parallelepiped or tetrahedron, ≤ 0 where it is inverted
  subdiv::CellId cell;
};
/// The smallest Jacobian at a quadrature point over the cell's mean one: 2×2×2 Gauss in hexahedra; the others are
/// cut into tetrahedra from the middle over their fanned faces, and a tetrahedron counts against the mean of its
/// cell (of one that is inverted as a whole, −1). Cost O(corners).
[[nodiscard]] WorstJacobian min_relative_jacobian(const subdiv::Solid& solid, const Eigen::Matrix3Xd& positions);

/// The smallest det F over the quadrature points that give stiffness: present over rest volume, 1 at rest, ≤ 0
/// where the material is inside out. `nodes` are present positions, 3 x nodes of the table. 1 without points. Cost
/// O(points), in parallel.
[[nodiscard]] double min_volume_ratio(std::span<const ElementBlock> blocks, const Eigen::Matrix3Xd& nodes);

}  // namespace argil::fem
