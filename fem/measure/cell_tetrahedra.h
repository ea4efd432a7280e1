#pragma once
// Cells cut into tetrahedra, to look up values anywhere inside a body: from the middle of each cell over its faces,
// each fanned about its own middle (the mean of its vertices, as SESSION.md measures volume and pictures draw
// faces). The cut follows no numbering, neighbours agree on it, and a field that is linear in space is
// reproduced exactly; of a trilinear one it keeps the values at vertices, and the middles of cells and faces.

#include <array>
#include <cstdint>
#include <vector>

#include "subdiv/solid.h"
#include "subdiv/stencils.h"

namespace argil::fem {

struct CellTetrahedra {
  subdiv::Stencils points;  // rows: the vertices by id, then middles; columns: vertices. subdiv::apply gives values
  std::vector<std::array<std::uint32_t, 4>> corners;  // points; of positive volume where the cell is not inside out
  std::vector<std::uint32_t> cells;                   // the cell of each
};

/// Of the cells with kept != 0; empty: of all. 24 a hexahedron. Cost O(corners).
[[nodiscard]] CellTetrahedra cell_tetrahedra(const subdiv::Solid& solid,
                                             const subdiv::CellData<std::uint8_t>& kept = {});

}  // namespace argil::fem
