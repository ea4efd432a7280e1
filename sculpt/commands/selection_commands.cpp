#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/region.h"
#include "sculpt/session.h"
#include "subdiv/error.h"

namespace argil::sculpt {

namespace {

using namespace subdiv;

Eigen::Vector3d outward_normal(const Solid& solid, const Eigen::Matrix3Xd& positions, FaceId face) {
  const auto loop = solid.face_vertices(face);
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < loop.size(); ++i)
    normal += positions.col(static_cast<Eigen::Index>(loop[i].index()))
                  .cross(positions.col(static_cast<Eigen::Index>(loop[(i + 1) % loop.size()].index())));
  if (is_back(solid.boundary_use(face))) normal = -normal;
  return normal.normalized();
}

// Boundary edges whose two boundary faces meet at more than an angle.
bool bends(const Solid& solid, const Eigen::Matrix3Xd& positions, EdgeId edge, double cosine) {
  std::vector<FaceId> faces;
  solid.for_each_face(edge, [&](FaceId f) {
    if (solid.is_boundary(f)) faces.push_back(f);
  });
  return faces.size() == 2 &&
         outward_normal(solid, positions, faces[0]).dot(outward_normal(solid, positions, faces[1])) < cosine;
}

// Flags that contradict each other, or that would do nothing.
void check_flags(const Arguments& arguments, ElementType type) {
  if (arguments.has("any") && arguments.has("all"))
    throw Error(ErrorCode::bad_input, "any and all exclude each other; leave one out");
  if (arguments.has("add") && arguments.has("remove"))
    throw Error(ErrorCode::bad_input, "add and remove exclude each other; leave one out");
  if ((arguments.has("any") || arguments.has("all")) && !arguments.has("where"))
    throw Error(ErrorCode::bad_input, "any and all say how a condition is asked; add `where …`");
  if (arguments.has("interior") && type != ElementType::faces)
    throw Error(ErrorCode::bad_input,
                fmt::format("interior is for faces; {} inside the solid are chosen in any case", word(type)));
  if (arguments.has("none"))
    for (const char* other : {"where", "interior", "add", "remove", "angle", "set", "as"})
      if (arguments.has(other))
        throw Error(ErrorCode::bad_input, fmt::format("none chooses nothing; leave out {}", other));
}

void select(Session& session, const Arguments& arguments) {
  const Document& document = session.document();
  State next = document.state();
  Selection selection;
  selection.type = element_type(arguments.word("type"));
  require_solid(session);
  check_flags(arguments, selection.type);
  if (arguments.has("none")) {
    next.selection = std::make_shared<Selection>(selection);
    session.change(std::move(next));
    return;
  }
  const Asked asked = arguments.has("any")   ? Asked::any_vertex
                      : arguments.has("all") ? Asked::all_vertices
                                             : Asked::centroid;
  selection.ids =
      matching(document, selection.type, arguments.expression("where"), arguments.has("interior"), asked);
  if (arguments.has("angle")) {
    if (selection.type != ElementType::edges)
      throw Error(ErrorCode::bad_input, "angle is asked of edges; write `select edges angle 30`");
    const double cosine = std::cos(arguments.number("angle") * std::numbers::pi / 180);
    std::erase_if(selection.ids, [&](std::uint32_t id) {
      return !document.solid().is_boundary(EdgeId{id}) ||
             !bends(document.solid(), document.rest(), EdgeId{id}, cosine);
    });
  }
  if (arguments.has("set")) {
    const auto& sets = *document.state().sets;
    const auto found = sets.find(arguments.word("set"));
    if (found == sets.end() || found->second.type != selection.type)
      throw Error(
          ErrorCode::not_found,
          fmt::format("there is no set of {} named '{}'; make one with `select {} … as {}`", word(selection.type),
                      arguments.word("set"), word(selection.type), arguments.word("set")));
    std::vector<std::uint32_t> both;
    std::set_intersection(selection.ids.begin(), selection.ids.end(), found->second.ids.begin(),
                          found->second.ids.end(), std::back_inserter(both));
    selection.ids = std::move(both);
  }
  const bool combine = arguments.has("add") || arguments.has("remove");
  if (combine) {
    if (document.state().selection->type != selection.type)
      throw Error(ErrorCode::bad_input, fmt::format("what is selected now are {}, not {}; leave out add and remove",
                                                    word(document.state().selection->type), word(selection.type)));
    const auto& old = document.state().selection->ids;
    std::vector<std::uint32_t> result;
    if (arguments.has("add"))
      std::set_union(old.begin(), old.end(), selection.ids.begin(), selection.ids.end(),
                     std::back_inserter(result));
    else
      std::set_difference(old.begin(), old.end(), selection.ids.begin(), selection.ids.end(),
                          std::back_inserter(result));
    selection.ids = std::move(result);
  }
  if (arguments.has("as")) {
    auto sets = std::make_shared<std::map<std::string, Selection>>(*document.state().sets);
    (*sets)[arguments.word("as")] = selection;
    next.sets = std::move(sets);
  }
  session.print(fmt::format("{} selected", count_of(selection.ids.size(), selection.type)));
  next.selection = std::make_shared<Selection>(std::move(selection));
  session.change(std::move(next));
}

}  // namespace

std::vector<Command> selection_commands() {
  return {
      {.name = "select",
       .summary = "Chooses vertices, edges, faces or cells of the control solid, or nodes of the finest level.",
       .parameters =
           {{.name = "type",
             .type = ArgumentType::word,
             .help = "what to choose",
             .positional = true,
             .required = true,
             .choices = {"vertices", "edges", "faces", "cells", "nodes"}},
            {.name = "interior", .help = "faces inside the solid as well", .flag = true},
            {.name = "any",
             .help = "the condition holds at one of its vertices (else at the centroid)",
             .flag = true},
            {.name = "all", .help = "the condition holds at all of its vertices", .flag = true},
            {.name = "none", .help = "choose nothing", .flag = true},
            {.name = "add", .help = "add to what is selected", .flag = true},
            {.name = "remove", .help = "take away from what is selected", .flag = true},
            {.name = "angle", .help = "boundary edges that bend by more", .unit = "degrees", .low = 0, .high = 180},
            {.name = "set", .type = ArgumentType::text, .help = "only members of this named set"},
            {.name = "as", .type = ArgumentType::text, .help = "keep the result as a named set"},
            {.name = "where",
             .type = ArgumentType::expression,
             .help = "a condition on x y z px py pz, boundary, "
                     "valence and the fields"}},
       .example = "select faces where z < 0.001 and (x < 0.15 or x > 0.45)",
       .run = select}};
}

}  // namespace argil::sculpt
