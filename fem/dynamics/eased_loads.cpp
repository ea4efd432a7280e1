#include "fem/dynamics/eased_loads.h"

#include "fem/contact/contact.h"

namespace argil::fem {

Loads eased(const System& system, const Loads& loads, const BodyState& state, double share) {
  const Eigen::Matrix3Xd& positions = state.positions;
  Eigen::Matrix3Xd node_forces;
  system.model->forces(nodes(system, positions), node_forces);
  Eigen::Matrix3Xd unbalanced = generalised_forces(system, node_forces);
  if (loads.forces.cols() > 0) unbalanced += loads.forces;
  add_spring_forces(loads.springs, positions, unbalanced);
  if (loads.contact) unbalanced += contact_forces(*loads.contact, state);
  Loads result = loads;
  if (result.forces.cols() == 0) result.forces.setZero(3, positions.cols());
  result.forces -= (1 - share) * unbalanced;
  return result;
}

LoadSize size_of(const Loads& loads, const BodyState& state) {
  LoadSize result;
  for (Eigen::Index i = 0; i < loads.forces.cols(); ++i) result.dead += loads.forces.col(i).norm();
  for (const AnchorSpring& spring : loads.springs)
    result.pull += spring.stiffness * (spring.target - held_point(spring, state.positions)).norm();
  if (loads.contact) {
    const Eigen::Matrix3Xd forces = contact_forces(*loads.contact, state);
    for (Eigen::Index i = 0; i < forces.cols(); ++i) result.pull += forces.col(i).norm();
  }
  return result;
}

}  // namespace argil::fem
