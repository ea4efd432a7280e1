#pragma once
// Local subdivision: cells split about their centres as a MacCracken–Joy step does (papers/004 §3.1), but every
// point stands in the middle of what it splits, so that the shape stays.

#include <span>

#include "subdiv/edit/edit.h"

namespace argil::subdiv {

/// Each cell gives one at each of its corners: where k edges meet, a cell of 2k quadrilaterals (a hexahedron gives
/// 8 hexahedra). Edges, faces and cells get a vertex at the mean of their own; a face that two of the cells share
/// splits once. Cells beside them keep whole and get the cut edges and faces, so that no vertex hangs. `next_cells`
/// are the new cells.
/// @throws Error before anything is changed: as `checked` (cuts.h). Cost O(cells and those about them).
[[nodiscard]] Edit split_cells(Transaction& transaction, std::span<const CellId> cells);

}  // namespace argil::subdiv
