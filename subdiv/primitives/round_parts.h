#pragma once
// What the round base shapes share.

#include "subdiv/primitives/round.h"

namespace argil::subdiv {

/// How far the core's sides bulge from straight (0) to round (1): its corners stay open, and the rings' too.
inline constexpr double k_bulge = 0.4;
/// From the middle to the core's corners, against the whole, so that core cells and rings are about as thick.
inline double core_radius(int side, int rings) {
  return side / (side + 1.3 * rings);
}

inline void end_cell(CellLists& lists, CellKind kind) {
  lists.kinds.push_back(kind);
  lists.offsets.push_back(lists.connectivity.size());
}

/// @throws Error (bad_input) naming `what`.
void check_length(double length, const char* what);
/// @throws Error (bad_input, limit_exceeded).
void check_grid(const RoundGrid& grid, double cells, int least_along, bool in_quarters);

}  // namespace argil::subdiv
