#pragma once
// The kernel of the edits that join: vertices become one, and the cells that hold them follow. Faces that come to
// have the same vertices are glued; what merging, welding and collapsing share.

#include <span>
#include <utility>
#include <vector>

#include "subdiv/edit/edit.h"

namespace argil::subdiv {

/// Vertices that become one, ascending, two or more; the first is kept.
using Joined = std::vector<VertexId>;

/// The groups that pairs make when followed from one to the next, by their first vertices.
[[nodiscard]] std::vector<Joined> joined(std::span<const std::pair<VertexId, VertexId>> pairs);

enum class Flattening {
  refused,  // a cell keeps all its vertices apart
  allowed   // a face of two vertices left goes; so do two faces of a cell that come to lie on each other, and a
            // cell of which nothing is left: its neighbours are glued
};

/// Makes each group one vertex; placing it is the caller's. Sharpness and descent follow (rewrite.h).
/// @throws Error (bad_topology) naming the cell that would touch or overlap itself or another, or the vertex whose
/// cells would not close to a ball, and what to do; the caller then abandons the transaction. Cost O(cells at the
/// vertices that go, and about them).
void identify(Transaction& transaction, std::span<const Joined> groups, Flattening flattening, Edit& edit);

}  // namespace argil::subdiv
