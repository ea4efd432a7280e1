#pragma once
// Cells as trilinear hexahedra and, where they are none, as a pyramid over each face with the virtual centre as
// apex (papers/004 §3.4.3).

#include "fem/element_block.h"
#include "subdiv/solid.h"
#include "subdiv/stencils.h"

namespace argil::fem {

/// Cells meshed linearly: of which solid, and which of them.
struct LinearCells {
  const subdiv::Solid* solid = nullptr;
  int level = 0;
  std::vector<subdiv::CellId> cells;  // ascending
};

/// Hexahedra and pyramids in the vertices of their solid; a pyramid's apex is the number of its virtual centre.
struct LinearMesh {
  std::vector<std::uint32_t> hexahedra, pyramids;  // 8 and 5 an element
  std::vector<ElementOrigin> hexahedron_origins, pyramid_origins;
  subdiv::Stencils centres;  // virtual centres in the vertices
};

/// @throws Error (unsupported) naming a cell with a face that is not a quadrilateral, which only level 0 has.
[[nodiscard]] LinearMesh mesh_linearly(const LinearCells& from);
/// @throws as above, for the cells of the whole solid.
void check_quadrilaterals(const subdiv::Solid& solid);

}  // namespace argil::fem
