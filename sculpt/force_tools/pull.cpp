#include "sculpt/force_tools/pull.h"

#include <fmt/format.h>

#include "sculpt/document_loads.h"
#include "subdiv/error.h"

namespace argil::sculpt {

PullGrip::PullGrip(const Document& document, const Tool& tool, const Eigen::Vector3d& at)
    : largest_force_(tool.largest_force) {
  const fem::Discretization& d = document.discretization();
  const Eigen::Matrix3Xd nodes = subdiv::apply(d.nodes.rows, document.positions());
  const fem::Brush brush{at, tool.radius, falloff_by_word(tool.falloff)};
  const fem::PointStencil touched =
      fem::brush_stencil(d, fem::whole_surface(d, document.refinement().solid()), nodes, brush);
  grip_ = fem::anchor_spring(touched, at, tool.strength);
  // The brush is widened where it is finer than the mesh; far from the surface it touches nothing.
  if ((held(document.positions()) - at).norm() > 2 * tool.radius)
    throw Error(
        ErrorCode::bad_input,
        fmt::format(
            "the tool touches nothing at ({:g}, {:g}, {:g}): the surface is {:.3g} m away and its radius is "
            "{:g} m; begin the stroke on the surface or make the radius larger",
            at.x(), at.y(), at.z(), (held(document.positions()) - at).norm(), tool.radius));
  offset_ = held(document.positions()) - at;
}

Eigen::Vector3d PullGrip::held(const Eigen::Matrix3Xd& positions) const {
  return fem::held_point(grip_, positions);
}

fem::AnchorSpring PullGrip::spring(const Eigen::Vector3d& device, const Eigen::Matrix3Xd& positions) const {
  fem::AnchorSpring spring = grip_;
  const Eigen::Vector3d from = held(positions);
  Eigen::Vector3d stretch = device + offset_ - from;
  const double longest = largest_force_ / grip_.stiffness;
  if (stretch.norm() > longest) stretch *= longest / stretch.norm();
  spring.target = from + stretch;
  return spring;
}

Eigen::Vector3d PullGrip::force(const Eigen::Vector3d& device, const Eigen::Matrix3Xd& positions) const {
  const fem::AnchorSpring now = spring(device, positions);
  return now.stiffness * (now.target - held(positions));
}

}  // namespace argil::sculpt
