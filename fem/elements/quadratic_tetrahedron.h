#pragma once
// The ten-node tetrahedron: the reference that shares neither shape functions nor quadrature with the elements that
// a sculptor uses.

#include "fem/elements/element_kind.h"

namespace argil::fem {

/// Corners 0–3 at (0,0,0), (1,0,0), (0,1,0), (0,0,1) of the reference simplex, then the middles of the edges 01,
/// 12, 02, 03, 13, 23. Four Gauss points, exact for degree 2: the stiffness of a tetrahedron with straight edges.
/// `weights` sum to 1/6, the volume of the simplex.
[[nodiscard]] const ElementKind& quadratic_tetrahedron();

}  // namespace argil::fem
