#include <fmt/format.h>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/region.h"
#include "sculpt/session.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

void move(Session& session, const Arguments& arguments) {
  constexpr ElementType movable[] = {ElementType::vertices, ElementType::edges, ElementType::faces,
                                     ElementType::cells};
  const Selection selection = acted_on(session, arguments, movable);
  const Eigen::Vector3d shift = arguments.vector("by");
  State next = session.document().state();
  auto rest = std::make_shared<Eigen::Matrix3Xd>(*next.rest);
  auto motion = std::make_shared<fem::BodyState>(*next.motion);
  for (const std::uint32_t v : vertices_of(session.document(), selection)) {
    rest->col(v) += shift;
    motion->positions.col(v) += shift;
    if (motion->previous_positions.cols() > 0) motion->previous_positions.col(v) += shift;
  }
  next.rest = rest;
  next.motion = motion;
  session.change(std::move(next));
}

}  // namespace

std::vector<Command> transform_commands() {
  return {
      {.name = "move",
       .summary = "Moves the selected vertices, or those of the selected edges, faces or cells.",
       .parameters = {{.name = "by",
                       .help = "the shift",
                       .unit = "m",
                       .count = 3,
                       .positional = true,
                       .required = true,
                       .low = -1e9,
                       .high = 1e9},
                      {.name = "where",
                       .type = ArgumentType::expression,
                       .help = "the vertices; else what is selected"}},
       .example = "move 0 0.05 0 where z > 0.8",
       .run = move},
  };
}

}  // namespace argil::sculpt
