#pragma once
// Extrusion of boundary faces of any size (papers/004 §3.1: how a coarse solid is built), within a transaction.

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
/// vector. Faces that touch only at a vertex keep touching along the edge that it leaves behind.
///
/// Sharpness: edges and corners of the region pass theirs on to the last caps and keep it while they are boundary;
/// what becomes interior loses it. A corner (a sharp vertex, or one where three or more sharp edges meet) leaves
/// sharp edges behind it along the walls; the rings between steps stay smooth. So a leg from the sharp corner of a
/// box continues the corner's edge, and what lay smooth within a face stays smooth. A sharp sheet that ends at an
/// edge within the region goes on through the walls above it.
///
/// @throws Error before anything is changed: (bad_input) for no faces, a face given twice or steps < 1; (not_found)
/// for a dead face; (bad_topology) for an interior face, and where faces of the region meet at an edge of a
/// non-manifold boundary so that their walls would lie on the same side of one another. Cost O(new corners).
[[nodiscard]] Extrusion extrude(Transaction& transaction, std::span<const FaceId> faces, int steps);

/// Throws as `extrude` would; of the steps and walls the second says nothing.
void check_extrusion(const Solid& solid, std::span<const FaceId> faces, int steps);
void check_boundary_faces(const Solid& solid, std::span<const FaceId> faces);
/// How sharp the edge is that a vertex of the boundary leaves behind as it moves: a corner's, or 0.
[[nodiscard]] double trail_sharpness(const Solid& solid, VertexId v);

}  // namespace argil::subdiv
