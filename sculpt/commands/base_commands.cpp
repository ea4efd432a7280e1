#include <fmt/format.h>

#include "io/surface.h"
#include "io/volume_mesh.h"
#include "sculpt/commands/base_shapes.h"
#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/session.h"
#include "subdiv/edit/join.h"
#include "subdiv/error.h"
#include "subdiv/solidify/solidify.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

constexpr long k_cells_along = 12;

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

void report(const Session& session, const ClosedSurface& surface, const SolidifyOptions& options,
            const Solidified& made) {
  session.print(fmt::format("{} cells of about {:.3g} m; the surface is nowhere farther than {:.3g} m from them",
                            made.built.solid.cell_count(), options.cell_size, made.largest_gap));
  if (surface.was_inward) session.print("the surface faced inward and was turned");
  if (made.overlapping_samples > 0) session.print("the surface overlaps itself; what it covers twice is one");
  if (made.inside_out_samples > 0)
    session.print("parts of the surface are inside out and were left empty; make their orientation agree");
  if (made.component_count > surface.component_count)
    session.print(fmt::format("the solid fell into {} pieces where the surface is thin; ask for more cells",
                              made.component_count));
  if (made.largest_gap > options.cell_size)
    session.print("parts of the surface are thinner than the cells and were lost; ask for more cells");
  if (made.off_surface > 0)
    session.print(fmt::format("{} vertices stay off the surface, where cells would have closed", made.off_surface));
}

void solidify_surface(Session& session, const Arguments& arguments) {
  if (arguments.has("cells") && arguments.has("size"))
    throw Error(ErrorCode::bad_input,
                "`cells` counts them along the longest side, `size` is the length of one; leave one out");
  const io::SurfaceMesh mesh = io::read_surface(session.path_to_read(arguments.word("surface")));
  const ClosedSurface surface = closed_surface(mesh.positions, mesh.offsets, mesh.corners);
  const double longest =
      (surface.positions.rowwise().maxCoeff() - surface.positions.rowwise().minCoeff()).maxCoeff();
  SolidifyOptions options;
  options.cell_size =
      arguments.number("size", longest / static_cast<double>(arguments.integer("cells", k_cells_along)));
  options.layers = static_cast<int>(arguments.integer("layers", 1));
  check_cells(session, box_cell_count(surface, options.cell_size));
  Solidified made =
      solidify(surface, options, [&](double part, const char* what) { session.progress(part, what); });
  check_cells(session, static_cast<double>(made.built.solid.cell_count()));
  report(session, surface, options, made);
  session.change(state_of(std::move(made.built)));
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
      {.name = "solidify",
       .summary =
           "Begins a new solid that fills a closed surface with hexahedra: cubes within it, a layer of cells "
           "between them and the surface.",
       .parameters = {{.name = "surface",
                       .type = ArgumentType::text,
                       .help = "a surface mesh beneath the session's own folder",
                       .positional = true,
                       .required = true},
                      {.name = "cells",
                       .type = ArgumentType::integer,
                       .help = "cubes along the longest side; else 12",
                       .low = 1,
                       .high = 500},
                      {.name = "size", .help = "of a cube, instead", .unit = "m", .low = 1e-9, .high = 1e9},
                      {.name = "layers",
                       .type = ArgumentType::integer,
                       .help = "of cells between the cubes and the surface; else 1",
                       .low = 0,
                       .high = 10}},
       .example = "solidify ball.obj cells 8",
       .before = {"new sphere around 16", "save ball.obj"},
       .run = solidify_surface},
  };
}

}  // namespace argil::sculpt
