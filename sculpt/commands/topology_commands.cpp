#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/region.h"
#include "sculpt/session.h"
#include "subdiv/edit/peak.h"
#include "subdiv/edit/remove.h"
#include "subdiv/edit/sweep.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

constexpr ElementType k_faces[] = {ElementType::faces};
constexpr ElementType k_cells[] = {ElementType::cells};

std::vector<FaceId> boundary_faces(const Session& session, const Selection& selection, const char* what) {
  std::vector<FaceId> faces;
  for (const std::uint32_t id : selection.ids) {
    if (!session.document().solid().is_boundary(FaceId{id}))
      throw Error(ErrorCode::bad_input,
                  fmt::format("face {} is inside the solid; only boundary faces {}", id, what));
    faces.emplace_back(id);
  }
  return faces;
}

// Ways that exclude each other, and what only one of them understands.
void check_ways(const Arguments& arguments) {
  const auto exclude = [&](const char* a, const char* b, const char* why) {
    if (arguments.has(a) && arguments.has(b))
      throw Error(ErrorCode::bad_input, fmt::format("{} and {} exclude each other: {}", a, b, why));
  };
  exclude("along", "normals", "the faces grow one way or each its own; leave one out");
  exclude("along", "path", "a path gives the direction; leave one out");
  exclude("normals", "path", "a path gives the direction; leave one out");
  exclude("distance", "path", "a path says how far; leave the distance out");
  if (arguments.has("curve") && !arguments.has("path"))
    throw Error(ErrorCode::bad_input, "curve rounds a path; add `path X Y Z …`");
  if (!arguments.has("distance") && !arguments.has("path"))
    throw Error(ErrorCode::bad_input,
                "expected how far, as in `extrude 0.4`, or a way, as in `extrude path 0 0 1`");
}

Sweep asked_sweep(const Session& session, const Arguments& arguments, const Selection& selection) {
  Sweep how;
  how.scale = arguments.number("scale", 1);
  how.twist = arguments.number("twist", 0) * std::numbers::pi / 180;
  how.curve = arguments.has("curve");
  long steps = 1;
  if (arguments.has("path")) {
    how.way = Sweep::Way::path;
    how.path = arguments.points("path");
    steps = static_cast<long>(how.path.size()) * (how.curve ? 4 : 1);
  } else if (arguments.has("normals")) {
    how.way = Sweep::Way::normals;
    how.distance = arguments.number("distance");
  } else {
    const Document& document = session.document();
    Eigen::Vector3d direction = arguments.vector("along", Eigen::Vector3d::Zero());
    if (!arguments.has("along")) direction = mean_normal(document.solid(), document.rest(), selection.ids);
    if (!(direction.norm() > 0)) throw Error(ErrorCode::bad_input, "the direction is zero");
    how.vector = arguments.number("distance") * direction.normalized();
    if (how.twist != 0 && !(how.vector.norm() > 0))
      throw Error(ErrorCode::bad_input, "a twist needs a way to turn about; give a distance other than 0");
  }
  how.steps = static_cast<int>(arguments.integer("steps", steps));
  return how;
}

void extrude_faces(Session& session, const Arguments& arguments) {
  const Selection selection = acted_on(session, arguments, k_faces);
  check_ways(arguments);
  const std::vector<FaceId> faces = boundary_faces(session, selection, "extrude");
  const Sweep how = asked_sweep(session, arguments, selection);
  check_cells(session, static_cast<double>(session.document().solid().cell_count()) +
                           static_cast<double>(how.steps) * static_cast<double>(selection.ids.size()));
  edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd& rest) {
    return sweep(transaction, rest, faces, how);
  });
}

void raise_peaks(Session& session, const Arguments& arguments) {
  const Selection selection = acted_on(session, arguments, k_faces);
  const std::vector<FaceId> faces = boundary_faces(session, selection, "grow a peak");
  edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd& rest) {
    return subdiv::raise_peaks(transaction, rest, faces, arguments.number("height"));
  });
}

