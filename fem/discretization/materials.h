#pragma once
// Fields to quadrature points, and the consistent mass and damping in the control points.

#include "fem/discretization.h"

namespace argil::fem {

/// Corners from which a field in an element of this kind is interpolated: 5 of a pyramid, else 8.
[[nodiscard]] int field_corner_count(const ElementKind& kind);

/// Fills the material arrays of all blocks, marks the pyramids without stiffness, and assembles mass, damping and
/// totals. Rest geometry and field samples must be there.
/// @throws what lame() throws.
void set_materials(Discretization& discretization, const NodalFields& fields, const Progress& progress = {});

}  // namespace argil::fem
