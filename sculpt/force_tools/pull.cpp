#include "sculpt/force_tools/pull.h"

#include "fem/loads.h"

namespace argil::sculpt {

PullGrip::PullGrip(const Document& document, const Tool& tool, const Eigen::Vector3d& at)
    : grip_(grip_on_surface(document, at, tool.radius, fem::falloff_by_word(tool.falloff))), largest_force_(tool.largest_force) {
  grip_.stiffness = tool.strength;
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