void remove_cells(Session& session, const Arguments& arguments) {
  if (arguments.has("dangling")) {
    for (const char* other : {"keep", "where"})
      if (arguments.has(other))
        throw Error(ErrorCode::bad_input,
                    fmt::format("dangling means all that no cell holds; leave out {}", other));
    Swept swept;
    edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd&) {
      swept = remove_dangling(transaction);
      return Edit{};
    });
    session.print(fmt::format("{}, {} and {} removed", count_of(swept.faces, ElementType::faces),
                              count_of(swept.edges, ElementType::edges),
                              count_of(swept.vertices, ElementType::vertices)));
    return;
  }
  const Selection selection = acted_on(session, arguments, k_cells);
  const Dangling dangling = arguments.has("keep") ? Dangling::keep : Dangling::remove;
  if (dangling == Dangling::keep && session.document().state().level > 0)
    throw Error(
        ErrorCode::bad_input,
        fmt::format("what no cell holds can only be kept at level 0, and the level is {}; say `levels 0` first, "
                    "or leave out keep",
                    session.document().state().level));
  std::vector<CellId> cells;
  for (const std::uint32_t id : selection.ids) cells.emplace_back(id);
  edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd&) {
    subdiv::remove_cells(transaction, cells, dangling);
    return Edit{};
  });
}

}  // namespace

std::vector<Command> topology_commands() {
  const Parameter where_faces{
      .name = "where", .type = ArgumentType::expression, .help = "the faces, by a condition; else those selected"};
  return {
      {.name = "extrude",
       .summary =
           "Grows cells from boundary faces, straight or along a path; neighbouring faces share their walls. "
           "The far faces are selected then.",
       .parameters = {{.name = "distance",
                       .help = "how far, unless a path says so; below 0 inwards",
                       .unit = "m",
                       .positional = true,
                       .low = -1e9,
                       .high = 1e9},
                      {.name = "steps",
                       .type = ArgumentType::integer,
                       .help = "cells along the way; else 1, along a path 1 a leg, along a curve 4",
                       .low = 1,
                       .high = 1000},
                      {.name = "along",
                       .help = "direction; else the mean normal of the faces",
                       .count = 3,
                       .low = -1e9,
                       .high = 1e9},
                      {.name = "normals",
                       .help = "every vertex along the normals of its own faces, so that the region swells evenly",
                       .flag = true},
                      {.name = "path",
                       .help = "points that the middle of the faces goes through; the far faces turn with the way",
                       .unit = "m",
                       .count = 3,
                       .low = -1e9,
                       .high = 1e9,
                       .list = true},
                      {.name = "curve", .help = "round the path: a smooth curve through its points", .flag = true},
                      {.name = "scale",
                       .help = "size of the far end against the near one, about the middle of each patch",
                       .low = 1e-3,
                       .high = 1e3},
                      {.name = "twist",
                       .help = "turn of the far end against the near one, about the way",
                       .unit = "degrees",
                       .low = -36000,
                       .high = 36000},
                      where_faces},
       .example = "extrude path 0.5 0.5 1.5 1.2 0.5 1.9 curve steps 8 scale 0.2 twist 90 where z > 0.999",
       .before = {"new box 1 1 1"},
       .run = extrude_faces},
      {.name = "peak",
       .summary = "Raises a pyramid over each boundary face; the apexes are selected then.",
       .parameters = {{.name = "height",
                       .help = "of the apex over the middle of the face",
                       .unit = "m",
                       .positional = true,
                       .required = true,
                       .low = 1e-9,
                       .high = 1e9},
                      where_faces},
       .example = "peak 0.05 where z > 0.9",
       .before = {"new box 2 2 2"},
       .run = raise_peaks},
      {.name = "remove",
       .summary = "Removes cells, with the faces, edges and vertices that nothing holds any more.",
       .parameters = {{.name = "keep",
                       .help = "let faces, edges and vertices stay, to build on; only at level 0",
                       .flag = true},
                      {.name = "dangling",
                       .help = "instead of cells, every face, edge and vertex that no cell holds",
                       .flag = true},
                      {.name = "where",
                       .type = ArgumentType::expression,
                       .help = "the cells; else those selected"}},
       .example = "remove where x > 0.5",
       .before = {"new box 2 2 2"},
       .run = remove_cells},
  };
}

}  // namespace argil::sculpt
