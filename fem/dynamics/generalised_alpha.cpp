// Generalised-α (Chung and Hulbert 1993): the balance of forces at a point between the ends of the step, M a there
// at 1 − αₘ of it and the rest at 1 − α_f, with Newmark's update. Written as a minimisation for the configuration
// q = (1 − α_f) p₊ + α_f p, since the stiffness is asked there alone.

#include <fmt/format.h>

#include <algorithm>

#include "fem/dynamics/integrator_body.h"
#include "fem/dynamics/led_points.h"
#include "subdiv/error.h"

namespace argil::fem {

StepReport Integrator::Impl::generalised_alpha_step(const Loads& loads, BodyState& state, double h,
                                                    const StepOptions& options, Clock clock) {
  const double radius = options.spectral_radius;
  if (!(radius >= 0 && radius <= 1))
    throw Error(ErrorCode::bad_input,
                fmt::format("The spectral radius of generalised-α lies between 0 and 1; {} was given.", radius));
  const double alpha_m = (2 * radius - 1) / (radius + 1), alpha_f = radius / (radius + 1);
  const double gamma = 0.5 - alpha_m + alpha_f, beta = 0.25 * (1 - alpha_m + alpha_f) * (1 - alpha_m + alpha_f);
  const Divisors divisors{(1 - alpha_f) * beta * h * h / (1 - alpha_m), beta * h / gamma};

  const double start = clock ? clock() : 0;
  prepare(divisors, loads.springs, options.progress.part(0, 0.3));
  StepReport report;
  if (clock) report.ms_tangent += 1e3 * (clock() - start);

  const LedStep led = led_step(loads.led, state, h);
  Eigen::Matrix3Xd velocities = state.velocities, accelerations = state.accelerations;
  clear_held(free, velocities);
  set_led_columns(loads.led, led_columns(loads.led, state.velocities), velocities);
  if (accelerations.cols() != size())
    accelerations = factored_mass(0).solve(
        with_mass_damping(forces(loads, state, state.time, state.positions, velocities), velocities));
  const Eigen::Matrix3Xd led_accelerations = led_columns(loads.led, accelerations);
  clear_held(free, accelerations);
  set_led_columns(loads.led, led_accelerations, accelerations);

  Potential goal = potential(loads.springs);
  std::optional<ContactStep> contact = contact_step(loads, state, state.time + (1 - alpha_f) * h);
  goal.contact = contact ? &*contact : nullptr;
  goal.columns = &columns;
  goal.anchor = state.positions + (1 - alpha_f) * (h * velocities + h * h * (0.5 - beta) * accelerations);
  // The velocity at the point of balance, were its acceleration all of the past.
  const Eigen::Matrix3Xd past = velocities + (1 - alpha_f) * h * (1 - gamma) * accelerations;
  goal.constant_force = load_forces(loads) - (alpha_m * accelerations) * *system.mass;
  goal.constant_force += velocity_forces(state);
  goal.constant_force = with_mass_damping(std::move(goal.constant_force), past);
  set_viscosity(goal, state.positions + (1 - alpha_f) * h * velocities, divisors.damping);
  if (goal.viscous) goal.constant_force -= viscous_product(past);

  Eigen::Matrix3Xd q = state.positions + (1 - alpha_f) * h * velocities;
  // Newmark's update of a position that is given would swing: the acceleration of led points at the point of
  // balance is drawn on from the mean ones of the last step, which is what they keep, and of this.
  const Eigen::Matrix3Xd led_q = (1 - alpha_f) * led.positions + alpha_f * led_columns(loads.led, state.positions);
  const Eigen::Matrix3Xd led_balance =
      led.accelerations + (0.5 - alpha_f) * (led.accelerations - led_accelerations);
  const Eigen::Matrix3Xd led_end = (led_balance - alpha_m * led_accelerations) / (1 - alpha_m);
  set_led_columns(loads.led, led_q, q);
  set_led_columns(loads.led, led_q - ((1 - alpha_f) * beta * h * h) * led_end, goal.anchor);
  NewtonOptions newton = newton_options(options);
  newton.progress = options.progress.part(0.3, 1);
  minimise(goal, *preconditioner, newton, q, report, clock);

  const Eigen::Matrix3Xd next_accelerations = (q - goal.anchor) / ((1 - alpha_f) * beta * h * h);
  Eigen::Matrix3Xd next_positions = (q - alpha_f * state.positions) / (1 - alpha_f);
  for (std::size_t i = 0; i < free.size(); ++i)
    if (!free[i])
      next_positions.col(static_cast<Eigen::Index>(i)) = state.positions.col(static_cast<Eigen::Index>(i));
  Eigen::Matrix3Xd next_velocities = velocities + h * ((1 - gamma) * accelerations + gamma * next_accelerations);
  set_led_columns(loads.led, led.positions, next_positions);
  set_led_columns(loads.led, led.velocities, next_velocities);
  std::vector<ContactGrip> grips = grips_at(contact, q);
  // They are of the time of balance; what is still allowed is that of the end.
  for (ContactGrip& grip : grips) grip.allowed = std::max(0.0, grip.allowed - grip.allowed_rate * alpha_f * h);
  advance(state, std::move(next_positions), std::move(next_velocities), h);
  state.grips = std::move(grips);
  state.accelerations = next_accelerations;
  set_led_columns(loads.led, led.accelerations, state.accelerations);
  return report;
}

}  // namespace argil::fem
