#pragma once
// Smoothing of positions: every vertex towards the mean of its neighbours, the boundary along the boundary, creases
// along creases. By Taubin's two steps (1995: one inwards, a slightly larger one outwards) the boundary loses bumps
// without shrinking; by the first step alone it rounds and shrinks.

#include <span>
#include <vector>

#include "subdiv/guarded_motion.h"

namespace argil::subdiv {

struct SmoothOptions {
  int times = 1;
  double amount = 1;    // 0 … 1
  bool shrink = false;  // the first step alone
};

/// Where a vertex smooths to: along an interior vertex's edges; on the boundary along its edges in the boundary; on
/// a crease along the crease. Nothing for what stays: corners, where three creases meet, and interior sharp sheets.
[[nodiscard]] std::vector<VertexId> smoothing_neighbours(const Solid& solid, VertexId vertex);

/// Smooths the vertices of `motion` that are given; no corner of a cell closes. Cost O(times · vertices).
void smooth(const Solid& solid, GuardedMotion& motion, std::span<const VertexId> vertices,
            const SmoothOptions& options = {});

}  // namespace argil::subdiv
