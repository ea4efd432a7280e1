#pragma once
// Topology edits within a transaction. Each works on any faces (also non-quadrilaterals) and gives the new
// geometry.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "subdiv/transaction.h"

namespace argil::subdiv {

struct Extrusion {
  std::vector<VertexId> new_vertices;   // in order of creation
  std::vector<VertexId> source_of_new;  // the vertex of the region that each grew from
  std::vector<int> step_of_new;         // 1 … steps
  std::vector<CellId> new_cells;
  std::vector<FaceId> caps;  // the moved faces, in the order of `faces`
};

/// Grows one cell a face and step from a region of boundary faces; neighbouring faces of the region share walls.
/// Positions are the caller's: new vertex i of step s stands where its source stood, moved by s / steps of the
/// vector.
/// @throws Error (bad_topology) for an interior or dead face, or where a wall would meet an existing face wrongly.
[[nodiscard]] Extrusion extrude(Transaction& transaction, std::span<const FaceId> faces, int steps);

}  // namespace argil::subdiv
