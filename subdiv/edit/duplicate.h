#pragma once
// Copies of cells in a row, along a circle or along a screw, within a transaction.

#include <Eigen/Geometry>
#include <span>

#include "subdiv/edit/edit.h"

namespace argil::subdiv {

/// Adds `count` copies of the cells as solids of their own, each where `step` takes the one before (the first, the
/// cells themselves). Every vertex is placed with one source. The copies are what to go on with; no set gets them.
/// @throws Error (bad_input) for no cells, count < 1, a step that moves nothing or turns inside out; (not_found)
/// naming a dead cell. Cost O(count · cells given).
[[nodiscard]] Edit duplicate(Transaction& transaction, std::span<const CellId> cells, int count,
                             const Eigen::Affine3d& step);

}  // namespace argil::subdiv
