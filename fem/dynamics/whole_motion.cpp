#include "fem/dynamics/whole_motion.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "fem/contact/contact.h"

namespace argil::fem {

namespace {

double sum_of(const Eigen::SparseMatrix<double>* matrix) {
  double sum = 0;
  if (!matrix) return sum;
  for (Eigen::Index c = 0; c < matrix->outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator it(*matrix, c); it; ++it) sum += it.value();
  return sum;
}

Eigen::Vector3d momentum(const System& system, const Eigen::Matrix3Xd& velocities) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index c = 0; c < system.mass->outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator it(*system.mass, c); it; ++it)
      sum += it.value() * velocities.col(c);
  return sum;
}

}  // namespace

bool moves_as_a_whole(const System& system) {
  return std::find(system.fixed.begin(), system.fixed.end(), std::uint8_t{1}) == system.fixed.end();
}

void step_as_a_whole(const System& system, const Loads& loads, BodyState& state, double time_step) {
  const double h = time_step;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < loads.forces.cols(); ++i) force += loads.forces.col(i);
  double stiffness = 0;
  for (const AnchorSpring& spring : loads.springs) {
    // Weights sum to 1, or to 0 where a spring acts between parts of the body.
    if (std::abs(std::accumulate(spring.weights.begin(), spring.weights.end(), 0.0)) < 0.5) continue;
    force += spring.stiffness * (spring.target - held_point(spring, state.positions));
    stiffness += spring.stiffness;
  }
  std::vector<ContactGrip> grips;
  if (loads.contact) {
    ContactStep contact(*loads.contact, state, state.time + h);
    contact.set_state(state.positions);
    for (const Touch& touch : contact.touches()) {
      force += touch.force();
      stiffness += touch.stiffness;
    }
    grips = contact.grips();
  }
  const double inertia = sum_of(system.mass) + h * sum_of(system.damping) + h * h * stiffness;
  const Eigen::Vector3d velocity = (momentum(system, state.velocities) + h * force) / inertia;
  BodyState next;
  next.positions = state.positions.colwise() + h * velocity;
  next.velocities = velocity.replicate(1, state.positions.cols());
  next.time = state.time + h;
  next.grips = std::move(grips);
  state = std::move(next);
}

}  // namespace argil::fem
