#pragma once
// Which cells are tricubic, and their 4×4×4 nets (papers/004 §3.4.4, Fig. 6; METHODS §2). Beyond the paper, cells
// at a regular boundary are too, with a phantom layer p₋₁ = 2p₀ − p₁ on each boundary side; with sharp box edges
// and corners also those with sides in two and three directions.

#include <array>
#include <vector>

#include "subdiv/solid.h"
#include "subdiv/stencils.h"

namespace argil::subdiv {

enum class CellClass : std::uint8_t {
  irregular,         // not a hexahedron
  extraordinary,     // a hexahedron without a 64-net
  regular_boundary,  // a hexahedron with a net that needs phantoms
  regular_published  // interior, regular by the paper's criterion
};

[[nodiscard]] CellData<CellClass> classify_cells(const Solid& solid);

/// The nets of the cells with class regular_*. Net index 16i + 4j + k with i along u; the cell lies between net
/// indices 1 and 2 of each direction; origin (1,1,1) at the cell's vertex of lowest id, right-handed (u, v, w) in
/// the sense of outward faces, u towards that vertex' lowest-id neighbour.
struct RegularNets {
  std::vector<CellId> cells;  // ascending
  std::vector<std::array<std::uint32_t, 64>>
      nodes;          // < vertex_capacity: a vertex; above: phantom row + vertex_capacity
  Stencils phantoms;  // in vertices of the same solid; shared between cells
};
[[nodiscard]] RegularNets regular_nets(const Solid& solid, const CellData<CellClass>& classes);

/// The eight vertices of a hexahedron as a box: index 4i + 2j + k, in the same frame as the nets. VTK's order is
/// {0, 4, 6, 2, 1, 5, 7, 3} of it.
[[nodiscard]] std::array<VertexId, 8> box_vertices(const Solid& solid, CellId hexahedron);

}  // namespace argil::subdiv
