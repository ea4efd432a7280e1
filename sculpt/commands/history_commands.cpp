#include "sculpt/commands/commands.h"
#include "sculpt/session.h"

#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

long wanted(const Arguments& arguments, std::size_t depth) {
  if (!arguments.has("all")) return arguments.integer("count", 1);
  if (arguments.has("count"))
    throw Error(ErrorCode::bad_input, "a count and all exclude each other; leave one out");
  return static_cast<long>(depth);
}

}  // namespace

std::vector<Command> history_commands() {
  const Parameter count{.name = "count",
                        .type = ArgumentType::integer,
                        .help = "how many commands",
                        .positional = true,
                        .low = 1,
                        .high = 1e6};
  const Parameter all{.name = "all", .help = "every one", .flag = true};
  return {
      {.name = "undo",
       .summary = "Takes back the last command that changed something, or more of them.",
       .parameters = {count, all},
       .example = "undo 2",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "move 0 0 0.1 where x > 0.5", "move 0 0 0.1 where y > 0.5"},
       .effect = Effect::history,
       .run = [](Session& session,
                 const Arguments& arguments) { session.undo(wanted(arguments, session.undo_depth())); }},
      {.name = "redo",
       .summary = "Brings back what undo took.",
       .parameters = {count, all},
       .example = "redo 2",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "move 0 0 0.1 where x > 0.5", "move 0 0 0.1 where y > 0.5",
                  "undo 2"},
       .effect = Effect::history,
       .run = [](Session& session,
                 const Arguments& arguments) { session.redo(wanted(arguments, session.redo_depth())); }},
  };
}

}  // namespace argil::sculpt
