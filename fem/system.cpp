#include "fem/system.h"

#include <cassert>

#include "fem/solvers/stencil_product.h"

namespace argil::fem {

Eigen::Matrix3Xd nodes(const System& system, const Eigen::Matrix3Xd& positions) {
  Eigen::Matrix3Xd result;
  multiply(*system.rows, positions, result);
  return result;
}

Eigen::Matrix3Xd generalised_forces(const System& system, const Eigen::Matrix3Xd& node_forces) {
  Eigen::Matrix3Xd result;
  multiply(*system.rows_transposed, node_forces, result);
  return result;
}

Eigen::Vector3d held_point(const AnchorSpring& spring, const Eigen::Matrix3Xd& positions) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (std::size_t e = 0; e < spring.control_points.size(); ++e)
    point += spring.weights[e] * positions.col(static_cast<Eigen::Index>(spring.control_points[e]));
  return point;
}

void add_spring_forces(const std::vector<AnchorSpring>& springs, const Eigen::Matrix3Xd& positions,
                       Eigen::Matrix3Xd& forces) {
  for (const AnchorSpring& spring : springs) {
    const Eigen::Vector3d force = spring.stiffness * (spring.target - held_point(spring, positions));
    for (std::size_t e = 0; e < spring.control_points.size(); ++e)
      forces.col(static_cast<Eigen::Index>(spring.control_points[e])) += spring.weights[e] * force;
  }
}

Eigen::Matrix3Xd reactions(const System& system, const Loads& loads, const Eigen::Matrix3Xd& positions) {
  Eigen::Matrix3Xd node_forces;
  system.model->forces(nodes(system, positions), node_forces);
  Eigen::Matrix3Xd result = generalised_forces(system, node_forces);
  if (loads.forces.cols() > 0) result += loads.forces;
  add_spring_forces(loads.springs, positions, result);
  for (Eigen::Index i = 0; i < result.cols(); ++i) {
    if (system.fixed[static_cast<std::size_t>(i)])
      result.col(i) *= -1.0;
    else
      result.col(i).setZero();
  }
  return result;
}

double potential_energy(const System& system, const Loads& loads, const Eigen::Matrix3Xd& positions) {
  double energy = system.model->energy(nodes(system, positions));
  for (const AnchorSpring& spring : loads.springs)
    energy += 0.5 * spring.stiffness * (held_point(spring, positions) - spring.target).squaredNorm();
  return energy;
}

}  // namespace argil::fem
