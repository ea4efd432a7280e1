#include "sculpt/commands/edit.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "sculpt/field_transfer.h"
#include "sculpt/region.h"
#include "sculpt/session.h"
#include "subdiv/error.h"
#include "subdiv/radial_edge.h"

namespace argil::sculpt {

using namespace subdiv;

ElementType element_type(const std::string& name) {
  for (const ElementType type :
       {ElementType::vertices, ElementType::edges, ElementType::faces, ElementType::cells, ElementType::nodes})
    if (name == word(type)) return type;
  throw Error(ErrorCode::bad_input, fmt::format("'{}' is not vertices, edges, faces, cells or nodes", name));
}

// A new solid begins a new document: level 0, initial fields, nothing pinned.
State state_of(Built built) {
  State state;
  state.solid = std::make_shared<Solid>(std::move(built.solid));
  auto motion = std::make_shared<fem::BodyState>();
  motion->positions = built.positions;
  motion->velocities = Eigen::Matrix3Xd::Zero(3, built.positions.cols());
  state.motion = motion;
  state.rest = std::make_shared<Eigen::Matrix3Xd>(std::move(built.positions));
  state.fields = initial_fields(state.solid->vertex_capacity());
  state.pins = std::make_shared<Pins>();
  state.loads = std::make_shared<AppliedLoads>();
  state.selection = std::make_shared<Selection>();
  state.sets = std::make_shared<std::map<std::string, Selection>>();
  return state;
}

// Topology, stencils, elements and one step of a box of 373,248 cells took 2.5 GB.
constexpr double k_bytes_per_cell = 7000;

void check_cells(const Session& session, double cells) {
  const Limits& limits = session.options().limits;
  if (cells > static_cast<double>(limits.cells))
    throw Error(ErrorCode::limit_exceeded,
                fmt::format("this makes {:.0f} cells, more than {}; lower the level or the counts, "
                            "or raise --max-cells",
                            cells, limits.cells));
  if (k_bytes_per_cell * cells > static_cast<double>(limits.memory))
    throw Error(ErrorCode::limit_exceeded,
                fmt::format("{:.0f} cells would need about {:.2g} GB; lower the level or the counts, "
                            "or raise --max-memory",
                            cells, 1e-9 * k_bytes_per_cell * cells));
}

// The area-weighted mean of the outward normals of some boundary faces.
Eigen::Vector3d mean_normal(const Solid& solid, const Eigen::Matrix3Xd& positions,
                            const std::vector<std::uint32_t>& faces) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::uint32_t id : faces) {
    const auto loop = use_vertices(solid, solid.boundary_use(FaceId{id}));
    for (std::size_t i = 0; i < loop.size(); ++i)
      sum += positions.col(static_cast<Eigen::Index>(loop[i].index()))
                 .cross(positions.col(static_cast<Eigen::Index>(loop[(i + 1) % loop.size()].index())));
  }
  if (sum.norm() < 1e-300)
    throw Error(ErrorCode::bad_geometry, "the faces have no common direction; give one with `along X Y Z`");
  return sum.normalized();
}

void require_solid(const Session& session) {
  if (session.document().empty())
    throw Error(ErrorCode::bad_input, "there is no solid yet; begin with `new box 2 2 2` or `open FILE`");
}

Selection acted_on(const Session& session, const Arguments& arguments, std::span<const ElementType> types) {
  require_solid(session);
  const Document& document = session.document();
  std::string wanted;
  for (const ElementType type : types) wanted += (wanted.empty() ? "" : " or ") + std::string(word(type));
  Selection selection;
  if (const Expression* where = arguments.expression("where")) {
    selection.type = types[0];
    selection.ids = matching(document, types[0], where);
  } else {
    selection = *document.state().selection;
    if (std::find(types.begin(), types.end(), selection.type) == types.end())
      throw Error(ErrorCode::bad_input, fmt::format("this acts on {}, and what is selected are {}; select {} first",
                                                    wanted, word(selection.type), wanted));
  }
  if (selection.ids.empty())
    throw Error(ErrorCode::bad_input, fmt::format("no {} fit; change the condition or the selection", wanted));
  return selection;
}

Selection acted_on_or_all(const Session& session, const Arguments& arguments, std::span<const ElementType> types) {
  require_solid(session);
  const Selection& selected = *session.document().state().selection;
  const bool fits = std::find(types.begin(), types.end(), selected.type) != types.end();
  if (arguments.has("where") || (fits && !selected.ids.empty())) return acted_on(session, arguments, types);
  Selection all{types[0], matching(session.document(), types[0], nullptr)};
  session.print(fmt::format("nothing is selected for this: it acts on all {}", count_of(all.ids.size(), all.type)));
  return all;
}

void check_discretization(const Session& session) {
  (void)session.document().discretization();
}

}  // namespace argil::sculpt
