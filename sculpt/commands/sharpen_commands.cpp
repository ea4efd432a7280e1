#include <fmt/format.h>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/session.h"
#include "subdiv/edit/sharpen.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

void sharpen_elements(Session& session, const Arguments& arguments) {
  constexpr ElementType types[] = {ElementType::edges, ElementType::vertices, ElementType::faces};
  const Selection selection = acted_on(session, arguments, types);
  const double value = arguments.number("value", k_infinitely_sharp);
  edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd&) {
    const auto sharpen_each = [&]<class IdType>(IdType) {
      const std::vector<IdType> ids(selection.ids.begin(), selection.ids.end());
      sharpen(transaction, ids, value);
    };
    if (selection.type == ElementType::edges) sharpen_each(EdgeId{});
    if (selection.type == ElementType::vertices) sharpen_each(VertexId{});
    if (selection.type == ElementType::faces) sharpen_each(FaceId{});
    return Edit{};
  });
}

}  // namespace

std::vector<Command> sharpen_commands() {
  return {
      {.name = "sharpen",
       .summary = "Makes edges creases and vertices corners, on the boundary or on a sheet; makes faces inside the "
                  "solid a "
                  "sheet that keeps its own shape (`select faces interior where …`). 0 makes them smooth again.",
       .parameters =
           {{.name = "value",
             .help = "sharpness: 10 (default) for ever, 0 smooth; between, sharp for so many levels, then "
                     "rounded",
             .positional = true,
             .low = 0,
             .high = k_infinitely_sharp},
            {.name = "where", .type = ArgumentType::expression, .help = "the edges; else what is selected"}},
       .example = "sharpen 1.5",
       .before = {"new box 2 2 2", "select edges angle 30"},
       .run = sharpen_elements},
  };
}

}  // namespace argil::sculpt
