#pragma once
// The points by which a body's boundary meets obstacles: nodes of the finest level, middles of edges and of faces,
// with the area that is theirs by Simpson's rule over the bilinear quadrilaterals of the rest shape. So a corner
// that touches first is felt, a uniform pressure gives its exact nodal forces, and what is narrower than half a
// face of the finest level may slip between the points.

#include <vector>

#include "fem/discretization.h"
#include "subdiv/stencils.h"

namespace argil::fem {

/// Pressure a depth of an obstacle without a stiffness of its own: this times Young's modulus over the size of a
/// face. Under any pressure the surface then sinks in by a tenth of what a cell as deep as the face is wide gives
/// way itself, less than what the mesh resolves, while no system gets stiffer than by about that factor.
inline constexpr double k_contact_stiffness = 10;

struct ContactSurface {
  subdiv::Stencils rows;          // point = rows * control points
  std::vector<double> areas;      // [m²], of the rest shape
  std::vector<double> stiffness;  // pressure a depth by the rule [Pa/m]
  std::size_t point_count() const { return areas.size(); }
};

/// `finest` is the solid at the finest level, `young_modulus` [Pa] by its vertex ids. Cost O(boundary).
/// @throws Error (bad_input) naming a boundary face that is not a quadrilateral.
[[nodiscard]] ContactSurface contact_surface(const Discretization& discretization, const subdiv::Solid& finest,
                                             const Eigen::VectorXd& young_modulus);

}  // namespace argil::fem
