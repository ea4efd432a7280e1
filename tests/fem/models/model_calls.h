#pragma once
// What tests ask of a force model, as values.

#include "fem/models/force_model.h"

namespace argil::fem::test {

inline Eigen::Matrix3Xd forces_at(const ForceModel& model, const Eigen::Matrix3Xd& x) {
  Eigen::Matrix3Xd result;
  model.forces(x, result);
  return result;
}
inline Eigen::Matrix3Xd product_at(const Tangent& tangent, const Eigen::Matrix3Xd& dx) {
  Eigen::Matrix3Xd result;
  tangent.stiffness_product(dx, result);
  return result;
}
inline double largest(const Eigen::Matrix3Xd& m) {
  return m.cwiseAbs().maxCoeff();
}

}  // namespace argil::fem::test
