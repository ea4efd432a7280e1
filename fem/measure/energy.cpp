#include "fem/measure/energy.h"

#include <Eigen/Geometry>

namespace argil::fem {

namespace {

Eigen::Matrix3Xd momenta(const System& system, const BodyState& state) {
  return state.velocities * *system.mass;
}

}  // namespace

Energy energy(const System& system, const BodyState& state) {
  return {0.5 * momenta(system, state).cwiseProduct(state.velocities).sum(),
          system.model->energy(nodes(system, state.positions))};
}

Momentum momentum(const System& system, const BodyState& state) {
  const Eigen::Matrix3Xd each = momenta(system, state);
  Momentum result;
  for (Eigen::Index i = 0; i < each.cols(); ++i) {
    result.linear += each.col(i);
    result.angular += state.positions.col(i).cross(each.col(i));
  }
  return result;
}

}  // namespace argil::fem
