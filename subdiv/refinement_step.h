#pragma once
// One refinement step (paper 004 §3.1, METHODS §1): every cell splits about its centroid, a corner with k edges
// giving a cell of 2k quadrilaterals. The step is linear in the control points, so it is returned as stencils.

#include "subdiv/progress.h"
#include "subdiv/rule_set.h"
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

/// Refines `coarse` once. Inside by the scheme; on the skin (skin.h: boundary and sharp sheets) by the scheme's
/// rules of a surface, with creases and corners; semi-sharp as OpenSubdiv 3.5, uniform creasing. Every part of a
/// sharp edge or face is one less sharp than it was.
/// @throws Error (bad_topology) naming an edge inside with fewer than 3 faces, a smooth vertex of the skin with
/// fewer than 3 edges there, or an element that no cell holds; (unsupported) naming an edge or vertex inside that
/// is sharp and on no sheet. Cost O(cell corners); the result does not depend on the number of threads.
[[nodiscard]] RefinementStep refine(const Solid& coarse, RuleSet rules = RuleSet::maccracken_joy,
                                    const Progress& progress = {});

/// compose() of stencils.h for large ones, which tells how far it has got.
[[nodiscard]] Stencils compose(const Stencils& fine, const Stencils& coarse, const Progress& progress);

}  // namespace argil::subdiv
