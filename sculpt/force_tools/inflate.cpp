#include <Eigen/Geometry>
#include <Eigen/LU>

#include "fem/surface_points.h"
#include "sculpt/force_tools/tool_table.h"
#include "sculpt/force_tools/touched.h"

namespace argil::sculpt {

namespace {

/// Forces on nodes, as far as they are not zero.
struct NodeForces {
  explicit NodeForces(const fem::Discretization& discretization)
      : rows(discretization.nodes.rows),
        on_control_points(Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(rows.column_count))) {}
  void add(std::uint32_t node, const Eigen::Vector3d& force) {
    const auto row = rows.row(node);
    for (std::size_t e = 0; e < row.columns.size(); ++e)
      on_control_points.col(static_cast<Eigen::Index>(row.columns[e])) += row.weights[e] * force;
  }
  const subdiv::Stencils& rows;
  Eigen::Matrix3Xd on_control_points;
};

/// ∂volume/∂F of the unit cell: the cofactors, which keep their meaning where the cell is flat or inside out.
Eigen::Matrix3d cofactors(const Eigen::Matrix3d& f) {
  Eigen::Matrix3d result;
  result.col(0) = f.col(1).cross(f.col(2));
  result.col(1) = f.col(2).cross(f.col(0));
  result.col(2) = f.col(0).cross(f.col(1));
  return result;
}

class Inflate : public ForceTool {
 public:
  Inflate(const Document& document, const Tool& tool, const StrokePose& first, const GripOptions& options)
      : document_(document), tool_(tool), options_(options), held_{first.position} {
    hold(touch(document, tool, first.position, options.inside));
  }

  void follow(const StrokePose& pose, const Document& document) override {
    if (!wants_new_hold(tool_, held_, pose)) return;
    held_ = pose;
    const LaidTool laid = laid_tool(document, tool_, held_, options_.inside);
    hold(touched(document, laid.tool, laid.at, options_.inside));
  }

  fem::Loads loads(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const override {
    if (touched_.empty()) return {};
    const fem::Discretization& d = document_.discretization();
    const Eigen::Matrix3Xd nodes = subdiv::apply(d.nodes.rows, positions);
    const double pressure = (options_.invert ? -1 : 1) * pose.pressure * tool_.strength / tool_.radius;
    NodeForces forces(d);
    const double sizes =
        touched_.inside ? press_inside(d, nodes, pressure, forces) : press(nodes, pressure, forces);
    fem::Loads loads;
    loads.forces = std::move(forces.on_control_points);
    if (sizes > tool_.largest_force) loads.forces *= tool_.largest_force / sizes;
    return loads;
  }

  Eigen::Vector3d held(const Eigen::Matrix3Xd& positions) const override {
    return touched_.empty() ? held_.position : fem::position(middle_, positions);
  }

 private:
  void hold(Touched touched) {
    touched_ = std::move(touched);
    if (!touched_.empty()) middle_ = middle_of(touched_);
  }

  // Both return the sum of the sizes of the forces at the points.
  double press(const Eigen::Matrix3Xd& nodes, double pressure, NodeForces& forces) const {
    double sizes = 0;
    for (std::size_t i = 0; i < touched_.places.size(); ++i) {
      const TouchedPlace& place = touched_.places[i];
      const fem::SurfacePoint point = fem::surface_point(place.quad, place.which, nodes);
      const Eigen::Vector3d force = pressure * touched_.falloffs[static_cast<Eigen::Index>(i)] * point.area_vector;
      sizes += force.norm();
      for (std::size_t c = 0; c < 4; ++c) forces.add(place.quad[c], point.shapes[c] * force);
    }
    return sizes;
  }

  // The stress does work on every change of volume: σ dV = σ cof(F) : dF.
  double press_inside(const fem::Discretization& d, const Eigen::Matrix3Xd& nodes, double pressure,
                      NodeForces& forces) const {
    double sizes = 0;
    for (std::size_t i = 0; i < touched_.places.size(); ++i) {
      const TouchedPlace& place = touched_.places[i];
      const fem::ElementBlock& block = d.blocks[place.block];
      const auto n = static_cast<std::size_t>(block.kind->node_count);
      const std::uint32_t* const names = block.nodes.data() + place.element * n;
      const double* const gradients = block.kind->gradients.data() + static_cast<std::size_t>(place.which) * n * 3;
      const std::size_t point = block.point_index(place.element, place.which);
      Eigen::Matrix3d along = Eigen::Matrix3d::Zero();  // ∂x/∂(u, v, w)
      for (std::size_t a = 0; a < n; ++a)
        for (int axis = 0; axis < 3; ++axis)
          along.col(axis) += gradients[3 * a + static_cast<std::size_t>(axis)] * nodes.col(names[a]);
      const Eigen::Matrix3d to_rest = block.inverse_rest_jacobians[point];
      const double stress = pressure * touched_.falloffs[static_cast<Eigen::Index>(i)] * block.volumes[point];
      const Eigen::Matrix3d flux = stress * cofactors(along * to_rest) * to_rest.transpose();
      for (std::size_t a = 0; a < n; ++a) {
        const Eigen::Vector3d force =
            flux * Eigen::Vector3d(gradients[3 * a], gradients[3 * a + 1], gradients[3 * a + 2]);
        sizes += force.norm();
        forces.add(names[a], force);
      }
    }
    return sizes;
  }

  const Document& document_;
  Tool tool_;
  GripOptions options_;
  StrokePose held_;  // where it took hold
  Touched touched_;
  fem::PointStencil middle_;
};

}  // namespace

std::unique_ptr<ForceTool> take_inflate(const Document& document, const Tool& tool, const StrokePose& first,
                                        const GripOptions& options) {
  return std::make_unique<Inflate>(document, tool, first, options);
}

}  // namespace argil::sculpt
