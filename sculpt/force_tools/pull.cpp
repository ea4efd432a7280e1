#include "sculpt/force_tools/pull.h"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "sculpt/document_loads.h"
#include "subdiv/error.h"
#include "subdiv/query/surface_tree.h"

namespace argil::sculpt {

namespace {

// Each quadrilateral as four triangles about its middle.
double distance_to_surface(const fem::SurfacePatch& patch, const Eigen::Matrix3Xd& nodes,
                           const Eigen::Vector3d& p) {
  Eigen::Matrix3Xd points(3, nodes.cols() + static_cast<Eigen::Index>(patch.quads.size()));
  points.leftCols(nodes.cols()) = nodes;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::size_t q = 0; q < patch.quads.size(); ++q) {
    const auto& quad = patch.quads[q];
    const auto middle = static_cast<std::uint32_t>(static_cast<std::size_t>(nodes.cols()) + q);
    points.col(middle) = (nodes.col(quad[0]) + nodes.col(quad[1]) + nodes.col(quad[2]) + nodes.col(quad[3])) / 4;
    for (std::size_t i = 0; i < 4; ++i) triangles.push_back({quad[i], quad[(i + 1) % 4], middle});
  }
  return (subdiv::SurfaceTree(points, triangles).nearest(p) - p).norm();
}

}  // namespace

PullGrip::PullGrip(const Document& document, const Tool& tool, const Eigen::Vector3d& at,
                   const GripOptions& options)
    : at_(at), largest_force_(tool.largest_force), invert_(options.invert) {
  const fem::Discretization& d = document.discretization();
  const Eigen::Matrix3Xd nodes = subdiv::apply(d.nodes.rows, document.positions());
  const fem::SurfacePatch surface = fem::whole_surface(d, document.refinement().solid());
  // A brush finer than the mesh is widened until it holds something, so what it touches is asked of the surface
  // itself.
  const double away = distance_to_surface(surface, nodes, at);
  if (away > tool.radius)
    throw Error(
        ErrorCode::bad_input,
        fmt::format(
            "the tool touches nothing at ({:g}, {:g}, {:g}): the surface is {:.3g} m away and its radius is "
            "{:g} m; begin the stroke on the surface or make the radius larger",
            at.x(), at.y(), at.z(), away, tool.radius));
  const fem::Brush brush{at, tool.radius, falloff_by_word(tool.falloff)};
  grip_ = fem::anchor_spring(fem::brush_stencil(d, surface, nodes, brush), at, tool.strength);
  offset_ = held(document.positions()) - at;
}

Eigen::Vector3d PullGrip::held(const Eigen::Matrix3Xd& positions) const {
  return fem::held_point(grip_, positions);
}

fem::AnchorSpring PullGrip::spring(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const {
  fem::AnchorSpring spring = grip_;
  const Eigen::Vector3d from = held(positions);
  const Eigen::Vector3d device = invert_ ? Eigen::Vector3d(2 * at_ - pose.position) : pose.position;
  Eigen::Vector3d stretch = pose.pressure * (device + offset_ - from);
  const double longest = largest_force_ / grip_.stiffness;
  if (stretch.norm() > longest) stretch *= longest / stretch.norm();
  spring.target = from + stretch;
  return spring;
}

fem::Loads PullGrip::loads(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const {
  fem::Loads loads;
  loads.springs.push_back(spring(pose, positions));
  return loads;
}

Eigen::Vector3d PullGrip::force(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const {
  const fem::AnchorSpring now = spring(pose, positions);
  return now.stiffness * (now.target - held(positions));
}

}  // namespace argil::sculpt
