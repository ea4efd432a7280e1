#pragma once
// A solid in ten-node tetrahedra, as a reference from outside the family of elements that is sculpted with: every
// cell is split about its centre, every face about its own, so that neighbours agree whatever they are made of.

#include "fem/discretization.h"

namespace argil::fem {

/// `positions` are 3 x vertex capacity of `solid`, `fields` values at its vertices, taken linearly over each
/// tetrahedron (the mean of the corners at centres). The unknowns are the nodes themselves (A = identity): the
/// vertices by their ids, then centres of faces, centres of cells, middles of edges; rest_nodes gives where they
/// are. Mass and damping are exact. Surface patches take the corners of boundary quadrilaterals; fields cannot be
/// updated, and measures that show elements know no tetrahedra. @throws Error (bad_geometry) naming a cell whose
/// centre does not see one of its faces, and what lame() throws. Cost O(tetrahedra), 24 for a hexahedron.
[[nodiscard]] Discretization quadratic_tetrahedra(const subdiv::Solid& solid, const Eigen::Matrix3Xd& positions,
                                                  const NodalFields& fields);

}  // namespace argil::fem
