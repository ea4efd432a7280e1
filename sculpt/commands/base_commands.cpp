#include <fmt/format.h>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/session.h"
#include "subdiv/error.h"
#include "subdiv/primitives.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

void new_solid(Session& session, const Arguments& arguments) {
  const std::string shape = arguments.word("shape");
  const Eigen::Vector3d size = arguments.vector("size", Eigen::Vector3d::Ones());
  Built built;
  if (shape == "box") {
    const int n[] = {static_cast<int>(arguments.integer("nx", 1)), static_cast<int>(arguments.integer("ny", 1)),
                     static_cast<int>(arguments.integer("nz", 1))};
    check_cells(session, double(n[0]) * n[1] * n[2]);
    built = box_grid(n[0], n[1], n[2], size);
  } else {
    if (arguments.has("nx"))
      throw Error(ErrorCode::bad_input, fmt::format("a {} has no counts; only a box has", shape));
    built = shape == "tetrahedron" ? tetrahedron(size) : shape == "wedge" ? wedge(size) : pyramid(size);
  }
  built.positions.colwise() += arguments.vector("at", Eigen::Vector3d::Zero());
  session.change(state_of(std::move(built)));
}

}  // namespace

std::vector<Command> base_commands() {
  return {
      {.name = "new",
       .summary = "Begins a new solid from a base shape; its lowest corner stands at the origin unless `at` says "
                  "otherwise.",
       .parameters = {{.name = "shape",
                       .type = ArgumentType::word,
                       .help = "what to begin with",
                       .positional = true,
                       .required = true,
                       .choices = {"box", "tetrahedron", "wedge", "pyramid"}},
                      {.name = "nx",
                       .type = ArgumentType::integer,
                       .help = "cells of a box along x",
                       .positional = true,
                       .low = 1,
                       .high = 1000},
                      {.name = "ny",
                       .type = ArgumentType::integer,
                       .help = "along y",
                       .positional = true,
                       .low = 1,
                       .high = 1000},
                      {.name = "nz",
                       .type = ArgumentType::integer,
                       .help = "along z",
                       .positional = true,
                       .low = 1,
                       .high = 1000},
                      {.name = "size", .help = "extent", .unit = "m", .count = 3, .low = 1e-9, .high = 1e9},
                      {.name = "at",
                       .help = "where its lowest corner stands",
                       .unit = "m",
                       .count = 3,
                       .low = -1e9,
                       .high = 1e9}},
       .example = "new box 4 4 1 size 0.6 0.6 0.1",
       .run = new_solid},
  };
}

}  // namespace argil::sculpt
