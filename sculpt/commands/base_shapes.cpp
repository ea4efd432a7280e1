#include "sculpt/commands/base_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "sculpt/commands/edit.h"
#include "subdiv/error.h"
#include "subdiv/primitives.h"
#include "subdiv/primitives/platonic.h"
#include "subdiv/primitives/round.h"
#include "subdiv/transaction.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

struct BaseShape {
  std::string name;
  std::vector<std::string> takes;  // beside `at`
  std::function<double(const Arguments&)> cell_count;
  std::function<Built(const Arguments&)> make;
};

constexpr double k_radius = 0.5, k_hole = 0.25, k_thickness = 0.2, k_height = 1;

int count(const Arguments& arguments, const char* name, long otherwise) {
  return static_cast<int>(arguments.integer(name, otherwise));
}

RoundGrid grid_of(const Arguments& arguments, long along = 2) {
  return {count(arguments, "around", 8), count(arguments, "along", along), count(arguments, "rings", 1)};
}

double radius_of(const Arguments& arguments) {
  return arguments.number("radius", k_radius);
}

double height_of(const Arguments& arguments) {
  return arguments.number("height", k_height);
}

Eigen::Vector3d size_of(const Arguments& arguments) {
  return arguments.vector("size", Eigen::Vector3d::Ones());
}

double one_cell(const Arguments&) {
  return 1;
}

double swept_disk_count(const Arguments& arguments) {
  const RoundGrid grid = grid_of(arguments);
  return disk_cell_count(grid) * grid.along;
}

BaseShape regular(const std::string& name, Platonic body) {
  return {name, {"radius", "sharp"}, one_cell, [body](const Arguments& a) { return platonic(body, radius_of(a)); }};
}

Built pointed_or_flat_cone(const Arguments& arguments) {
  const double top = arguments.number("top", 0);
  Built built = cone(radius_of(arguments), top, height_of(arguments), grid_of(arguments));
  if (top == 0 && arguments.has("sharp")) {
    Transaction transaction(built.solid);
    transaction.set_sharpness(VertexId{built.solid.vertex_capacity() - 1}, k_infinitely_sharp);
    (void)transaction.commit();
  }
  return built;
}

const std::vector<BaseShape>& shapes() {
  static const std::vector<BaseShape> table = {
      {"box",
       {"nx", "ny", "nz", "size", "sharp"},
       [](const Arguments& a) { return double(count(a, "nx", 1)) * count(a, "ny", 1) * count(a, "nz", 1); },
       [](const Arguments& a) {
         return box_grid(count(a, "nx", 1), count(a, "ny", 1), count(a, "nz", 1), size_of(a));
       }},
      {"cylinder",
       {"radius", "height", "around", "along", "rings", "sharp"},
       swept_disk_count,
       [](const Arguments& a) { return cylinder(radius_of(a), height_of(a), grid_of(a)); }},
      {"tube",
       {"radius", "inner", "height", "around", "along", "rings", "sharp"},
       [](const Arguments& a) { return double(grid_of(a).around) * grid_of(a).along * grid_of(a).rings; },
       [](const Arguments& a) { return tube(radius_of(a), a.number("inner", k_hole), height_of(a), grid_of(a)); }},
      {"cone",
       {"radius", "top", "height", "around", "along", "rings", "sharp"},
       swept_disk_count,
       pointed_or_flat_cone},
      {"sphere",
       {"radius", "around", "rings"},
       [](const Arguments& a) { return sphere_cell_count(grid_of(a)); },
       [](const Arguments& a) { return sphere(radius_of(a), grid_of(a)); }},
      {"torus",
       {"radius", "thickness", "around", "along", "rings"},
       [](const Arguments& a) { return disk_cell_count(grid_of(a)) * grid_of(a, 16).along; },
       [](const Arguments& a) { return torus(radius_of(a), a.number("thickness", k_thickness), grid_of(a, 16)); }},
      {"wedge", {"size", "sharp"}, one_cell, [](const Arguments& a) { return wedge(size_of(a)); }},
      {"pyramid", {"size", "sharp"}, one_cell, [](const Arguments& a) { return pyramid(size_of(a)); }},
      {"tetrahedron",
       {"size", "radius", "sharp"},
       one_cell,
       [](const Arguments& a) {
         if (!a.has("radius")) return tetrahedron(size_of(a));
         if (a.has("size"))
           throw Error(ErrorCode::bad_input,
                       "a tetrahedron has either a size, which it is inscribed in, or a radius, which makes it "
                       "regular; leave one out");
         return platonic(Platonic::tetrahedron, radius_of(a));
       }},
      regular("cube", Platonic::cube),
      regular("octahedron", Platonic::octahedron),
      regular("dodecahedron", Platonic::dodecahedron),
      regular("icosahedron", Platonic::icosahedron),
  };
  return table;
}

}  // namespace

