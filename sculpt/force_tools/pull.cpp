#include "sculpt/force_tools/pull.h"

#include "sculpt/document_loads.h"
#include "sculpt/force_tools/touched.h"

namespace argil::sculpt {

PullGrip::PullGrip(const Document& document, const Tool& tool, const Eigen::Vector3d& at,
                   const GripOptions& options)
    : at_(at), largest_force_(tool.largest_force), invert_(options.invert) {
  const std::vector<Eigen::Vector3d> surface = nearest_on_surface(document, {&at, 1});
  if (options.inside || (surface[0] - at).norm() > tool.radius || has_mask(document)) {
    const Touched held = touch(document, tool, at, options.inside);
    grip_ = fem::anchor_spring(middle_of(held), at, held.share * tool.strength);
  } else {
    const fem::Discretization& d = document.discretization();
    const fem::Brush brush{at, tool.radius, falloff_by_word(tool.falloff)};
    grip_ = fem::anchor_spring(fem::brush_stencil(d, fem::whole_surface(d, document.refinement().solid()),
                                                  subdiv::apply(d.nodes.rows, document.positions()), brush),
                               at, tool.strength);
  }
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
