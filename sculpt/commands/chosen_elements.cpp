#include "sculpt/commands/chosen_elements.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "sculpt/region.h"
#include "sculpt/selection.h"
#include "subdiv/edge_walks.h"
#include "subdiv/error.h"
#include "subdiv/sort_unique.h"

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
constexpr const char* k_filters[] = {"where",  "ray",   "box", "sphere", "boundary",
                                     "inside", "angle", "set", "ids",    "selected"};
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

bool is_there(const Document& document, ElementType type, double number) {
  const Solid& solid = type == ElementType::nodes ? document.refinement().solid() : document.solid();
  const auto id = static_cast<std::uint32_t>(number);
  switch (type) {
    case ElementType::edges:
      return solid.is_live(EdgeId{id});
    case ElementType::faces:
      return solid.is_live(FaceId{id});
    case ElementType::cells:
      return solid.is_live(CellId{id});
    default:
      return solid.is_live(VertexId{id});
  }
}

// Those that are named, ascending.
std::vector<std::uint32_t> named_elements(const Document& document, const Arguments& arguments, ElementType type) {
  std::vector<std::uint32_t> ids;
  for (const double number : arguments.numbers("ids")) {
    if (!is_there(document, type, number))
      throw Error(ErrorCode::not_found,
                  fmt::format("there are no {} with the number {:.0f}; name those that there are, or choose by "
                              "place, as in `select {} where z > 0`",
                              word(type), number, word(type)));
    ids.push_back(static_cast<std::uint32_t>(number));
  }
  subdiv::sort_unique(ids);
  return ids;
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
  if (arguments.has("ids")) keep_of(named_elements(document, arguments, type));
  if (arguments.has("selected")) {
    const Selection& selected = *document.state().selection;
    if (selected.type != type && !selected.ids.empty())
      throw Error(ErrorCode::bad_input,
                  fmt::format("what is selected now are {}, not {}; write `select {} selected`",
                              word(selected.type), word(type), word(selected.type)));
    keep_of(selected.ids);
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

}  // namespace

void check_choice(const Arguments& arguments, ElementType type) {
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

Selection chosen_elements(const Document& document, const Arguments& arguments, ElementType type) {
  const std::vector<std::string> ways = given(arguments, k_ways);
  if (ways.empty()) return filtered(document, arguments, type);
  return gone_on(document, arguments, ways[0], seeds_of(document, arguments, type, ways[0]));
}

}  // namespace argil::sculpt
