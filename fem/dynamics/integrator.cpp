#include "fem/dynamics/integrator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "fem/dynamics/integrator_body.h"
#include "fem/dynamics/led_points.h"
#include "subdiv/error.h"

namespace argil::fem {

void append(StepReport& sum, const StepReport& next) {
  const StepReport before = sum;
  sum = next;
  sum.newton_iterations += before.newton_iterations;
  sum.linear_iterations += before.linear_iterations;
  sum.ms_forces += before.ms_forces;
  sum.ms_tangent += before.ms_tangent;
  sum.ms_solve += before.ms_solve;
  sum.ms_line_search += before.ms_line_search;
}

Integrator::Integrator(System system) : impl_(std::make_unique<Impl>(std::move(system))) {
  const System& of = impl_->system;
  assert(of.rows && of.rows_transposed && of.model && of.mass && of.rest_nodes);
  assert(of.fixed.size() == of.rows->column_count);
  static_cast<void>(of);
}
Integrator::~Integrator() = default;
Integrator::Integrator(Integrator&&) noexcept = default;
Integrator& Integrator::operator=(Integrator&&) noexcept = default;

void Integrator::materials_changed() {
  impl_->forget_materials();
}

void Integrator::set_fixed(std::vector<std::uint8_t> fixed) {
  assert(fixed.size() == impl_->system.fixed.size());
  impl_->system.fixed = std::move(fixed);
  impl_->forget_pins();
}

void Integrator::set_model(const ForceModel& model) {
  assert(impl_->system.rest_model);
  impl_->system.model = &model;
  impl_->forget_values();
}

const System& Integrator::system() const {
  return impl_->system;
}

double Integrator::elastic_energy(const Eigen::Matrix3Xd& positions) {
  return impl_->elastic_energy(positions);
}

StepReport Integrator::step(const Loads& loads, BodyState& state, double time_step, const StepOptions& options,
                            Clock clock) {
  if (!(time_step > 0) || !std::isfinite(time_step))
    throw Error(ErrorCode::bad_input,
                fmt::format("A time step must be positive and finite; {} s was given.", time_step));
  switch (options.method) {
    case Method::bdf2:
    case Method::implicit_euler:
    case Method::semi_implicit:
      return impl_->incremental_step(loads, state, time_step, options, clock);
    case Method::generalised_alpha:
      return impl_->generalised_alpha_step(loads, state, time_step, options, clock);
    case Method::central_difference:
    case Method::forward_euler:
    case Method::symplectic_euler:
    case Method::velocity_verlet:
    case Method::midpoint:
      return impl_->explicit_step(loads, state, time_step, options, clock);
    case Method::published:
      return impl_->published_step(loads, state, time_step, options, clock);
  }
  assert(false && "a method without steps");
  return {};
}

namespace {

// Of the motion before or after, in energy, that a step changes by where a body strikes.
constexpr double k_strike = 0.25;

/// vᵀ M v.
double squared(const Eigen::SparseMatrix<double>& mass, const Eigen::Matrix3Xd& velocities) {
  double sum = 0;
  for (Eigen::Index c = 0; c < mass.outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator it(mass, c); it; ++it)
      sum += it.value() * (velocities(0, it.row()) * velocities(0, c) + velocities(1, it.row()) * velocities(1, c) +
                           velocities(2, it.row()) * velocities(2, c));
  return sum;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> touched_at(ContactStep& contact, const Eigen::Matrix3Xd& p) {
  contact.set_state(p);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> result;
  for (const Touch& touch : contact.touches()) result.emplace_back(touch.obstacle, touch.point);
  return result;
}

/// Whether a step has struck an obstacle, or left one, so that the velocities of before say nothing of those to
/// come.
bool has_struck(ContactStep& contact, const Eigen::SparseMatrix<double>& mass, const BodyState& begin,
                const Eigen::Matrix3Xd& positions, const Eigen::Matrix3Xd& velocities) {
  if (touched_at(contact, begin.positions) == touched_at(contact, positions)) return false;
  return squared(mass, velocities - begin.velocities) >
         k_strike * std::max(squared(mass, begin.velocities), squared(mass, velocities));
}

}  // namespace

/// BDF2, implicit Euler, and the single linear solve of semi-implicit Euler, which starts from where the body is.
StepReport Integrator::Impl::incremental_step(const Loads& loads, BodyState& state, double h,
                                              const StepOptions& options, Clock clock) {
  const bool bdf2 = options.method == Method::bdf2 && state.previous_step == h;
  const bool one_solve = options.method == Method::semi_implicit;
  const double c = bdf2 ? 2 * h / 3 : h;
  const double start = clock ? clock() : 0;
  prepare({c * c, c}, loads.springs, options.progress.part(0, 0.3));
  const double prepared = clock ? 1e3 * (clock() - start) : 0;

  Eigen::Matrix3Xd velocity = state.velocities;  // v̄
  Potential goal = potential(loads.springs);
  std::optional<ContactStep> contact = contact_step(loads, state, state.time + h);
  goal.contact = contact ? &*contact : nullptr;
  goal.columns = &columns;
  goal.anchor = state.positions;
  if (bdf2) {
    goal.anchor = (4 * state.positions - state.previous_positions) / 3;
    velocity = (4 * state.velocities - state.previous_velocities) / 3;
  }
  Eigen::Matrix3Xd p = state.positions;
  if (!one_solve) p += h * state.velocities;
  // Led points have the same history as free ones, so that their velocity is the method's own.
  const Eigen::Matrix3Xd led_anchor = led_columns(loads.led, goal.anchor);
  const Eigen::Matrix3Xd led_velocity = led_columns(loads.led, velocity);
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (free[i]) continue;
    const auto column = static_cast<Eigen::Index>(i);
    p.col(column) = goal.anchor.col(column) = state.positions.col(column);
    velocity.col(column).setZero();
  }
  set_led_columns(loads.led, led_anchor, goal.anchor);
  set_led_columns(loads.led, led_velocity, velocity);
  set_led_columns(loads.led, led_step(loads.led, state, h).positions, p);
  goal.constant_force = load_forces(loads) + velocity * (*system.mass / c);
  goal.constant_force += velocity_forces(state);
  // The velocity (p − p̄)/c of BDF2 belongs to the end of the step, that of Euler's method to its middle: seen from
  // there a rotation has no rate of strain, to the third power of its angle.
  const double share = one_solve ? 0 : (bdf2 ? 1 : 0.5);
  set_viscosity(goal, state.positions + share * h * state.velocities, c);

  StepReport report;
  report.ms_tangent += prepared;
  NewtonOptions newton = newton_options(options);
  newton.progress = options.progress.part(0.3, 1);
  if (one_solve) {
    newton.cap = 1;
    newton.tolerance = 0;
    newton.line_search = false;
  }
  minimise(goal, *preconditioner, newton, p, report, clock);
  if (one_solve) report.converged = true;
  Eigen::Matrix3Xd next = (p - goal.anchor) / c;
  const bool struck =
      options.method == Method::bdf2 && contact && has_struck(*contact, *system.mass, state, p, next);
  std::vector<ContactGrip> grips = grips_at(contact, p);
  advance(state, std::move(p), std::move(next), h);
  state.grips = std::move(grips);
  if (struck) {
    // Two steps drawn on across a strike would give back what they take too much: the next is one of Euler's
    // method.
    state.previous_positions.resize(3, 0);
    state.previous_velocities.resize(3, 0);
    state.previous_step = 0;
  }
  return report;
}

}  // namespace argil::fem
