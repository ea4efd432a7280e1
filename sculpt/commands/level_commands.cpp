#include <fmt/format.h>

#include <algorithm>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/field_transfer.h"
#include "sculpt/session.h"
#include "subdiv/error.h"
#include "subdiv/solid_measures.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

void set_level(Session& session, const Arguments& arguments) {
  require_solid(session);
  Document& document = session.document();
  State next = document.state();
  const int level = static_cast<int>(arguments.integer("level", 0));
  check_cells(session, static_cast<double>(refined_cell_count(document.solid(), level)));
  if (level == next.level) {
    session.change(std::move(next));
    return;
  }
  const Refinement before = document.refinement();
  next.level = level;
  const std::shared_ptr<const Fields> old_fields = next.fields;
  document.assign(next);  // refine at the new level; a failure puts the old state back
  const Refinement& after = document.refinement();
  next.fields = fields_at_level(*old_fields, before, after);
  const auto node_map = nodes_at_level(before, after);
  auto pins = std::make_shared<Pins>(*next.pins);
  for (SoftPin& pin : pins->nodes) pin.node = node_map[pin.node];
  const auto lost = std::erase_if(pins->nodes, [](const SoftPin& pin) { return pin.node == k_no_node; });
  if (lost > 0)
    session.print(fmt::format("{} pinned nodes do not exist at level {} and are free now", lost, level));
  const auto carry = [&](const Selection& selection) {
    Selection result = selection;
    if (selection.type != ElementType::nodes) return result;
    for (auto& id : result.ids) id = node_map[id];
    std::erase(result.ids, k_no_node);
    std::sort(result.ids.begin(), result.ids.end());
    return result;
  };
  for (PinMotion& motion : pins->motions) motion.members = carry(motion.members);
  next.pins = pins;
  next.selection = std::make_shared<Selection>(carry(*next.selection));
  auto sets = std::make_shared<std::map<std::string, Selection>>();
  for (const auto& [name, set] : *next.sets) (*sets)[name] = carry(set);
  next.sets = sets;
  document.assign(next);
  if (level > 0) {
    check_discretization(session);
    const double kept =
        document.discretization().rest_volume / mass_properties(document.solid(), document.rest()).volume;
    if (kept < 0.6)
      session.print(fmt::format(
          "refinement keeps {:.0f} % of the volume; sharpen edges or begin with more cells to keep more",
          100 * kept));
    if (document.solid().cell_count() == 1 && document.solid().vertex_count() == 8)
      session.print("a lone hexahedron cannot move in all its ways once it is refined; begin with `new box 2 2 2`");
  }
  session.change(std::move(next));
}

// The nodes of every level stay what they are, so fields and pins stay with them.
void set_rules(Session& session, const Arguments& arguments) {
  require_solid(session);
  Document& document = session.document();
  State next = document.state();
  next.rules = arguments.word("rules") == word(RuleSet::multilinear_averaging) ? RuleSet::multilinear_averaging
                                                                               : RuleSet::maccracken_joy;
  document.assign(next);  // refine by the new rules; a failure puts the old state back
  if (next.level > 0) check_discretization(session);
  session.change(std::move(next));
}

void set_space(Session& session, const Arguments& arguments) {
  require_solid(session);
  State next = session.document().state();
  next.space = fem::space_by_name(arguments.word("space"));
  next.split = static_cast<int>(arguments.integer("split", next.split));
  session.change(std::move(next));
}

}  // namespace

std::vector<Command> level_commands() {
  std::vector<std::string> space_names;
  std::string space_summaries;
  for (const fem::SpaceKind& kind : fem::space_table()) {
    space_names.emplace_back(kind.name);
    space_summaries += fmt::format(" {}: {}.", kind.name, kind.summary);
  }
  return {
      {.name = "levels",
       .summary = "How often the control solid is refined before it becomes finite elements.",
       .parameters = {{.name = "level",
                       .type = ArgumentType::integer,
                       .help = "refinements",
                       .positional = true,
                       .required = true,
                       .low = 0,
                       .high = 8}},
       .example = "levels 2",
       .before = {"new box 2 2 2"},
       .run = set_level},
      {.name = "rules",
       .summary = "Where refinement puts the new points: by MacCracken–Joy (default), or by multilinear averaging, "
                  "which is "
                  "calmer where other than four cells meet at an edge. Both agree on regular grids.",
       .parameters = {{.name = "rules",
                       .type = ArgumentType::word,
                       .help = "the rules",
                       .positional = true,
                       .required = true,
                       .choices = {word(RuleSet::maccracken_joy), word(RuleSet::multilinear_averaging)}}},
       .example = "rules multilinear",
       .before = {"new box 2 2 2", "levels 1"},
       .run = set_rules},
      {.name = "space",
       .summary = "Which functions the solid may move by." + space_summaries,
       .parameters = {{.name = "space",
                       .type = ArgumentType::word,
                       .help = "the space",
                       .positional = true,
                       .required = true,
                       .choices = space_names},
                      {.name = "split",
                       .type = ArgumentType::integer,
                       .help = "cubic: how often the remaining cells are split",
                       .low = 0,
                       .high = 3}},
       .example = "space cubic split 1",
       .before = {"new box 3 3 3", "levels 1"},
       .run = set_space},
  };
}

}  // namespace argil::sculpt
