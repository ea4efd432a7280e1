#include <fmt/format.h>

#include <Eigen/Geometry>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/region.h"
#include "sculpt/session.h"
#include "subdiv/edit/duplicate.h"
#include "subdiv/edit/mirror.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

constexpr ElementType k_movable[] = {ElementType::vertices, ElementType::edges, ElementType::faces,
                                     ElementType::cells};
constexpr ElementType k_cells[] = {ElementType::cells};

// Rest, present and last positions of some vertices, each by the same map.
void place_vertices(Session& session, const std::vector<std::uint32_t>& vertices, const Eigen::Affine3d& map) {
  State next = session.document().state();
  auto rest = std::make_shared<Eigen::Matrix3Xd>(*next.rest);
  auto motion = std::make_shared<fem::BodyState>(*next.motion);
  for (const std::uint32_t v : vertices) {
    rest->col(v) = map * Eigen::Vector3d(rest->col(v));
    motion->positions.col(v) = map * Eigen::Vector3d(motion->positions.col(v));
    if (motion->previous_positions.cols() > 0)
      motion->previous_positions.col(v) = map * Eigen::Vector3d(motion->previous_positions.col(v));
  }
  if (!rest->allFinite() || !motion->positions.allFinite())
    throw Error(ErrorCode::bad_geometry, "vertices would move out of all bounds; use smaller numbers");
  next.rest = rest;
  next.motion = motion;
  session.change(std::move(next));
}

void move(Session& session, const Arguments& arguments) {
  const Selection selection = acted_on(session, arguments, k_movable);
  place_vertices(session, vertices_of(session.document(), selection),
                 Eigen::Affine3d(Eigen::Translation3d(arguments.vector("by"))));
}

Eigen::Affine3d turn(const Arguments& arguments) {
  const Eigen::Vector3d axis = arguments.vector("axis", Eigen::Vector3d::UnitZ());
  if (!(axis.norm() > 0))
    throw Error(ErrorCode::bad_input, "the axis is zero; expected a direction, as in `axis 0 0 1`");
  if (arguments.has("axis") && !arguments.has("rotate"))
    throw Error(ErrorCode::bad_input, "there is an axis but no angle; say `rotate DEGREES axis X Y Z`");
  constexpr double k_degree = EIGEN_PI / 180;
  const Eigen::Translation3d about(arguments.vector("about", Eigen::Vector3d::Zero()));
  return about * Eigen::AngleAxisd(arguments.number("rotate", 0) * k_degree, axis.normalized()) * about.inverse();
}

void transform(Session& session, const Arguments& arguments) {
  const Selection selection = acted_on_or_all(session, arguments, k_movable);
  if (!arguments.has("scale") && !arguments.has("stretch") && !arguments.has("rotate"))
    throw Error(ErrorCode::bad_input,
                "transform: expected scale, stretch or rotate, as in `transform scale 2`, found none");
  const Eigen::Vector3d factors =
      arguments.number("scale", 1) * arguments.vector("stretch", Eigen::Vector3d::Ones());
  if (factors.prod() < 0)
    throw Error(ErrorCode::bad_input,
                "these factors would turn the cells inside out; use `mirror … flip` for a mirror image");
  if (factors.prod() == 0)
    throw Error(ErrorCode::bad_input, "a factor of 0 would flatten the cells; use a small one");
  const Eigen::Translation3d about(arguments.vector("about", Eigen::Vector3d::Zero()));
  place_vertices(session, vertices_of(session.document(), selection),
                 turn(arguments) * (about * Eigen::Scaling(factors) * about.inverse()));
}

std::vector<CellId> cells_of(const Selection& selection) {
  return {selection.ids.begin(), selection.ids.end()};
}

void mirror_cells(Session& session, const Arguments& arguments) {
  const Plane plane{arguments.vector("at", Eigen::Vector3d::Zero()), arguments.vector("normal")};
  if (arguments.has("flip")) {
    for (const char* name : {"weld", "keep", "where"})
      if (arguments.has(name))
        throw Error(ErrorCode::bad_input,
                    fmt::format("`flip` turns the whole solid and makes no copy; leave out `{}`", name));
    require_solid(session);
    edit_solid(session,
               [&](Transaction& transaction, const Eigen::Matrix3Xd&) { return reflect(transaction, plane); });
    return;
  }
  if (arguments.has("keep") && arguments.has("weld"))
    throw Error(ErrorCode::bad_input, "`keep` leaves the image apart, `weld` joins it; leave one out");
  const std::vector<CellId> cells = cells_of(acted_on_or_all(session, arguments, k_cells));
  check_cells(session, static_cast<double>(session.document().solid().cell_count() + cells.size()));
  const double weld = arguments.has("keep") ? -1 : arguments.number("weld", 1e-6);
  edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd& rest) {
    return mirror(transaction, rest, cells, plane, {weld});
  });
}

