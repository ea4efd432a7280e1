#pragma once
// Base shapes. All stand with their lowest corner at the origin.

#include "subdiv/build.h"

namespace argil::subdiv {

/// A grid of nx × ny × nz hexahedra of the given size [m]. Vertex (i, j, k) has id (k (ny+1) + j) (nx+1) + i, cell
/// (i, j, k) id (k ny + j) nx + i.
/// @throws Error (bad_input) for a count below 1 or a size that is not positive and finite.
[[nodiscard]] Built box_grid(int nx, int ny, int nz, const Eigen::Vector3d& size);
/// Tetrahedron, wedge (triangular prism along z) and pyramid (square base) inscribed in the size.
[[nodiscard]] Built tetrahedron(const Eigen::Vector3d& size);
[[nodiscard]] Built wedge(const Eigen::Vector3d& size);
[[nodiscard]] Built pyramid(const Eigen::Vector3d& size);

}  // namespace argil::subdiv
