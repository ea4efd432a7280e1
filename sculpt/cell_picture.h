#pragma once
// Cells drawn one by one, as in papers/004, Fig. 1b: with gaps between them, coloured by what decides their
// element.

#include "sculpt/renderer.h"
#include "subdiv/solid.h"

namespace argil::sculpt {

/// Every kept cell by itself, drawn towards the mean of its vertices to `size` (0 … 1] of itself, so that gaps show
/// between the cells. Each has vertices and edges of its own, all sharp. Cost O(solid).
[[nodiscard]] SceneSurface separate_cells(const subdiv::Solid& solid, const Eigen::Matrix3Xd& positions,
                                          double size, const subdiv::CellData<std::uint8_t>& kept = {});

/// Colours the surface of separate cells by what decides their element (papers/004 §3.4): regular, regular at the
/// boundary, extraordinary, irregular; the legend names those that are there.
void show_cell_kinds(Scene& scene, const subdiv::Solid& solid);

}  // namespace argil::sculpt
