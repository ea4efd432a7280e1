#pragma once
// Gmsh's element types by number, and how the corners of those we hold go over to VTK's order.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "subdiv/cell_lists.h"

namespace argil::io {

struct GmshElement {
  int type;
  int dimension;
  int order;  // 0: not a matter of order, but not held
  std::size_t nodes;
  std::string_view name;
};
/// The types that are known by name, held or not; null for another number.
[[nodiscard]] const GmshElement* find_gmsh_element(std::int64_t type);

struct GmshCell {
  int type;
  subdiv::CellKind kind;
  std::array<std::uint8_t, 8> vtk_from_gmsh;
};
inline constexpr std::array k_gmsh_cells{
    GmshCell{4, subdiv::CellKind::tetrahedron, {0, 1, 2, 3}},
    GmshCell{5, subdiv::CellKind::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}},
    GmshCell{6, subdiv::CellKind::wedge, {0, 2, 1, 3, 5, 4}},
    GmshCell{7, subdiv::CellKind::pyramid, {0, 1, 2, 3, 4}},
};
[[nodiscard]] const GmshCell& gmsh_cell(subdiv::CellKind kind);

}  // namespace argil::io
