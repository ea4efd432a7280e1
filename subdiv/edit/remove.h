#pragma once
// Removal of cells, within a transaction.

#include <span>

#include "subdiv/transaction.h"

namespace argil::subdiv {

/// Removes the cells and the faces, edges and vertices that no other cell holds; faces between a removed cell and
/// one that stays become boundary, and leave the sheets that they were of.
/// @throws Error (not_found) naming a cell that is not there or given twice, before anything is changed.
void remove_cells(Transaction& transaction, std::span<const CellId> cells);

}  // namespace argil::subdiv
