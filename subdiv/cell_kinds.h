#pragma once
// The faces of the named kinds of cells in VTK's order of vertices, each counter-clockwise from outside.

#include <cstdint>
#include <span>
#include <string_view>

#include "subdiv/cell_lists.h"

namespace argil::subdiv {

/// Number of vertices of a kind; 0 for a polyhedron.
[[nodiscard]] std::size_t vertex_count(CellKind kind);
/// Faces as local vertex numbers, each preceded by its size; empty for a polyhedron. The first triangle of a wedge,
/// 0 1 2, faces outward, as VTK documents it (many other formats have it inward).
[[nodiscard]] std::span<const std::uint8_t> face_table(CellKind kind);
[[nodiscard]] std::string_view name(CellKind kind);

}  // namespace argil::subdiv
