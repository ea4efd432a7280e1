#pragma once
// Limit positions of vertices (METHODS §1): (1/6, 4/6, 1/6)³ at regular interior vertices, Catmull–Clark's masks on
// the skin, and at an extraordinary vertex the left eigenvector, for eigenvalue 1, of its local refinement matrix,
// computed once per neighbourhood type. Where something is semi-sharp, the cells at the vertex are refined until it
// no longer is, so the limit is exact there too.

#include "subdiv/progress.h"
#include "subdiv/rule_set.h"
#include "subdiv/solid.h"
#include "subdiv/stencils.h"

namespace argil::subdiv {

/// Row v = the limit position of vertex v in the vertices of the same level (rows of dead ids are empty). The row
/// goes through one refinement of what lies about v, so that any kind of cell may lie there. At the end of a lone
/// sharp edge the limit is a left eigenvector too; OpenSubdiv takes the smooth mask there. Every row sums to one.
/// Cost O(cell corners), one factorisation a kind of extraordinary neighbourhood, and up to 10 refinements of the
/// cells at a semi-sharp vertex.
/// @throws what refine() throws.
[[nodiscard]] Stencils limit_stencils(const Solid& solid, RuleSet rules = RuleSet::maccracken_joy,
                                      const Progress& progress = {});

}  // namespace argil::subdiv
