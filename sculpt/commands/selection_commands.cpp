#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sculpt/commands/commands.h"
#include "sculpt/commands/edit.h"
#include "sculpt/near_names.h"
#include "sculpt/region.h"
#include "sculpt/selection.h"
#include "sculpt/session.h"
#include "subdiv/edge_walks.h"
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

// Arguments that narrow what is chosen, and those that go on from it.
constexpr const char* k_filters[] = {"where", "ray", "box", "sphere", "boundary", "inside", "angle", "set"};
constexpr const char* k_ways[] = {"component", "loop", "ring", "grow", "shrink", "invert"};

std::vector<std::string> given(const Arguments& arguments, std::span<const char* const> names) {
  std::vector<std::string> found;
  for (const char* name : names)
    if (arguments.has(name)) found.emplace_back(name);
  return found;
}

void refuse_both(const Arguments& arguments, const char* one, const char* other) {
  if (arguments.has(one) && arguments.has(other))
    throw Error(ErrorCode::bad_input, fmt::format("{} and {} exclude each other; leave one out", one, other));
}

// Flags that contradict each other, or that would do nothing.
void check_flags(const Arguments& arguments, ElementType type) {
  refuse_both(arguments, "any", "all");
  refuse_both(arguments, "add", "remove");
  refuse_both(arguments, "boundary", "inside");
  if ((arguments.has("any") || arguments.has("all")) && !arguments.has("where") && !arguments.has("box") &&
      !arguments.has("sphere"))
    throw Error(ErrorCode::bad_input,
                "any and all say how a condition is asked; add `where …`, `box …` or `sphere …`");
  if (arguments.has("interior") && type != ElementType::faces)
    throw Error(ErrorCode::bad_input,
                fmt::format("interior is for faces; {} inside the solid are chosen in any case (`inside` chooses "
                            "them alone)",
                            word(type)));
  const std::vector<std::string> ways = given(arguments, k_ways);
  if (ways.size() > 1)
    throw Error(ErrorCode::bad_input,
                fmt::format("{} and {} in one line; write a line for each", ways[0], ways[1]));
  for (const char* name : {"angle", "loop", "ring"})
    if (arguments.has(name) && type != ElementType::edges)
      throw Error(ErrorCode::bad_input, fmt::format("{} is asked of edges; write `select edges {}`", name,
                                                    name == std::string("angle") ? "angle 30" : name));
  if (arguments.has("none")) {
    std::vector<std::string> others = given(arguments, k_filters);
    others.insert(others.end(), ways.begin(), ways.end());
    for (const char* other : {"interior", "add", "remove", "as"})
      if (arguments.has(other)) others.emplace_back(other);
    if (!others.empty())
      throw Error(ErrorCode::bad_input, fmt::format("none chooses nothing; leave out {}", others[0]));
  }
}

void keep_in_space(const Document& document, const Arguments& arguments, Asked asked, Selection& selection) {
  const auto keep = [&](const std::function<bool(const Eigen::Vector3d&)>& region) {
    keep_within(document, selection.type, asked, region, selection.ids);
  };
  if (arguments.has("box")) {
    const auto& corners = arguments.numbers("box");
    const Eigen::Vector3d a(corners[0], corners[1], corners[2]), b(corners[3], corners[4], corners[5]);
    const Eigen::Vector3d low = a.cwiseMin(b), high = a.cwiseMax(b);
    keep([&](const Eigen::Vector3d& p) {
      return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
    });
  }
  if (arguments.has("sphere")) {
    const auto& ball = arguments.numbers("sphere");
    if (!(ball[3] > 0))
      throw Error(ErrorCode::bad_input,
                  fmt::format("a sphere is `sphere X Y Z RADIUS` with a radius above 0, found {}", ball[3]));
    const Eigen::Vector3d middle(ball[0], ball[1], ball[2]);
    keep([&](const Eigen::Vector3d& p) { return (p - middle).squaredNorm() <= ball[3] * ball[3]; });
  }
  if (arguments.has("boundary") || arguments.has("inside"))
    keep_boundary(document, selection.type, arguments.has("boundary"), selection.ids);
}

