#include "sculpt/document_loads.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "subdiv/error.h"

namespace argil::sculpt {

using namespace subdiv;

std::vector<FaceId> finest_faces(const Refinement& refinement, const std::vector<std::uint32_t>& control_faces) {
  std::vector<std::uint8_t> chosen(refinement.levels[0].face_capacity(), 0);
  for (const std::uint32_t f : control_faces) chosen[f] = 1;
  for (std::size_t level = 1; level < refinement.levels.size(); ++level) {
    // A fine face that came of a coarse one holds the coarse face's point; those points follow the vertices and
    // edges.
    const Solid& coarse = refinement.levels[level - 1];
    const Solid& fine = refinement.levels[level];
    const std::size_t first = coarse.vertex_count() + coarse.edge_count();
    std::vector<std::uint8_t> chosen_point;
    chosen_point.reserve(coarse.face_count());
    for (const FaceId f : coarse.faces()) chosen_point.push_back(chosen[f.index()]);
    std::vector<std::uint8_t> next(fine.face_capacity(), 0);
    for (const FaceId f : fine.faces()) {
      if (!fine.is_boundary(f)) continue;
      for (const VertexId v : fine.face_vertices(f))
        if (v.index() >= first && v.index() < first + chosen_point.size() && chosen_point[v.index() - first])
          next[f.index()] = 1;
    }
    chosen = std::move(next);
  }
  std::vector<FaceId> faces;
  for (std::size_t f = 0; f < chosen.size(); ++f)
    if (chosen[f]) faces.emplace_back(f);
  return faces;
}

fem::MaterialPoint material_point(const Document& document, const Eigen::Vector3d& rest_position) {
  try {
    return fem::locate(document.discretization(), rest_position);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::not_found) throw;
    throw Error(
        ErrorCode::bad_input,
        fmt::format(
            "({:g}, {:g}, {:g}) is not inside the solid; give the rest position of a point in it (refinement "
            "draws smooth boundaries inwards)",
            rest_position.x(), rest_position.y(), rest_position.z()));
  }
}

namespace {

/// Per block and element: whether it lies in one of these control cells.
std::vector<std::vector<std::uint8_t>> elements_in(const Document& document,
                                                   const std::vector<std::uint32_t>& cells) {
  const fem::Discretization& d = document.discretization();
  // Elements of cubic space may be of finer cells than those of the finest level.
  std::size_t finest = 0;
  for (const fem::ElementBlock& block : d.blocks)
    for (const fem::ElementOrigin& origin : block.origins) finest = std::max<std::size_t>(finest, origin.level);
  const Refinement* refinement = &document.refinement();
  std::optional<Refinement> finer;
  if (finest > static_cast<std::size_t>(refinement->finest())) {
    finer = refine_to_level(document.solid(), static_cast<int>(finest), document.state().rules);
    refinement = &*finer;
  }
  std::vector<CellData<std::uint8_t>> inside(1);
  inside[0] = CellData<std::uint8_t>(document.solid().cell_capacity(), 0);
  for (const std::uint32_t c : cells) inside[0][CellId{c}] = 1;
  for (std::size_t level = 1; level <= finest; ++level) {
    const Solid& solid = refinement->levels[level];
    CellData<std::uint8_t>& next = inside.emplace_back(solid.cell_capacity(), std::uint8_t{0});
    for (const CellId c : solid.cells()) next[c] = inside[level - 1][refinement->parent[level][c]];
  }
  std::vector<std::vector<std::uint8_t>> result;
  for (const fem::ElementBlock& block : d.blocks) {
    auto& marks = result.emplace_back();
    for (const fem::ElementOrigin& origin : block.origins)
      marks.push_back(inside[origin.level][CellId{origin.cell}]);
  }
  return result;
}

Eigen::Matrix3Xd forces_of(const Document& document, const AppliedForce& applied, const Eigen::Vector3d& force) {
  const fem::Discretization& d = document.discretization();
  if (!applied.cells.empty()) return fem::body_forces(d, elements_in(document, applied.cells), force);
  if (applied.faces.empty())
    return fem::point_forces(material_point(document, applied.point).stencil, d.nodes.rows.column_count, force);
  const auto faces = finest_faces(document.refinement(), applied.faces);
  return fem::spread_force(d, fem::surface_patch(d, document.refinement().solid(), faces), d.rest_nodes, force);
}

bool holds(const Selection& members, std::uint32_t id) {
  return std::binary_search(members.ids.begin(), members.ids.end(), id);
}

}  // namespace