void duplicate_cells(Session& session, const Arguments& arguments) {
  const std::vector<CellId> cells = cells_of(acted_on_or_all(session, arguments, k_cells));
  const long count = arguments.integer("count", 1);
  check_cells(session, static_cast<double>(session.document().solid().cell_count()) +
                           static_cast<double>(count) * static_cast<double>(cells.size()));
  const Eigen::Affine3d step =
      Eigen::Translation3d(arguments.vector("by", Eigen::Vector3d::Zero())) * turn(arguments);
  edit_solid(session, [&](Transaction& transaction, const Eigen::Matrix3Xd&) {
    return duplicate(transaction, cells, static_cast<int>(count), step);
  });
}

Parameter vector_parameter(const char* name, const char* help, const char* unit = "m") {
  return {.name = name, .help = help, .unit = unit, .count = 3, .low = -1e9, .high = 1e9};
}

Parameter where_parameter(const char* help) {
  return {.name = "where", .type = ArgumentType::expression, .help = help};
}

}  // namespace

std::vector<Command> transform_commands() {
  Parameter by = vector_parameter("by", "the shift");
  by.positional = by.required = true;
  const Parameter about = vector_parameter("about", "the point that stays; else the origin");
  const Parameter axis = vector_parameter("axis", "of the turn; else 0 0 1", "");
  const Parameter cells = where_parameter("the cells; else those selected, or all if no cells are");
  const Parameter rotate{
      .name = "rotate", .help = "angle about the axis", .unit = "degrees", .low = -3600, .high = 3600};
  Parameter normal = vector_parameter("normal", "across the plane, of any length", "");
  normal.required = true;
  return {
      {.name = "move",
       .summary = "Moves the selected vertices, or those of the selected edges, faces or cells.",
       .parameters = {by, where_parameter("the vertices; else what is selected")},
       .example = "move 0 0.05 0 where z > 0.8",
       .before = {"new box 2 2 2"},
       .run = move},
      {.name = "transform",
       .summary = "Scales, then turns vertices, or those of the selected edges, faces or cells, about a point.",
       .parameters = {{.name = "scale", .help = "factor in every direction", .low = -1e6, .high = 1e6},
                      vector_parameter("stretch", "factors along x, y and z", ""),
                      rotate,
                      axis,
                      about,
                      where_parameter("the vertices; else what is selected, or all")},
       .example = "transform stretch 0.8 0.8 1 rotate 30 about 0.5 0.5 0 where z > 0.9",
       .before = {"new box 2 2 4"},
       .run = transform},
      {.name = "mirror",
       .summary =
           "Grows the mirror image of cells that lie on one side of a plane; what lies in the plane is shared "
           "and its faces become interior. Images join the named sets of what they are images of, and "
           "are pinned where those are.",
       .parameters = {normal,
                      vector_parameter("at", "a point of the plane; else the origin"),
                      {.name = "weld",
                       .help = "vertices so near the plane are put on it and shared; else 1e-6",
                       .unit = "m",
                       .low = 0,
                       .high = 1e9},
                      {.name = "keep", .help = "leaves the image a solid of its own", .flag = true},
                      {.name = "flip", .help = "turns the whole solid instead of copying it", .flag = true},
                      cells},
       .example = "mirror normal 1 0 0",
       .before = {"new box 2 2 2", "select faces where x > 0.99 and z > 0.5", "extrude 0.4 steps 2"},
       .run = mirror_cells},
      {.name = "duplicate",
       .summary = "Copies cells as solids of their own, each moved and turned against the one before. Named sets "
                  "stay what they were; the copies are selected then.",
       .parameters = {vector_parameter("by", "from one to the next, after the turn"),
                      rotate,
                      axis,
                      about,
                      {.name = "count",
                       .type = ArgumentType::integer,
                       .help = "how many copies; else 1",
                       .low = 1,
                       .high = 100000},
                      cells},
       .example = "duplicate rotate 60 count 5",
       .before = {"new box 2 1 1 at 1 -0.5 0"},
       .run = duplicate_cells},
  };
}

}  // namespace argil::sculpt
