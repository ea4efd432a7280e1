#pragma once
// Base shapes of flat sides; primitives/ has the round ones and the regular bodies. These stand with their lowest
// corner at the origin.

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

/// Makes the edges that only one cell holds infinitely sharp: of a base shape its edges and rims (a sphere and a
/// torus have none). Returns how many. Cost O(edges).
std::size_t sharpen_outline(Solid& solid);

}  // namespace argil::subdiv