// What the filters let through of all the elements of the type.
Selection filtered(const Document& document, const Arguments& arguments, ElementType type) {
  const Asked asked = arguments.has("any")   ? Asked::any_vertex
                      : arguments.has("all") ? Asked::all_vertices
                                             : Asked::centroid;
  const bool interior = arguments.has("interior") || (type == ElementType::faces && arguments.has("inside"));
  Selection selection{type, matching(document, type, arguments.expression("where"), interior, asked)};
  const auto keep_of = [&](const std::vector<std::uint32_t>& others) {
    std::vector<std::uint32_t> both;
    std::set_intersection(selection.ids.begin(), selection.ids.end(), others.begin(), others.end(),
                          std::back_inserter(both));
    selection.ids = std::move(both);
  };
  if (arguments.has("ray")) {
    const auto& ray = arguments.numbers("ray");
    keep_of(picked(document, type, {ray[0], ray[1], ray[2]}, {ray[3], ray[4], ray[5]}));
  }
  keep_in_space(document, arguments, asked, selection);
  if (arguments.has("angle")) {
    const double cosine = std::cos(arguments.number("angle") * std::numbers::pi / 180);
    std::erase_if(selection.ids, [&](std::uint32_t id) {
      return !document.solid().is_boundary(EdgeId{id}) ||
             !bends(document.solid(), document.rest(), EdgeId{id}, cosine);
    });
  }
  if (arguments.has("set")) {
    const auto& sets = *document.state().sets;
    const auto found = sets.find(arguments.word("set"));
    if (found == sets.end() || found->second.type != type)
      throw Error(ErrorCode::not_found,
                  fmt::format("there is no set of {} named '{}'; make one with `select {} … as {}`", word(type),
                              arguments.word("set"), word(type), arguments.word("set")));
    keep_of(found->second.ids);
  }
  return selection;
}

// What a way of going on begins with: what the filters choose, else what is selected.
Selection seeds_of(const Document& document, const Arguments& arguments, ElementType type, const std::string& way) {
  if (!given(arguments, k_filters).empty()) return filtered(document, arguments, type);
  const Selection& selected = *document.state().selection;
  if (way == "invert" && selected.ids.empty()) return {type, {}};
  if (selected.type != type || selected.ids.empty())
    throw Error(
        ErrorCode::bad_input,
        fmt::format("{} goes on from what is selected, and that is {}; select {} first, or say from which, as "
                    "in `select {} {} where z > 0`",
                    way, selected.ids.empty() ? "nothing" : count_of(selected.ids.size(), selected.type),
                    word(type), word(type), way));
  return selected;
}

Selection gone_on(const Document& document, const Arguments& arguments, const std::string& way, Selection seeds) {
  const bool interior = arguments.has("interior");
  if (way == "component") return whole_components(document, seeds, interior);
  if (way == "invert") {
    const auto all = matching(document, seeds.type, nullptr, interior);
    Selection result{seeds.type, {}};
    std::set_difference(all.begin(), all.end(), seeds.ids.begin(), seeds.ids.end(), std::back_inserter(result.ids));
    return result;
  }
  if (way == "grow" || way == "shrink") {
    const auto& steps = arguments.numbers(way);
    const long count = steps.empty() ? 1 : static_cast<long>(steps[0]);
    return way == "grow" ? grown(document, seeds, count, interior) : shrunk(document, seeds, count, interior);
  }
  std::vector<EdgeId> edges;
  for (const std::uint32_t id : seeds.ids) edges.emplace_back(id);
  const auto walked = way == "loop" ? edge_loops(document.solid(), edges) : edge_rings(document.solid(), edges);
  seeds.ids.clear();
  for (const EdgeId e : walked) seeds.ids.push_back(e.value);
  return seeds;
}

// With `add` or `remove`, joined to what is selected or taken from it.
void combine(const Document& document, const Arguments& arguments, Selection& selection) {
  if (!arguments.has("add") && !arguments.has("remove")) return;
  const Selection& old = *document.state().selection;
  if (old.type != selection.type && !old.ids.empty())
    throw Error(ErrorCode::bad_input, fmt::format("what is selected now are {}, not {}; leave out add and remove",
                                                  word(old.type), word(selection.type)));
  std::vector<std::uint32_t> result;
  if (arguments.has("add"))
    std::set_union(old.ids.begin(), old.ids.end(), selection.ids.begin(), selection.ids.end(),
                   std::back_inserter(result));
  else
    std::set_difference(old.ids.begin(), old.ids.end(), selection.ids.begin(), selection.ids.end(),
                        std::back_inserter(result));
  selection.ids = std::move(result);
}

void select(Session& session, const Arguments& arguments) {
  const Document& document = session.document();
  State next = document.state();
  Selection selection{element_type(arguments.word("type")), {}};
  require_solid(session);
  check_flags(arguments, selection.type);
  if (arguments.has("none")) {
    next.selection = std::make_shared<Selection>(selection);
    session.change(std::move(next));
    return;
  }
  const std::vector<std::string> ways = given(arguments, k_ways);
  if (ways.empty())
    selection = filtered(document, arguments, selection.type);
  else
    selection = gone_on(document, arguments, ways[0], seeds_of(document, arguments, selection.type, ways[0]));
  const bool missed = selection.ids.empty();
  combine(document, arguments, selection);
  if (arguments.has("as")) {
    auto sets = std::make_shared<std::map<std::string, Selection>>(*document.state().sets);
    (*sets)[arguments.word("as")] = selection;
    next.sets = std::move(sets);
  }
  session.print(fmt::format("{} selected{}", count_of(selection.ids.size(), selection.type),
                            !missed                ? ""
                            : arguments.has("ray") ? ": the ray meets nothing that fits"
                                                   : ": nothing fits"));
  next.selection = std::make_shared<Selection>(std::move(selection));
  session.change(std::move(next));
}