DocumentLoads document_loads(const Document& document) {
  const fem::Discretization& d = document.discretization();
  const AppliedLoads& applied = *document.state().loads;
  const Pins& pins = *document.state().pins;
  const Eigen::Vector3d one(1, 0, 0);
  DocumentLoads result;
  fem::Loads& loads = result.lasting_;
  loads.forces = fem::gravity_forces(d, applied.gravity_track.empty() ? applied.gravity : Eigen::Vector3d(0, 0, 0));
  if (!applied.gravity_track.empty())
    result.keyed_.push_back({applied.gravity_track, fem::gravity_forces(d, one).row(0).transpose()});
  for (const AppliedForce& force : applied.forces) {
    if (force.track.empty())
      loads.forces += forces_of(document, force, force.force);
    else
      result.keyed_.push_back({force.track, forces_of(document, force, one).row(0).transpose()});
  }
  for (const AppliedPressure& pressure : applied.pressures)
    result.pressures_.push_back(
        {pressure, fem::surface_patch(d, document.refinement().solid(),
                                      finest_faces(document.refinement(), pressure.faces))});
  result.motions_ = pins.motions;
  for (const SoftPin& pin : pins.nodes) {
    const StencilRow row = d.nodes.rows.row(d.surface_node_from_vertex[pin.node]);
    fem::AnchorSpring spring;
    spring.control_points.assign(row.columns.begin(), row.columns.end());
    spring.weights.assign(row.weights.begin(), row.weights.end());
    spring.target = pin.target;
    spring.stiffness = pin.stiffness;
    if (const PinMotion* motion = motion_of(pins, ElementType::nodes, pin.node))
      result.led_.push_back({loads.springs.size(), static_cast<std::size_t>(motion - pins.motions.data())});
    loads.springs.push_back(std::move(spring));
  }
  return result;
}

fem::Loads DocumentLoads::at(double time, const fem::Discretization& discretization,
                             const Eigen::Matrix3Xd& control_points) const {
  fem::Loads loads = lasting_;
  for (const KeyedForce& keyed : keyed_) {
    const Eigen::Vector3d value = value_at(keyed.track, time);
    for (Eigen::Index i = 0; i < loads.forces.cols(); ++i) loads.forces.col(i) += keyed.weights[i] * value;
  }
  if (!pressures_.empty()) {
    const Eigen::Matrix3Xd nodes = subdiv::apply(discretization.nodes.rows, control_points);
    for (const Pressure& pressure : pressures_)
      loads.forces +=
          fem::pressure_forces(discretization, pressure.patch, nodes, pressure_at(pressure.applied, time));
  }
  for (const LedSpring& led : led_) {
    fem::AnchorSpring& spring = loads.springs[led.spring];
    spring.target = led_target(motions_[led.motion], spring.target, time);
  }
  return loads;
}

fem::LedPoints led_points(const Pins& pins, const fem::BodyState& motion, double time) {
  fem::LedPoints led;
  led.time = time;
  std::vector<std::pair<std::uint32_t, std::size_t>> points;
  for (std::size_t m = 0; m < pins.motions.size(); ++m) {
    if (pins.motions[m].members.type != ElementType::vertices) continue;
    for (const std::uint32_t v : pins.motions[m].members.ids)
      if (std::binary_search(pins.control_points.begin(), pins.control_points.end(), v)) points.emplace_back(v, m);
  }
  std::sort(points.begin(), points.end());
  std::vector<RigidMotion> moves;
  for (const PinMotion& of : pins.motions)
    moves.push_back(motion_at(of.track, of.pivot, time) * motion_at(of.track, of.pivot, motion.time).inverse());
  led.positions.resize(3, static_cast<Eigen::Index>(points.size()));
  led.velocities.resize(3, led.positions.cols());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [v, m] = points[i];
    const PinMotion& of = pins.motions[m];
    const auto column = static_cast<Eigen::Index>(i);
    led.control_points.push_back(v);
    led.positions.col(column) = moves[m] * Eigen::Vector3d(motion.positions.col(v));
    led.velocities.col(column) = velocity_at(of.track, of.pivot, time, led.positions.col(column));
  }
  return led;
}

Eigen::Vector3d led_target(const PinMotion& motion, const Eigen::Vector3d& target, double time) {
  return motion_at(motion.track, motion.pivot, time) *
         (motion_at(motion.track, motion.pivot, motion.since).inverse() * target);
}

Eigen::Vector3d target_before(const PinMotion& motion, const Eigen::Vector3d& led, double time) {
  return motion_at(motion.track, motion.pivot, motion.since) *
         (motion_at(motion.track, motion.pivot, time).inverse() * led);
}

const PinMotion* motion_of(const Pins& pins, ElementType type, std::uint32_t id) {
  for (const PinMotion& motion : pins.motions)
    if (motion.members.type == type && holds(motion.members, id)) return &motion;
  return nullptr;
}

Eigen::Vector3d force_at(const AppliedForce& force, double time) {
  return force.track.empty() ? force.force : Eigen::Vector3d(value_at(force.track, time));
}

Eigen::Vector3d gravity_at(const AppliedLoads& loads, double time) {
  return loads.gravity_track.empty() ? loads.gravity : Eigen::Vector3d(value_at(loads.gravity_track, time));
}

double pressure_at(const AppliedPressure& pressure, double time) {
  return pressure.track.empty() ? pressure.pressure : value_at(pressure.track, time)[0];
}

double prestress_share_at(const AppliedLoads& loads, double time) {
  return loads.prestress_track.empty() ? 1 : value_at(loads.prestress_track, time)[0];
}

fem::Falloff falloff_by_word(const std::string& word) {
  if (word == "constant") return fem::Falloff::constant;
  return word == "linear" ? fem::Falloff::linear : fem::Falloff::smooth;
}

double falloff_weight(fem::Falloff falloff, double s) {
  if (s >= 1) return 0;
  switch (falloff) {
    case fem::Falloff::constant:
      return 1;
    case fem::Falloff::linear:
      return 1 - s;
    case fem::Falloff::smooth:
      return (1 - s * s) * (1 - s * s);
  }
  return 0;
}

}  // namespace argil::sculpt
