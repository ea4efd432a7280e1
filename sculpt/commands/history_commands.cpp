#include "sculpt/commands/commands.h"
#include "sculpt/session.h"

namespace argil::sculpt {

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
       .effect = Effect::history,
       .run =
           [](Session& session, const Arguments& arguments) {
             session.undo(arguments.has("all") ? static_cast<long>(session.undo_depth())
                                               : arguments.integer("count", 1));
           }},
      {.name = "redo",
       .summary = "Brings back what undo took.",
       .parameters = {count, all},
       .example = "redo 2",
       .effect = Effect::history,
       .run =
           [](Session& session, const Arguments& arguments) {
             session.redo(arguments.has("all") ? static_cast<long>(session.redo_depth())
                                               : arguments.integer("count", 1));
           }},
  };
}

}  // namespace argil::sculpt
