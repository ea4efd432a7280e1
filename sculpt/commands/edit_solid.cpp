#include <fmt/format.h>

#include <algorithm>

#include "sculpt/column_changes.h"
#include "sculpt/commands/edit.h"
#include "sculpt/edit_transfer.h"
#include "sculpt/field_transfer.h"
#include "sculpt/session.h"
#include "subdiv/error.h"
#include "subdiv/sort_unique.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

void check_result(const Session& session, const Solid& solid, int level) {
  if (solid.cell_count() == 0)
    throw Error(ErrorCode::bad_topology, "this would leave no cell; a solid has at least one");
  const Limits& limits = session.document().limits;
  if (refined_cell_count(solid, level) > limits.cells)
    throw Error(ErrorCode::limit_exceeded,
                fmt::format("this would make more than {} cells at level {}; lower the level or raise --max-cells",
                            limits.cells, level));
}

// Positions that neither the one nor the other blend may leave the range of numbers.
void check_positions(const ColumnChanges& changes) {
  for (const auto* columns : {&changes.added, &changes.after})
    if (!columns->rest.allFinite() || !columns->positions.allFinite())
      throw Error(ErrorCode::bad_geometry, "a vertex would stand beyond the range of numbers; use smaller ones");
}

std::shared_ptr<const fem::BodyState> without_history(const fem::BodyState& motion) {
  auto result = std::make_shared<fem::BodyState>(motion);
  result->previous_positions.resize(3, 0);
  result->previous_velocities.resize(3, 0);
  result->accelerations.resize(3, 0);
  result->previous_step = 0;
  return result;
}

Selection chosen(const Edit& edit, const Selection& otherwise) {
  Selection selection;
  const auto choose = [&](ElementType type, const auto& ids) {
    if (ids.empty()) return false;
    selection = {type, {}};
    for (const auto id : ids) selection.ids.push_back(id.value);
    subdiv::sort_unique(selection.ids);
    return true;
  };
  const bool any = choose(ElementType::faces, edit.next_faces) || choose(ElementType::cells, edit.next_cells) ||
                   choose(ElementType::edges, edit.next_edges) || choose(ElementType::vertices, edit.next_vertices);
  return any ? selection : otherwise;
}

}  // namespace

void edit_solid(Session& session, const std::function<Edit(Transaction&, const Eigen::Matrix3Xd&)>& edit) {
  require_solid(session);
  Document& document = session.document();
  State next = document.state();
  const bool refined = next.level > 0;
  std::optional<Refinement> before;
  if (refined) before = document.refinement();

  Transaction transaction(*next.solid);
  const Edit made = edit(transaction, *next.rest);
  const Solid& solid = *next.solid;
  check_result(session, solid, next.level);
  const ColumnChanges changes = column_changes(next, made, solid.vertex_capacity(), !refined);
  check_positions(changes);
  if (next.motion->previous_positions.cols() > 0) next.motion = without_history(*next.motion);

  std::vector<std::uint32_t> node_map;  // empty on the control solid: nodes are its vertices
  if (refined) {
    const Refinement after = refine_to_level(solid, next.level, next.rules, session.progress_of("refining"));
    node_map = nodes_after_edit(*before, after);
    next.fields = fields_after_edit(*next.fields, node_map, after, copied_nodes(after, made));
  }
  const EditTransfer transfer(solid, made, refined ? &node_map : nullptr);
  next.selection = std::make_shared<Selection>(transfer.follow(chosen(made, *next.selection)));
  next.sets = transfer.follow(*next.sets);
  next.pins = transfer.follow(*next.pins);
  int lost_forces = 0;
  next.loads = transfer.follow(*next.loads, lost_forces);

  const bool in_place = !refined && !transaction.empty();
  if (!in_place) {
    next.rest = std::make_shared<Eigen::Matrix3Xd>(*next.rest);
    next.motion = std::make_shared<fem::BodyState>(*next.motion);
    if (!refined) next.fields = std::make_shared<Fields>(*next.fields);
    apply(next, changes);
  }
  session.change(std::move(next), transaction.commit(), in_place ? changes : ColumnChanges{});
  if (lost_forces > 0)
    session.print(fmt::format("{} force{} gone with the faces that {} acted on", lost_forces,
                              lost_forces == 1 ? " is" : "s are", lost_forces == 1 ? "it" : "they"));
}

}  // namespace argil::sculpt