void manage_sets(Session& session, const Arguments& arguments) {
  require_solid(session);
  State next = session.document().state();
  if (!arguments.has("forget")) {
    if (next.sets->empty()) session.print("there are no named sets; make one with `select faces … as NAME`");
    for (const auto& [name, set] : *next.sets)
      session.print(fmt::format("{}: {}", io::quote(name), count_of(set.ids.size(), set.type)));
    return;
  }
  const std::string& name = arguments.word("forget");
  auto sets = std::make_shared<std::map<std::string, Selection>>(*next.sets);
  if (sets->erase(name) == 0) {
    std::vector<std::string> names;
    for (const auto& [known, unused] : *sets) names.push_back(known);
    throw Error(ErrorCode::not_found, fmt::format("there is no set named '{}'{}; `sets` lists them all", name,
                                                  near_names_hint(name, names)));
  }
  next.sets = std::move(sets);
  session.change(std::move(next));
}

}  // namespace

std::vector<Command> selection_commands() {
  return {
      {.name = "select",
       .summary = "Chooses vertices, edges, faces or cells of the control solid, or nodes of the finest level: all "
                  "that fit, or going on from those that fit or are selected.",
       .parameters =
           {{.name = "type",
             .type = ArgumentType::word,
             .help = "what to choose",
             .positional = true,
             .required = true,
             .choices = {"vertices", "edges", "faces", "cells", "nodes"}},
            {.name = "ray",
             .help =
                 "the first met from a point along a direction: a face, its nearest vertex or edge, or its cell",
             .unit = "m",
             .count = 6,
             .low = -1e9,
             .high = 1e9},
            {.name = "box",
             .help = "within a box between two corners, as the solid stands now",
             .unit = "m",
             .count = 6,
             .low = -1e9,
             .high = 1e9},
            {.name = "sphere",
             .help = "within a ball: its middle and radius, as the solid stands now",
             .unit = "m",
             .count = 4,
             .low = -1e9,
             .high = 1e9},
            {.name = "boundary", .help = "only on the boundary", .flag = true},
            {.name = "inside", .help = "only inside, off the boundary", .flag = true},
            {.name = "interior", .help = "faces inside the solid as well", .flag = true},
            {.name = "any",
             .help = "the condition holds at one of its vertices (else at the centroid)",
             .flag = true},
            {.name = "all", .help = "the condition holds at all of its vertices", .flag = true},
            {.name = "none", .help = "choose nothing", .flag = true},
            {.name = "add", .help = "add to what is selected", .flag = true},
            {.name = "remove", .help = "take away from what is selected", .flag = true},
            {.name = "component",
             .help = "go on to whole pieces of the solid (cells connected through faces)",
             .flag = true},
            {.name = "loop",
             .help = "go on along edges, straight over regular vertices, as round an arm",
             .flag = true},
            {.name = "ring",
             .help = "go on across quadrilaterals to the parallel edges; inside, through hexahedra",
             .flag = true},
            {.name = "grow",
             .type = ArgumentType::integer,
             .help = "go on to what touches, so many times",
             .low = 1,
             .high = 1e6,
             .value_optional = true},
            {.name = "shrink",
             .type = ArgumentType::integer,
             .help = "leave out what touches the rest, so many times",
             .low = 1,
             .high = 1e6,
             .value_optional = true},
            {.name = "invert", .help = "choose all the others", .flag = true},
            {.name = "angle", .help = "boundary edges that bend by more", .unit = "degrees", .low = 0, .high = 180},
            {.name = "set", .type = ArgumentType::text, .help = "only members of this named set"},
            {.name = "as", .type = ArgumentType::text, .help = "keep the result as a named set"},
            {.name = "where",
             .type = ArgumentType::expression,
             .help = "a condition on x y z px py pz, boundary, "
                     "valence and the fields"}},
       .example = "select faces where z < 0.001 and (x < 0.15 or x > 0.45)",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1"},
       .run = select},
      {.name = "sets",
       .summary = "Lists the named sets, or forgets one.",
       .parameters = {{.name = "forget", .type = ArgumentType::text, .help = "the set that goes"}},
       .example = "sets forget rim",
       .before = {"new box 4 4 1 size 0.6 0.6 0.1", "select edges angle 30 as rim"},
       .run = manage_sets}};
}

}  // namespace argil::sculpt
