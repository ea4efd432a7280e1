#pragma once
// Cells of a file that are inside out: their corners, in the order of the file, enclose a negative volume. Asked of
// the lists, since such cells next to sound ones do not make a solid.

#include <cstdint>
#include <vector>

#include "subdiv/cell_lists.h"

namespace argil::subdiv {

/// Numbers of the cells of negative volume (faces fanned about the mean of their vertices), ascending. All vertices
/// must be in range. Cost O(corners).
[[nodiscard]] std::vector<std::size_t> inside_out_cells(const CellLists& lists);

/// Mirrors the order of a cell's corners, which turns it inside out; the points stay where they are.
void turn_inside_out(CellLists& lists, std::size_t cell);

}  // namespace argil::subdiv
