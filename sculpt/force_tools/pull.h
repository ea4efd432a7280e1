#pragma once
// Pull and push: a spring from the device to the points that it touched (papers/004 §4.1). The touched points are
// the boundary within a radius of where the device took hold, weighted by falloff and area, so that the force is
// spread over them by virtual work and never acts on one vertex.

#include "fem/system.h"
#include "sculpt/document.h"

namespace argil::sculpt {

class PullGrip {
 public:
  /// Takes hold of the present surface around `at` [m]. @throws Error (bad_input) if nothing is within the radius.
  PullGrip(const Document& document, const Tool& tool, const Eigen::Vector3d& at);

  /// The spring with the device at `device` [m] and the body at these control points; cut to the largest force.
  [[nodiscard]] fem::AnchorSpring spring(const Eigen::Vector3d& device, const Eigen::Matrix3Xd& positions) const;
  /// The force on the body [N].
  [[nodiscard]] Eigen::Vector3d force(const Eigen::Vector3d& device, const Eigen::Matrix3Xd& positions) const;
  [[nodiscard]] Eigen::Vector3d held(const Eigen::Matrix3Xd& positions) const;
  double stiffness() const { return grip_.stiffness; }

 private:
  fem::AnchorSpring grip_;
  Eigen::Vector3d offset_;  // held point from device position when hold was taken: no jerk at the start
  double largest_force_;
};

}  // namespace argil::sculpt
