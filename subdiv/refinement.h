#pragma once
// Refinement to K levels: the solids of all levels and the stencils that lead from the control points to each of
// them.

#include <functional>
#include <vector>

#include "subdiv/refinement_step.h"

namespace argil::subdiv {

struct Refinement {
  RuleSet rules = RuleSet::maccracken_joy;
  std::vector<Solid> levels;             // 0 … K; level 0 is a copy of the control solid
  std::vector<Stencils> stencils;        // level l's vertices in control points, composed; [0] is the identity
  std::vector<Stencils> step_stencils;   // level l's vertices in those of level l − 1; [0] is empty
  std::vector<CellData<CellId>> parent;  // level l's cell → cell of level l − 1; [0] is empty
  std::vector<CellData<VertexId>> parent_corner;  // and the parent's vertex at whose corner it lies

  int finest() const { return static_cast<int>(levels.size()) - 1; }
  const Solid& solid() const { return levels.back(); }
};

/// Number of cells after `level_count` refinements, without making them (levels ≥ 1: cell corners, then times 8
/// where all are hexahedra, exactly for the others). Used to check limits before allocating.
[[nodiscard]] std::size_t refined_cell_count(const Solid& solid, int level_count);

/// @throws what refine() throws.
[[nodiscard]] Refinement refine_to_level(const Solid& control, int level_count,
                                         RuleSet rules = RuleSet::maccracken_joy, const Progress& progress = {});

}  // namespace argil::subdiv
