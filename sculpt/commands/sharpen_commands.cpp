#include <fmt/format.h>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/session.h"
#include "subdiv/edit/sharpen.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

void sharpen_elements(Session& session, const Arguments& arguments) {
  constexpr ElementType types[] = {ElementType::edges, ElementType::vertices};
  const Selection selection = acted_on(session, arguments, types);
  const double value = arguments.number("value", k_infinitely_sharp);
  edit_topology(session, [&](Transaction& transaction, Eigen::Matrix3Xd&, Eigen::Matrix3Xd&, Selection&) {
    if (selection.type == ElementType::edges) {
      const std::vector<EdgeId> edges(selection.ids.begin(), selection.ids.end());
      sharpen(transaction, edges, value);
    } else {
      const std::vector<VertexId> vertices(selection.ids.begin(), selection.ids.end());
      sharpen(transaction, vertices, value);
    }
  });
}

}  // namespace

std::vector<Command> sharpen_commands() {
  return {
      {.name = "sharpen",
       .summary = "Makes boundary edges creases, or boundary vertices corners; 0 makes them smooth again.",
       .parameters = {{.name = "value",
                       .help = "sharpness: 10 is infinite, 0 smooth",
                       .positional = true,
                       .low = 0,
                       .high = 10},
                      {.name = "where",
                       .type = ArgumentType::expression,
                       .help = "the edges; else what is selected"}},
       .example = "sharpen 10",
       .run = sharpen_elements},
  };
}

}  // namespace argil::sculpt