std::vector<Parameter> shape_parameters(bool required) {
  Parameter shape{.name = "shape",
                  .type = ArgumentType::word,
                  .help =
                      "a box of nx × ny × nz cells; cylinder, tube, cone, sphere and torus of hexahedra; or a "
                      "single cell",
                  .positional = true,
                  .required = required};
  for (const BaseShape& known : shapes()) shape.choices.push_back(known.name);
  const auto cells = [](const char* name, const char* help) {
    return Parameter{
        .name = name, .type = ArgumentType::integer, .help = help, .positional = true, .low = 1, .high = 1000};
  };
  const auto length = [](const char* name, const char* help, double low = 1e-9) {
    return Parameter{.name = name, .help = help, .unit = "m", .low = low, .high = 1e9};
  };
  const auto counted = [](const char* name, const char* help, double low) {
    return Parameter{.name = name, .type = ArgumentType::integer, .help = help, .low = low, .high = 1000};
  };
  return {
      shape,
      cells("nx", "cells of a box along x"),
      cells("ny", "along y"),
      cells("nz", "along z"),
      {.name = "size",
       .help = "extent of a box, wedge, pyramid or tetrahedron; else 1 1 1",
       .unit = "m",
       .count = 3,
       .low = 1e-9,
       .high = 1e9},
      length("radius",
             "of a round shape, from a torus's axis to the middle of its body, or of the ball around a "
             "regular body; else 0.5"),
      length("height", "of a cylinder, tube or cone; else 1"),
      length("inner", "radius of a tube's hole; else 0.25"),
      length("top", "radius of a cone's upper end; else 0, a tip", 0),
      length("thickness", "radius of a torus's body; else 0.2"),
      counted("around", "cells around a round shape's outline, a multiple of 4 (of a tube, any); else 8", 3),
      counted("along", "cells along the height, or around a torus's axis; else 2, or 16", 1),
      counted("rings", "layers of cells about the core, or through a tube's wall; else 1", 1),
      {.name = "sharp", .help = "keeps edges and rims sharp when it is refined", .flag = true},
      {.name = "at",
       .help = "where its lowest corner stands, or the foot of its axis",
       .unit = "m",
       .count = 3,
       .low = -1e9,
       .high = 1e9},
  };
}

Built base_shape(const Session& session, const Arguments& arguments, double cells_there) {
  const std::string& name = arguments.word("shape");
  const auto shape =
      std::find_if(shapes().begin(), shapes().end(), [&](const BaseShape& s) { return s.name == name; });
  for (const Parameter& parameter : shape_parameters(true)) {
    if (parameter.name == "shape" || parameter.name == "at" || !arguments.has(parameter.name)) continue;
    if (std::find(shape->takes.begin(), shape->takes.end(), parameter.name) == shape->takes.end())
      throw Error(ErrorCode::bad_input, fmt::format("a {} has no `{}`; it takes {} and at", name, parameter.name,
                                                    fmt::join(shape->takes, ", ")));
  }
  check_cells(session, cells_there + shape->cell_count(arguments));
  Built built = shape->make(arguments);
  if (arguments.has("sharp")) sharpen_outline(built.solid);
  built.positions.colwise() += arguments.vector("at", Eigen::Vector3d::Zero());
  return built;
}

}  // namespace argil::sculpt
