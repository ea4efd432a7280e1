#pragma once
// What a rewrite is about to add, looked at before anything changes, so that a refusal can say what to do.

#include "subdiv/edit/rewrite.h"

namespace argil::subdiv {

/// @throws Error (bad_topology) naming the first new cell whose loops do not close to one sphere, or the two cells
/// that would lie on the same side of one face. Cost O(new corners, log).
void check_new_cells(const Solid& solid, const Rewrite& change);

}  // namespace argil::subdiv
