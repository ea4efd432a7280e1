#pragma once
// Another solid, or copies of cells, beside what is there, within a transaction.

#include <map>
#include <span>

#include "subdiv/build.h"
#include "subdiv/edit/edit.h"

namespace argil::subdiv {

/// Adds a whole solid with its sharpness as cells of its own; its vertices are placed without sources. The new
/// cells are what to go on with. Cost O(other).
[[nodiscard]] Edit join(Transaction& transaction, const Built& other);

/// Every copy with what it is a copy of, in order of the cells.
struct CopiedCells {
  std::map<VertexId, VertexId> copy_from_vertex;  // as given, and a new vertex for each of the rest
  std::vector<Descent<EdgeId>> edges;
  std::vector<Descent<FaceId>> faces;
  std::vector<Descent<CellId>> cells;
};
/// Adds a copy of each cell; copies of neighbours are neighbours. `shared` says which vertices stand for others,
/// or for themselves: what copies and cells have in common is then one. `mirrored` cells are turned inside out, as
/// the copy's positions are. Sharpness follow to what is new; what becomes interior is smooth but for sharp sheets.
/// @throws Error (bad_topology) where a shared face has no side left, or the cells about a shared vertex would make
/// no ball. Cost O(cells given, log).
[[nodiscard]] CopiedCells copy_cells(Transaction& transaction, std::span<const CellId> cells,
                                     const std::map<VertexId, VertexId>& shared = {}, bool mirrored = false);

}  // namespace argil::subdiv
