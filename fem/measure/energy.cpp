#include "fem/measure/energy.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>

namespace argil::fem {

namespace {

Eigen::Matrix3Xd momenta(const System& system, const BodyState& state) {
  return state.velocities * *system.mass;
}

void add(Wrench& sum, const Eigen::Vector3d& at, const Eigen::Vector3d& force) {
  sum.force += force;
  sum.moment += at.cross(force);
}

double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}

}  // namespace

Energy energy(const System& system, const BodyState& state) {
  const Eigen::Matrix3Xd each = momenta(system, state);
  double twice = 0;
  for (Eigen::Index i = 0; i < each.cols(); ++i) twice += dot(each.col(i), state.velocities.col(i));
  return {0.5 * twice, system.model->energy(nodes(system, state.positions))};
}

double spring_energy(std::span<const AnchorSpring> springs, const Eigen::Matrix3Xd& positions) {
  double energy = 0;
  for (const AnchorSpring& spring : springs) {
    const Eigen::Vector3d stretch = held_point(spring, positions) - spring.target;
    energy += 0.5 * spring.stiffness * dot(stretch, stretch);
  }
  return energy;
}

double load_potential(const Loads& loads, const Eigen::Matrix3Xd& rest, const Eigen::Matrix3Xd& positions) {
  double potential = 0;
  for (Eigen::Index i = 0; i < loads.forces.cols(); ++i)
    potential -= dot(loads.forces.col(i), positions.col(i) - rest.col(i));
  return potential;
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

Wrench wrench(const Eigen::Matrix3Xd& forces, const Eigen::Matrix3Xd& positions) {
  Wrench sum;
  for (Eigen::Index i = 0; i < forces.cols(); ++i) add(sum, positions.col(i), forces.col(i));
  return sum;
}

Wrench wrench(const Eigen::Matrix3Xd& forces, const Eigen::Matrix3Xd& positions,
              std::span<const std::uint32_t> chosen) {
  Wrench sum;
  for (const std::uint32_t i : chosen) add(sum, positions.col(i), forces.col(i));
  return sum;
}

Wrench wrench(std::span<const AnchorSpring> springs, const Eigen::Matrix3Xd& positions) {
  Wrench sum;
  for (const AnchorSpring& spring : springs) {
    const Eigen::Vector3d at = held_point(spring, positions);
    const Eigen::Vector3d force = spring.stiffness * (spring.target - at);
    add(sum, at, force);
    // Weights sum to 1, or to 0 where a spring acts between parts of the body: then it has a moment at most.
    if (std::abs(std::accumulate(spring.weights.begin(), spring.weights.end(), 0.0)) < 0.5) sum.force -= force;
  }
  return sum;
}

}  // namespace argil::fem
