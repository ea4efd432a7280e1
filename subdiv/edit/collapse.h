#pragma once
// Edges, faces and cells that shrink to a point; what they leave flat goes, and its neighbours are glued.

#include <Eigen/Core>
#include <span>

#include "subdiv/edit/edit.h"

namespace argil::subdiv {

/// Each edge (face, cell) to a point; those that share vertices go to one together. The point is their middle, or
/// stands where the most fixed of the vertices is, at the mean of several: an anchor (as the caller says), else a
/// corner (sharp, or of three sharp edges or more), else one on a crease. A hexahedron that loses an edge becomes a
/// polyhedron; a cell that loses its volume vanishes, and the faces on both sides are glued.
/// @throws Error, the transaction to be abandoned: (bad_input) for none, (not_found) for a dead one, (bad_topology)
/// as identify, or where no cell would be left. Cost as identify.
[[nodiscard]] Edit collapse(Transaction& transaction, std::span<const EdgeId> edges,
                            std::span<const VertexId> anchors = {});
[[nodiscard]] Edit collapse(Transaction& transaction, std::span<const FaceId> faces,
                            std::span<const VertexId> anchors = {});
[[nodiscard]] Edit collapse(Transaction& transaction, std::span<const CellId> cells,
                            std::span<const VertexId> anchors = {});

}  // namespace argil::subdiv
