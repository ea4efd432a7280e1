#pragma once
// One MacCracken–Joy refinement step (paper 004 §3.1, METHODS §1): every cell splits about its centroid, a corner
// with k edges giving a cell of 2k quadrilaterals. The step is linear in the control points, so it is returned as
// stencils.

#include "subdiv/solid.h"
#include "subdiv/stencils.h"

namespace argil::subdiv {

/// Fine vertices stand in this order: one for each coarse vertex, edge, face, cell (live ones, ascending).
struct RefinementStep {
  Solid fine;         // topology and sharpness of the next level; all ids live
  Stencils stencils;  // fine positions = stencils * coarse positions; columns are coarse vertex ids (capacity)
  CellData<CellId> coarse_from_fine;    // parent cell
  CellData<VertexId> corner_from_fine;  // the parent's vertex at whose corner the fine cell lies
  std::size_t first_edge_point = 0, first_face_point = 0, first_cell_point = 0;
};

/// Refines `coarse` once. Rules: interior as MacCracken–Joy; boundary, sharp edges and corners (infinite) as
/// Catmull–Clark on the boundary surface alone; an edge with more than two boundary faces is sharp, a vertex where
/// boundary sheets touch is a corner, or a crease if they touch along the two sharp edges that run through it.
/// @throws Error (bad_topology) naming an interior edge with fewer than 3 faces, a smooth boundary vertex of
/// valence 2, or an element that no cell holds; (unsupported) naming a semi-sharp or an interior sharp edge or
/// vertex. Cost O(cell corners); the result does not depend on the number of threads.
[[nodiscard]] RefinementStep refine(const Solid& coarse);

/// How the boundary rules see an edge or vertex of the boundary.
[[nodiscard]] bool is_sharp(const Solid& solid, EdgeId boundary_edge);  // tagged, or non-manifold
enum class BoundaryVertexRule { smooth, crease, corner };
[[nodiscard]] BoundaryVertexRule boundary_vertex_rule(const Solid& solid, VertexId boundary_vertex);

}  // namespace argil::subdiv
