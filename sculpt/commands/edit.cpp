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

namespace {

using namespace subdiv;

bool is_live(const Solid& solid, ElementType type, std::uint32_t id) {
  switch (type) {
    case ElementType::vertices:
      return solid.is_live(VertexId{id});
    case ElementType::edges:
      return solid.is_live(EdgeId{id});
    case ElementType::faces:
      return solid.is_live(FaceId{id});
    case ElementType::cells:
      return solid.is_live(CellId{id});
    case ElementType::nodes:
      return false;
  }
  return false;
}

Selection surviving(const Selection& selection, const Solid& solid, const std::vector<std::uint32_t>& node_map) {
  Selection result{selection.type, {}};
  for (const std::uint32_t id : selection.ids) {
    if (selection.type == ElementType::nodes) {
      if (id < node_map.size() && node_map[id] != k_no_node) result.ids.push_back(node_map[id]);
    } else if (is_live(solid, selection.type, id)) {
      result.ids.push_back(id);
    }
  }
  std::sort(result.ids.begin(), result.ids.end());
  return result;
}

}  // namespace

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
  return {types[0], matching(session.document(), types[0], nullptr)};
}

void edit_topology(
    Session& session,
    const std::function<void(Transaction&, Eigen::Matrix3Xd&, Eigen::Matrix3Xd&, Selection&)>& edit) {
  require_solid(session);
  Document& document = session.document();
  State next = document.state();
  const Refinement before = document.refinement();
  Eigen::Matrix3Xd rest = *next.rest, present = next.motion->positions;
  const Eigen::Index old_count = rest.cols();

  Transaction transaction(*next.solid);
  Selection selected = *next.selection;
  edit(transaction, rest, present, selected);
  const Solid& solid = *next.solid;
  if (solid.cell_count() == 0)
    throw Error(ErrorCode::bad_topology, "this would leave no cell; a solid has at least one");
  if (refined_cell_count(solid, next.level) > document.limits.cells)
    throw Error(ErrorCode::limit_exceeded,
                fmt::format("this would make more than {} cells at level {}; lower the level or "
                            "raise --max-cells",
                            document.limits.cells, next.level));
  const Refinement after = refine_to_level(solid, next.level, next.rules);
  const std::vector<std::uint32_t> node_map = nodes_after_edit(before, after);
  next.fields = fields_after_edit(*next.fields, node_map, after);

  auto motion = std::make_shared<fem::BodyState>(*next.motion);
  motion->velocities.conservativeResize(3, rest.cols());
  motion->velocities.rightCols(rest.cols() - old_count).setZero();
  motion->positions = std::move(present);
  motion->previous_positions.resize(3, 0);
  motion->previous_velocities.resize(3, 0);
  motion->previous_step = 0;
  next.motion = motion;
  next.rest = std::make_shared<Eigen::Matrix3Xd>(std::move(rest));

  auto pins = std::make_shared<Pins>(*next.pins);
  std::erase_if(pins->control_points, [&](std::uint32_t v) { return !solid.is_live(VertexId{v}); });
  for (SoftPin& pin : pins->nodes) pin.node = pin.node < node_map.size() ? node_map[pin.node] : k_no_node;
  std::erase_if(pins->nodes, [](const SoftPin& pin) { return pin.node == k_no_node; });
  std::sort(pins->nodes.begin(), pins->nodes.end(),
            [](const SoftPin& a, const SoftPin& b) { return a.node < b.node; });
  next.pins = pins;

  auto loads = std::make_shared<AppliedLoads>(*next.loads);
  for (AppliedForce& force : loads->forces) {
    const bool spread = !force.faces.empty();
    std::erase_if(force.faces,
                  [&](std::uint32_t f) { return !solid.is_live(FaceId{f}) || !solid.is_boundary(FaceId{f}); });
    if (spread && force.faces.empty()) {
      session.print("a force is gone with the faces that it acted on");
      force.force.setConstant(std::nan(""));
    }
  }
  std::erase_if(loads->forces, [](const AppliedForce& force) { return force.force.array().isNaN().any(); });
  next.loads = loads;

  next.selection = std::make_shared<Selection>(surviving(selected, solid, node_map));
  auto sets = std::make_shared<std::map<std::string, Selection>>();
  for (const auto& [name, set] : *next.sets) (*sets)[name] = surviving(set, solid, node_map);
  next.sets = sets;
  session.change(std::move(next), transaction.commit());
}

void check_discretization(const Session& session) {
  (void)session.document().discretization();
}

}  // namespace argil::sculpt
