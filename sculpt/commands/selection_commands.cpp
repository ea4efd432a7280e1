#include <fmt/format.h>

#include <algorithm>

#include "sculpt/commands/chosen_elements.h"
#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/near_names.h"
#include "sculpt/region.h"
#include "sculpt/session.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

// With `add` or `remove`, joined to what is selected or taken from it.
void combine(const Document& document, const Arguments& arguments, Selection& selection) {
  if (!arguments.has("add") && !arguments.has("remove")) return;
  const Selection& old = *document.state().selection;
  if (old.type != selection.type && !old.ids.empty())
    throw Error(ErrorCode::bad_input, fmt::format("what is selected now are {}, not {}; leave out add and remove",
                                                  word(old.type), word(selection.type)));
  std::vector<std::uint32_t> result;
  if (arguments.has("add"))
    std::set_union(old.ids.begin(), old.ids.end(), selection.ids.begin(), selection.ids.end(),
                   std::back_inserter(result));
  else
    std::set_difference(old.ids.begin(), old.ids.end(), selection.ids.begin(), selection.ids.end(),
                        std::back_inserter(result));
  selection.ids = std::move(result);
}

void select(Session& session, const Arguments& arguments) {
  const Document& document = session.document();
  State next = document.state();
  Selection selection{element_type(arguments.word("type")), {}};
  require_solid(session);
  check_choice(arguments, selection.type);
  if (arguments.has("none")) {
    next.selection = std::make_shared<Selection>(selection);
    session.change(std::move(next));
    return;
  }
  selection = chosen_elements(document, arguments, selection.type);
  const bool missed = selection.ids.empty();
  combine(document, arguments, selection);
  if (arguments.has("as")) {
    auto sets = std::make_shared<std::map<std::string, Selection>>(*document.state().sets);
    (*sets)[arguments.word("as")] = selection;
    next.sets = std::move(sets);
  }
  session.print(fmt::format("{} selected{}", count_of(selection.ids.size(), selection.type),
                            !missed                ? ""
                            : arguments.has("ray") ? ": the ray meets nothing that fits"
                                                   : ": nothing fits"));
  next.selection = std::make_shared<Selection>(std::move(selection));
  session.change(std::move(next));
}

void manage_sets(Session& session, const Arguments& arguments) {
  require_solid(session);
  State next = session.document().state();
  if (!arguments.has("forget")) {
    if (next.sets->empty()) session.print("there are no named sets; make one with `select faces … as NAME`");
    for (const auto& [name, set] : *next.sets)
      session.print(fmt::format("{}: {}", io::quote(name), count_of(set.ids.size(), set.type)));
    return;
  }
  const std::string& name = arguments.word("forget");
  auto sets = std::make_shared<std::map<std::string, Selection>>(*next.sets);
  if (sets->erase(name) == 0) {
    std::vector<std::string> names;
    for (const auto& [known, unused] : *sets) names.push_back(known);
    throw Error(ErrorCode::not_found, fmt::format("there is no set named '{}'{}; `sets` lists them all", name,
                                                  near_names_hint(name, names)));
  }
  next.sets = std::move(sets);
  session.change(std::move(next));
}

}  // namespace

std::vector<Command> selection_commands() {
  return {
      {.name = "select",
       .summary = "Chooses vertices, edges, faces or cells of the control solid, or nodes of the finest level: all "
                  "that fit, or going on from those that fit or are selected.",
       .parameters =
           {{.name = "type",
             .type = ArgumentType::word,
             .help = "what to choose",
             .positional = true,
             .required = true,
             .choices = {"vertices", "edges", "faces", "cells", "nodes"}},
            {.name = "ray",
             .help =
                 "the first met from a point along a direction: a face, its nearest vertex or edge, or its cell",
             .unit = "m",
             .count = 6,
             .low = -1e9,
             .high = 1e9},
            {.name = "box",
             .help = "within a box between two corners, as the solid stands now",
             .unit = "m",
             .count = 6,
             .low = -1e9,
             .high = 1e9},
            {.name = "sphere",
             .help = "within a ball: its middle and radius, as the solid stands now",
             .unit = "m",
             .count = 4,
             .low = -1e9,
             .high = 1e9},
            {.name = "ids",
             .type = ArgumentType::integer,
             .help = "by their numbers, as a window journals what was pointed at",
             .low = 0,
             .high = 4e9,
             .list = true,
             .shown = "N"},
            {.name = "selected", .help = "only those that are selected", .flag = true},
            {.name = "boundary", .help = "only on the boundary", .flag = true},
            {.name = "inside", .help = "only inside, off the boundary", .flag = true},
            {.name = "interior", .help = "faces inside the solid as well", .flag = true},
            {.name = "any",
             .help = "the condition holds at one of its vertices (else at the centroid)",
             .flag = true},
            {.name = "all", .help = "the condition holds at all of its vertices", .flag = true},
            {.name = "none", .help = "choose nothing", .flag = true},
            {.name = "add", .help = "add to what is selected", .flag = true},
            {.name = "remove", .help = "take away from what is selected", .flag = true},
            {.name = "component",
             .help = "go on to whole pieces of the solid (cells connected through faces)",
             .flag = true},
            {.name = "loop",
             .help = "go on along edges, straight over regular vertices, as round an arm",
             .flag = true},
            {.name = "ring",
             .help = "go on across quadrilaterals to the parallel edges; inside, through hexahedra",
             .flag = true},
            {.name = "grow",
             .type = ArgumentType::integer,
             .help = "go on to what touches, so many times",
             .low = 1,
             .high = 1e6,
             .value_optional = true},
            {.name = "shrink",
             .type = ArgumentType::integer,
             .help = "leave out what touches the rest, so many times",
             .low = 1,
             .high = 1e6,
             .value_optional = true},
            {.name = "invert", .help = "choose all the others", .flag = true},
            {.name = "angle", .help = "boundary edges that bend by more", .unit = "degrees", .low = 0, .high = 180},
            {.name = "set", .type = ArgumentType::text, .help = "only members of this named set"},
            {.name = "as", .type = ArgumentType::text, .help = "keep the result as a named set"},
            {.name = "where",
             .type = ArgumentType::expression,
             .help = "a condition on x y z px py pz, boundary, "
                     "valence and the fields"}},
       .example = "select faces where z < 0.001 and (x < 0.15 or x > 0.45)",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1"},
       .run = select},
      {.name = "sets",
       .summary = "Lists the named sets, or forgets one.",
       .parameters = {{.name = "forget", .type = ArgumentType::text, .help = "the set that goes"}},
       .example = "sets forget rim",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "select edges angle 30 as rim"},
       .run = manage_sets}};
}

}  // namespace argil::sculpt
