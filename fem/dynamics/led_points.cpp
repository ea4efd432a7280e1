#include "fem/dynamics/led_points.h"

#include <cassert>

#include "fem/contact/contact.h"

namespace argil::fem {

namespace {

constexpr double k_same_end = 1e-6;  // of the step: its end is that of the way

Eigen::Index column_of(const LedPoints& led, std::size_t i) {
  return static_cast<Eigen::Index>(led.control_points[i]);
}

/// What leads a point must overcome there: the body's own force and the loads.
Eigen::Matrix3Xd forces_on(const System& system, const Loads& loads, const Eigen::Matrix3Xd& positions) {
  Eigen::Matrix3Xd node_forces;
  system.model->forces(nodes(system, positions), node_forces);
  Eigen::Matrix3Xd forces = generalised_forces(system, node_forces);
  if (loads.forces.cols() > 0) forces += loads.forces;
  add_spring_forces(loads.springs, positions, forces);
  return forces;
}

}  // namespace

LedStep led_step(const LedPoints& led, const BodyState& state, double time_step) {
  const double left = led.time - state.time;
  const bool arrives = left <= time_step * (1 + k_same_end);
  LedStep step{led.positions, led.velocities, led.velocities};
  for (std::size_t i = 0; i < led.control_points.size(); ++i) {
    const auto c = static_cast<Eigen::Index>(i);
    const Eigen::Vector3d from = state.positions.col(column_of(led, i));
    if (!arrives) {
      step.velocities.col(c) = (led.positions.col(c) - from) / left;
      step.positions.col(c) = from + time_step * step.velocities.col(c);
    }
    step.accelerations.col(c) = (step.velocities.col(c) - state.velocities.col(column_of(led, i))) / time_step;
  }
  return step;
}

Eigen::Matrix3Xd led_columns(const LedPoints& led, const Eigen::Matrix3Xd& values) {
  Eigen::Matrix3Xd columns(3, static_cast<Eigen::Index>(led.control_points.size()));
  for (std::size_t i = 0; i < led.control_points.size(); ++i)
    columns.col(static_cast<Eigen::Index>(i)) = values.col(column_of(led, i));
  return columns;
}

void set_led_columns(const LedPoints& led, const Eigen::Matrix3Xd& columns, Eigen::Matrix3Xd& values) {
  assert(columns.cols() == static_cast<Eigen::Index>(led.control_points.size()));
  for (std::size_t i = 0; i < led.control_points.size(); ++i)
    values.col(column_of(led, i)) = columns.col(static_cast<Eigen::Index>(i));
}

double led_work(const System& system, const Loads& loads, const BodyState& from, const BodyState& to) {
  const LedPoints& led = loads.led;
  const double length = to.time - from.time;
  if (led.control_points.empty() || !(length > 0)) return 0;
  const Eigen::Matrix3Xd before = forces_on(system, loads, from.positions);
  const Eigen::Matrix3Xd after = forces_on(system, loads, to.positions);
  const Eigen::Matrix3Xd inertia = ((to.velocities - from.velocities) / length) * *system.mass;
  Eigen::Matrix3Xd touching = Eigen::Matrix3Xd::Zero(3, to.positions.cols());
  if (loads.contact) touching = contact_forces(*loads.contact, to);
  double sum = 0;
  for (std::size_t i = 0; i < led.control_points.size(); ++i) {
    const Eigen::Index c = column_of(led, i);
    const Eigen::Vector3d force = inertia.col(c) - 0.5 * (before.col(c) + after.col(c)) - touching.col(c);
    sum += force.dot(to.positions.col(c) - from.positions.col(c));
  }
  return sum;
}

}  // namespace argil::fem
