#include <fmt/format.h>

#include "io/volume_mesh.h"
#include "sculpt/commands/base_shapes.h"
#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/session.h"
#include "subdiv/edit/join.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

void new_solid(Session& session, const Arguments& arguments) {
  session.change(state_of(base_shape(session, arguments, 0)));
}

Built from_file(const Session& session, const Arguments& arguments, double cells_there) {
  for (const Parameter& parameter : shape_parameters(false))
    if (parameter.name != "at" && arguments.has(parameter.name))
      throw Error(ErrorCode::bad_input,
                  fmt::format("a file brings its own shape; leave out `{}`, or the file", parameter.name));
  const io::VolumeMesh mesh = io::read_volume_mesh(session.path_to_read(arguments.word("file")));
  check_cells(session, cells_there + static_cast<double>(mesh.cells.cell_count()));
  Built built = build(mesh.cells);
  built.positions.colwise() += arguments.vector("at", Eigen::Vector3d::Zero());
  return built;
}

void join_solid(Session& session, const Arguments& arguments) {
  require_solid(session);
  const auto there = static_cast<double>(session.document().solid().cell_count());
  if (!arguments.has("shape") && !arguments.has("file"))
    throw Error(ErrorCode::bad_input,
                "join: expected a shape, as in `join sphere at 0 0 1`, or `file NAME`, found neither");
  const Built other =
      arguments.has("file") ? from_file(session, arguments, there) : base_shape(session, arguments, there);
  edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd&) { return join(transaction, other); });
}

}  // namespace

std::vector<Command> base_commands() {
  std::vector<Parameter> shape_or_file = shape_parameters(false);
  shape_or_file.push_back({.name = "file",
                           .type = ArgumentType::text,
                           .help = "instead of a shape, a volume mesh beneath the session's own folder"});
  return {
      {.name = "new",
       .summary = "Begins a new solid from a base shape. Boxes and single cells stand with their lowest corner at "
                  "the origin, round shapes and regular bodies upon it, with the axis along z.",
       .parameters = shape_parameters(true),
       .example = "new cylinder radius 0.3 height 1 around 12 along 4 sharp",
       .run = new_solid},
      {.name = "join",
       .summary =
           "Adds a base shape, or the cells of a file, as a solid of its own beside what is there; its cells "
           "are selected then.",
       .parameters = shape_or_file,
       .example = "join sphere radius 0.2 at 0.5 0.5 1",
       .before = {"new box 2 2 2"},
       .run = join_solid},
  };
}

}  // namespace argil::sculpt
