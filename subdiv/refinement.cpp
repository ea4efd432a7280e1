#include "subdiv/refinement.h"

#include <cassert>
#include <cmath>
#include <map>

namespace argil::subdiv {

std::size_t refined_cell_count(const Solid& solid, int level_count) {
  assert(level_count >= 0);
  if (level_count == 0) return solid.cell_count();
  // A corner with k edges gives a cell with two vertices of valence k and 2k of valence 3.
  constexpr std::size_t k_most = static_cast<std::size_t>(-1);
  const auto add = [](std::size_t a, std::size_t b) { return a > k_most - b ? k_most : a + b; };
  const auto times = [](std::size_t a, std::size_t b) { return b != 0 && a > k_most / b ? k_most : a * b; };
  std::map<std::size_t, std::size_t> count_of_kind;  // by the k of the corner that a cell came from
  std::map<VertexId, std::size_t> valence;
  for (const CellId c : solid.cells()) {
    valence.clear();
    for (const FaceUseId use : solid.cell_face_uses(c))
      for (const VertexId v : solid.face_vertices(face_of(use))) ++valence[v];
    for (const auto& [v, k] : valence) ++count_of_kind[k];
  }
  for (int level = 1; level < level_count; ++level) {
    std::map<std::size_t, std::size_t> next;
    for (const auto& [k, count] : count_of_kind) {
      next[k] = add(next[k], times(count, 2));
      next[3] = add(next[3], times(count, 2 * k));
    }
    count_of_kind = std::move(next);
  }
  std::size_t total = 0;
  for (const auto& [k, count] : count_of_kind) total = add(total, count);
  return total;
}

Refinement refine_to_level(const Solid& control, int level_count, RuleSet rules, const Progress& progress) {
  assert(level_count >= 0);
  Refinement result;
  result.rules = rules;
  result.levels.push_back(control);
  result.stencils.push_back(Stencils::identity(control.vertex_capacity()));
  result.step_stencils.emplace_back();
  result.parent.emplace_back();
  result.parent_corner.emplace_back();
  for (int level = 1; level <= level_count; ++level) {
    // Each level has about eight times as much to do as the one before.
    const Progress part = progress.part(std::pow(8.0, level - 1 - level_count) * (level > 1 ? 1 : 0),
                                        std::pow(8.0, level - level_count));
    RefinementStep step = refine(result.levels.back(), rules, part.part(0, 0.5));
    result.stencils.push_back(level == 1 ? step.stencils
                                         : compose(step.stencils, result.stencils.back(), part.part(0.5, 1)));
    result.levels.push_back(std::move(step.fine));
    result.step_stencils.push_back(std::move(step.stencils));
    result.parent.push_back(std::move(step.coarse_from_fine));
    result.parent_corner.push_back(std::move(step.corner_from_fine));
  }
  return result;
}

}  // namespace argil::subdiv
