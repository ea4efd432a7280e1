#pragma once
// Removal of cells, and of what they leave, within a transaction.

#include <span>

#include "subdiv/transaction.h"

namespace argil::subdiv {

enum class Dangling { remove, keep };

/// Removes the cells; faces between a removed cell and one that stays become boundary, and leave the sheets that
/// they were of. The faces, edges and
/// vertices that no other cell holds go as well, or are kept to build on (`refine` refuses a solid that has any).
/// @throws Error (not_found) naming a cell that is not there or given twice, before anything is changed.
void remove_cells(Transaction& transaction, std::span<const CellId> cells, Dangling dangling = Dangling::remove);

struct Swept {
  std::size_t faces = 0, edges = 0, vertices = 0;
};
/// Removes every face, edge and vertex that no cell holds. Cost O(solid).
Swept remove_dangling(Transaction& transaction);

}  // namespace argil::subdiv
