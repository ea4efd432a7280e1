#pragma once
// What a rewrite is about to add, looked at before anything changes, so that a refusal can say what to do; and what
// no rewrite may leave.

#include "subdiv/edit/rewrite.h"

namespace argil::subdiv {

/// @throws Error (bad_topology) naming the first new cell whose loops do not close to one sphere, or the two cells
/// that would lie on the same side of one face. Cost O(new corners, log).
void check_new_cells(const Solid& solid, const Rewrite& change);

/// @throws Error (bad_topology) if the cells at one of the vertices belong to a part without any boundary face,
/// which has no room in space. Dead vertices are passed over. Cost O(cells until a boundary face is met).
void check_boundary_left(const Solid& solid, std::span<const VertexId> vertices);

}  // namespace argil::subdiv
