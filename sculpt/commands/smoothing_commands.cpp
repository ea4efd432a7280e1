#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "io/surface.h"
#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/region.h"
#include "sculpt/session.h"
#include "subdiv/edit/smooth.h"
#include "subdiv/error.h"
#include "subdiv/query/surface_tree.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

constexpr ElementType k_movable[] = {ElementType::vertices, ElementType::edges, ElementType::faces,
                                     ElementType::cells};

// The same shift for rest, present and last positions of each vertex.
void shift_vertices(Session& session, const std::vector<VertexId>& vertices, const GuardedMotion& motion) {
  State next = session.document().state();
  auto rest = std::make_shared<Eigen::Matrix3Xd>(*next.rest);
  auto moved = std::make_shared<fem::BodyState>(*next.motion);
  for (const VertexId v : vertices) {
    const auto column = static_cast<Eigen::Index>(v.index());
    const Eigen::Vector3d shift = motion.at(v) - rest->col(column);
    rest->col(column) = motion.at(v);
    moved->positions.col(column) += shift;
    if (moved->previous_positions.cols() > 0) moved->previous_positions.col(column) += shift;
  }
  next.rest = rest;
  next.motion = moved;
  session.change(std::move(next));
}

std::vector<VertexId> vertices_to_shift(Session& session, const Arguments& arguments, bool boundary_only) {
  const Selection selection = acted_on_or_all(session, arguments, k_movable);
  std::vector<VertexId> vertices;
  for (const std::uint32_t v : vertices_of(session.document(), selection))
    if (!boundary_only || session.document().solid().is_boundary(VertexId{v})) vertices.emplace_back(v);
  if (vertices.empty())
    throw Error(ErrorCode::bad_input, "none of these vertices is on the boundary; change the condition");
  return vertices;
}

void smooth_vertices(Session& session, const Arguments& arguments) {
  std::vector<VertexId> vertices = vertices_to_shift(session, arguments, false);
  const Document& document = session.document();
  const auto& pinned = document.state().pins->control_points;
  std::erase_if(vertices, [&](VertexId v) { return std::binary_search(pinned.begin(), pinned.end(), v.value); });
  if (vertices.empty())
    throw Error(ErrorCode::bad_input, "all of these vertices are pinned, and pinned ones stay; free some first");
  GuardedMotion motion(document.solid(), document.rest(), vertices);
  smooth(document.solid(), motion, vertices,
         {.times = static_cast<int>(arguments.integer("times", 1)),
          .amount = arguments.number("amount", 1),
          .shrink = arguments.has("shrink")});
  shift_vertices(session, vertices, motion);
}

SurfaceTree surface_tree(const io::SurfaceMesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t f = 0; f + 1 < mesh.offsets.size(); ++f)
    for (std::size_t i = mesh.offsets[f] + 1; i + 1 < mesh.offsets[f + 1]; ++i)
      triangles.push_back({mesh.corners[mesh.offsets[f]], mesh.corners[i], mesh.corners[i + 1]});
  return {mesh.positions, triangles};
}

void project_vertices(Session& session, const Arguments& arguments) {
  const std::vector<VertexId> vertices = vertices_to_shift(session, arguments, true);
  const Document& document = session.document();
  std::function<Eigen::Vector3d(const Eigen::Vector3d&)> nearest;
  if (arguments.has("ball")) {
    if (arguments.has("surface"))
      throw Error(ErrorCode::bad_input, "project: expected a surface file or `ball RADIUS`, found both");
    const Eigen::Vector3d middle = arguments.vector("at", Eigen::Vector3d::Zero());
    nearest = [middle, radius = arguments.number("ball")](const Eigen::Vector3d& p) -> Eigen::Vector3d {
      return p == middle ? p : Eigen::Vector3d(middle + radius * (p - middle).normalized());
    };
  } else {
    if (!arguments.has("surface"))
      throw Error(ErrorCode::bad_input, "project: expected a surface file or `ball RADIUS`, found neither");
    if (arguments.has("at"))
      throw Error(ErrorCode::bad_input, "`at` is the middle of a ball; a surface file stands where it stands");
    nearest = [tree = std::make_shared<SurfaceTree>(surface_tree(io::read_surface(session.path_to_read(
                   arguments.word("surface")))))](const Eigen::Vector3d& p) { return tree->nearest(p); };
  }
  GuardedMotion motion(document.solid(), document.rest(), vertices);
  Eigen::Matrix3Xd targets(3, static_cast<Eigen::Index>(vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector3d p = motion.at(vertices[i]);
    targets.col(static_cast<Eigen::Index>(i)) = p + arguments.number("amount", 1) * (nearest(p) - p);
  }
  const std::size_t held = move_guarded(motion, vertices, targets);
  if (held > 0)
    session.print(
        fmt::format("{} of {} vertices stopped on the way, where cells would have closed", held, vertices.size()));
  shift_vertices(session, vertices, motion);
}

}  // namespace

std::vector<Command> smoothing_commands() {
  const Parameter where{
      .name = "where", .type = ArgumentType::expression, .help = "the vertices; else what is selected, or all"};
  return {
      {.name = "smooth",
       .summary = "Takes the bumps out of vertices, or those of the selected edges, faces or cells, without "
                  "shrinking: the boundary along itself, creases along themselves, the inside by its neighbours. "
                  "Corners and pinned vertices stay, and no cell closes.",
       .parameters =
           {{.name = "times", .type = ArgumentType::integer, .help = "how often; else 1", .low = 1, .high = 10000},
            {.name = "amount", .help = "of one time, up to 1; else 1", .low = 0, .high = 1},
            {.name = "shrink", .help = "rounds off, which also shrinks", .flag = true},
            where},
       .example = "smooth times 3 where z > 0.5",
       .before = {"new box 4 4 4"},
       .run = smooth_vertices},
      {.name = "project",
       .summary =
           "Takes boundary vertices, or those of the selected edges, faces or cells, to the nearest points of "
           "a surface, as far as no cell closes.",
       .parameters = {{.name = "surface",
                       .type = ArgumentType::text,
                       .help = "a surface mesh beneath the session's own folder",
                       .positional = true},
                      {.name = "ball", .help = "radius of a ball instead", .unit = "m", .low = 1e-9, .high = 1e9},
                      {.name = "at",
                       .help = "middle of the ball; else the origin",
                       .unit = "m",
                       .count = 3,
                       .low = -1e9,
                       .high = 1e9},
                      {.name = "amount", .help = "part of the way; else 1, all of it", .low = 0, .high = 1},
                      where},
       .example = "project ball 0.6 at 0.5 0.5 0.5",
       .before = {"new box 4 4 4"},
       .run = project_vertices},
  };
}

}  // namespace argil::sculpt
