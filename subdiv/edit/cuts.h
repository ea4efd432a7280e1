#pragma once
// What the splitting edits share: vertices set on edges, faces and cells parted, and the cells beside them that
// keep whole but get the cut edges and faces in their loops, so that no vertex hangs.

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "subdiv/edit/edit.h"

namespace argil::subdiv {

using Loop = std::vector<VertexId>;

struct Cuts {
  std::map<EdgeId, VertexId> edges;                        // a new vertex inside the edge
  std::map<FaceId, std::vector<Loop>> faces;               // parts of a face, seen as its front use sees it
  std::map<CellId, std::vector<std::vector<Loop>>> cells;  // outward loops of each part of a cell
};

/// The loop of a face with the vertices that its edges got.
[[nodiscard]] Loop loop_with_cuts(const Solid& solid, const Cuts& cuts, FaceId face);

/// Parts what is cut and rebuilds the cells about it; sharpness and descent follow as in `rewrite`.
/// @returns the parts of each cut cell, in the order given.
/// @throws Error (bad_topology) naming a cell of which a part, or which itself, would not be a sphere, and where
/// the cells about a vertex would make no ball; the caller then abandons the transaction. Cost O(cells cut and
/// about them).
std::map<CellId, std::vector<CellId>> apply_cuts(Transaction& transaction, const Cuts& cuts, Edit& edit);

/// `next`, done after `edit`, becomes part of it: what `next` blends or descends from is told by what was there
/// before both.
void append_edit(Edit& edit, Edit next);

/// Adds a vertex in the middle of others, and says so in `edit`.
VertexId add_mean(Transaction& transaction, std::span<const VertexId> of, Edit& edit);
VertexId add_blend(Transaction& transaction, std::vector<std::pair<VertexId, double>> sources, Edit& edit);

/// The ids in ascending order. @throws Error (bad_input) if there are none, (not_found) for one that is not there
/// or given twice.
[[nodiscard]] std::vector<CellId> checked(const Solid& solid, std::span<const CellId> cells);
[[nodiscard]] std::vector<EdgeId> checked(const Solid& solid, std::span<const EdgeId> edges);

}  // namespace argil::subdiv
