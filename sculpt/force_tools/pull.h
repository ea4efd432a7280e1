#pragma once
// Pull and push: a spring from the device to the points that it touched (papers/004 §4.1). The touched points are
// the boundary within a radius of where the device took hold (inside the solid, what is there), weighted by falloff
// and area, so that the force is spread over them by virtual work and never acts on one vertex.

#include "sculpt/force_tools/force_tool.h"

namespace argil::sculpt {

class PullGrip : public ForceTool {
 public:
  /// Takes hold of the present surface around `at` [m]. Inverted, the device's way counts backwards: drawn outwards
  /// it pushes. @throws Error (bad_input) if nothing is within the radius.
  PullGrip(const Document& document, const Tool& tool, const Eigen::Vector3d& at, const GripOptions& options = {});

  fem::Loads loads(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const override;
  Eigen::Vector3d held(const Eigen::Matrix3Xd& positions) const override;
  Eigen::Vector3d force(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const override;
  double stiffness() const override { return grip_.stiffness; }

  /// The spring, cut to the largest force.
  [[nodiscard]] fem::AnchorSpring spring(const StrokePose& pose, const Eigen::Matrix3Xd& positions) const;

 private:
  fem::AnchorSpring grip_;
  Eigen::Vector3d at_, offset_;  // held point from device position when hold was taken: no jerk at the start
  double largest_force_;
  bool invert_;
};

}  // namespace argil::sculpt
