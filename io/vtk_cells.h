#pragma once
// Cells as VTK's files number them, and their way into and out of cell lists. Hexahedra, tetrahedra, wedges,
// pyramids and polyhedra are held; voxels are read as hexahedra; every other kind is refused by name.

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "subdiv/cell_kinds.h"
#include "subdiv/cell_lists.h"

namespace argil::io {

/// Cell c has types[c] and connectivity[offsets[c] … offsets[c+1]); of a polyhedron that is its face stream.
struct VtkCells {
  std::vector<std::int64_t> types;
  std::vector<std::size_t> offsets{0};
  std::vector<std::int64_t> connectivity;
  /// Where in the file a type, or a number of the connectivity, stands; asked only for messages.
  std::function<std::string(std::size_t)> where_type, where_number;
};

/// Appends `cells` to `lists`, whose positions are there already.
/// @throws Error (unsupported) for another kind of cell, by name; (bad_input) for a wrong number of vertices, a
/// vertex out of range or a face stream that does not fit. Cost O(connectivity).
void append_vtk_cells(const VtkCells& cells, subdiv::CellLists& lists);

/// What another format calls a kind of cell, and where its vertices stand in ours (which is VTK's order).
struct NamedCellKind {
  std::string_view word;
  subdiv::CellKind kind;
  std::array<std::size_t, 8> vtk_from_file;
};

[[nodiscard]] int vtk_type(subdiv::CellKind kind);
/// "hexahedra", …
[[nodiscard]] std::string plural_name(subdiv::CellKind kind);

}  // namespace argil::io
