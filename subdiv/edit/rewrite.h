#pragma once
// The kernel of the edits that change cells: some cells are replaced by others at one go, and sharpness and descent
// follow. What the old and the new cells share keeps its id.

#include <map>
#include <span>
#include <vector>

#include "subdiv/edit/edit.h"

namespace argil::subdiv {

struct NewCell {
  std::vector<std::vector<VertexId>> loops{};  // each counter-clockwise from outside
  CellId source{};                             // invalid: of none
};

struct Rewrite {
  std::vector<CellId> removed{};
  std::vector<NewCell> added{};
  std::map<VertexId, VertexId> replaced{};              // gone → kept
  std::map<EdgeId, std::vector<VertexId>> cut_edges{};  // vertices on an old edge, from its first end to its second
  std::vector<std::pair<std::vector<VertexId>, FaceId>>
      cut_faces{};              // a loop of a new face, and what it is a part of
  std::vector<FaceId> glued{};  // faces of cells that stay: swept, and what they were passes on, like those removed
};

/// Removes cells, adds cells, and sweeps what nothing holds any more. An old edge (face) whose vertices are
/// replaced or which is cut passes its sharpness on, the larger one where several meet; what becomes interior and
/// lies on no sharp sheet is smooth. Appends descent and merged vertices to `edit`; placing vertices is the
/// caller's.
/// @throws Error (bad_topology) as Transaction::add_cell, and where the cells about a vertex would make neither
/// balls nor half balls (link_fault). The caller then abandons the transaction. Cost O(cells replaced and about
/// them).
void rewrite(Transaction& transaction, const Rewrite& change, Edit& edit);

/// 0 for edges and vertices of these that are interior and on no sharp face.
void drop_interior_sharpness(Transaction& transaction, std::span<const VertexId> vertices);

/// The outward loops of a cell.
[[nodiscard]] std::vector<std::vector<VertexId>> cell_loops(const Solid& solid, CellId cell);

/// Cells about a vertex, joined by faces, make fans; each fan's link (a polygon a cell, glued along faces) must be
/// a sphere or a sphere with holes. Empty if so; else what is wrong. Cost O(neighbourhood, log).
[[nodiscard]] std::string link_fault(const Solid& solid, VertexId vertex);
/// @throws Error (bad_topology) with the first fault among these vertices.
void check_links(const Solid& solid, std::span<const VertexId> vertices);

}  // namespace argil::subdiv
