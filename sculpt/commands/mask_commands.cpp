#include <fmt/format.h>

#include <algorithm>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/control_elements.h"
#include "sculpt/region.h"
#include "sculpt/session.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

// 1 for each node of the finest level on a control element that is selected, its rim included.
std::vector<std::uint8_t> nodes_on(const Document& document, const Selection& selection) {
  const Solid& fine = document.refinement().solid();
  std::vector<std::uint8_t> on(fine.vertex_capacity(), 0);
  if (selection.type == ElementType::nodes) {
    for (const std::uint32_t node : selection.ids) on[node] = 1;
    return on;
  }
  const ControlElements control = control_elements(document.refinement());
  const auto chosen = [&](auto id) {
    return id.valid() && std::binary_search(selection.ids.begin(), selection.ids.end(), id.value);
  };
  const auto take = [&](const auto& vertices) {
    for (const VertexId v : vertices) on[v.index()] = 1;
  };
  switch (selection.type) {
    case ElementType::edges:
      for (const EdgeId e : fine.edges())
        if (chosen(control.edge[e])) take(fine.edge_vertices(e));
      break;
    case ElementType::faces:
      for (const FaceId f : fine.faces())
        if (chosen(control.face[f])) take(fine.face_vertices(f));
      break;
    case ElementType::cells:
      for (const CellId c : fine.cells())
        if (chosen(control.cell[c])) take(cell_vertices(fine, c));
      break;
    default:
      for (const VertexId v : fine.vertices())
        if (chosen(control.vertex[v])) on[v.index()] = 1;
  }
  return on;
}

void mask_clay(Session& session, const Arguments& arguments) {
  require_solid(session);
  const Document& document = session.document();
  const std::string& what = arguments.word("what");
  const bool by_selection = what == "selected" || what == "unselected";
  if (arguments.has("value") && !by_selection)
    throw Error(ErrorCode::bad_input,
                fmt::format("a value is for what is selected or not, as in `mask selected value 0.5`; leave it out "
                            "of `mask {}`",
                            what));
  const double value = arguments.number("value", 1);
  State next = document.state();
  auto fields = std::make_shared<Fields>(*next.fields);
  Eigen::VectorXd& mask = (*fields)[FieldName::mask];
  if (what == "clear") {
    mask.setZero();
  } else if (what == "invert") {
    for (double& m : mask) m = 1 - m;
  } else {
    const Selection& selection = *document.state().selection;
    if (selection.ids.empty())
      throw Error(
          ErrorCode::bad_input,
          "nothing is selected that could be masked; select something first, as in `select faces where z > 0`");
    const std::vector<std::uint8_t> on = nodes_on(document, selection);
    for (const VertexId v : document.refinement().solid().vertices())
      if ((on[v.index()] != 0) == (what == "selected")) mask[static_cast<Eigen::Index>(v.index())] = value;
  }
  const auto count =
      static_cast<std::size_t>(std::count_if(mask.begin(), mask.end(), [](double m) { return m > 0; }));
  session.print(fmt::format("{} masked", count_of(count, ElementType::nodes)));
  next.fields = fields;
  session.change(std::move(next));
}

}  // namespace

std::vector<Command> mask_commands() {
  return {
      {.name = "mask",
       .summary = "Protects clay from all tools: takes the mask away, turns it over, or masks what is selected, or "
                  "all else. `tool paint_mask` paints it, `set mask` gives it by a formula.",
       .parameters = {{.name = "what",
                       .type = ArgumentType::word,
                       .help = "clear: nothing is masked; invert: what was not is; selected and unselected: the "
                               "nodes on what is selected, or the others, beside those that already are",
                       .positional = true,
                       .required = true,
                       .choices = {"clear", "invert", "selected", "unselected"}},
                      {.name = "value",
                       .help = "of selected and unselected: how much; else 1, wholly, and 0 takes it away",
                       .low = 0,
                       .high = 1}},
       .example = "mask selected",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "levels 1", "select faces where x < 0.3 and z > 0.09"},
       .run = mask_clay}};
}

}  // namespace argil::sculpt
