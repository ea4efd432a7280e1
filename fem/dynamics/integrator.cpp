#include "fem/dynamics/integrator.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <optional>

#include "fem/dynamics/newton.h"
#include "fem/dynamics/rigid_modes.h"
#include "fem/solvers/stencil_product.h"
#include "subdiv/error.h"

namespace argil::fem {

namespace {

constexpr double k_static_tolerance = 1e-8;
constexpr double k_static_linear_tolerance = 1e-6;
constexpr int k_static_cap = 60;
constexpr double k_smallest_load_step = 1.0 / 256;

/// What a preconditioner is made for; the springs' targets do not matter.
struct PreconditionerKey {
  double coefficient = -1;  // c; 0 in statics
  std::vector<AnchorSpring> springs;

  bool fits(double c, const std::vector<AnchorSpring>& others) const {
    if (coefficient != c || springs.size() != others.size()) return false;
    for (std::size_t i = 0; i < springs.size(); ++i)
      if (springs[i].stiffness != others[i].stiffness || springs[i].weights != others[i].weights ||
          springs[i].control_points != others[i].control_points)
        return false;
    return true;
  }
};

}  // namespace

struct Integrator::Impl {
  System system;
  std::optional<RestOperator> rest;
  std::vector<std::uint8_t> free;  // not fixed, and some element depends on it
  Eigen::SparseMatrix<double> inertia;
  PreconditionerKey key;
  std::unique_ptr<Preconditioner> preconditioner;

  Eigen::Index size() const { return static_cast<Eigen::Index>(system.rows->column_count); }

  void forget() {
    key.coefficient = -1;
    preconditioner.reset();
  }

  /// Makes what steps with coefficient c need, unless it is there.
  void prepare(double c, const std::vector<AnchorSpring>& springs) {
    if (!rest) {
      rest =
          rest_operator(system, preconditioner_kind(3 * system.rows->column_count) == PreconditionerKind::factor);
      forget();
    }
    if (preconditioner && key.fits(c, springs)) return;
    free.assign(system.fixed.size(), 0);
    for (std::size_t i = 0; i < free.size(); ++i) free[i] = !system.fixed[i] && rest->touched[i] ? 1 : 0;
    if (c > 0) {
      inertia = *system.mass / (c * c);
      if (system.damping) inertia += *system.damping / c;
    } else {
      inertia.resize(0, 0);
    }
    preconditioner =
        make_preconditioner(preconditioner_kind(3 * system.rows->column_count), *rest, inertia, springs, free);
    key = {c, springs};
  }

  Potential potential(const std::vector<AnchorSpring>& springs) const {
    Potential result;
    result.model = system.model;
    result.rest = &*rest;
    result.inertia = &inertia;
    result.springs = &springs;
    result.free = &free;
    return result;
  }

  Eigen::Matrix3Xd external_forces(const Loads& loads) const {
    return loads.forces.cols() > 0 ? loads.forces : Eigen::Matrix3Xd(Eigen::Matrix3Xd::Zero(3, size()));
  }
};

Integrator::Integrator(System system) : impl_(std::make_unique<Impl>()) {
  assert(system.rows && system.rows_transposed && system.model && system.mass && system.rest_nodes);
  assert(system.fixed.size() == system.rows->column_count);
  impl_->system = std::move(system);
}
Integrator::~Integrator() = default;
Integrator::Integrator(Integrator&&) noexcept = default;
Integrator& Integrator::operator=(Integrator&&) noexcept = default;

void Integrator::materials_changed() {
  impl_->rest.reset();
  impl_->forget();
}

void Integrator::set_fixed(std::vector<std::uint8_t> fixed) {
  assert(fixed.size() == impl_->system.fixed.size());
  impl_->system.fixed = std::move(fixed);
  impl_->forget();
}

StepReport Integrator::step(const Loads& loads, BodyState& state, double time_step, const StepOptions& options,
                            Clock clock) {
  if (!(time_step > 0) || !std::isfinite(time_step))
    throw Error(ErrorCode::bad_input,
                fmt::format("A time step must be positive and finite; {} s was given.", time_step));
  Impl& body = *impl_;
  const bool bdf2 = options.method == Method::bdf2 && state.previous_step == time_step;
  const double c = bdf2 ? 2 * time_step / 3 : time_step;
  const double start = clock ? clock() : 0;
  body.prepare(c, loads.springs);
  const double prepared = clock ? 1e3 * (clock() - start) : 0;

  Eigen::Matrix3Xd velocity = state.velocities;  // v̄
  Potential potential = body.potential(loads.springs);
  potential.anchor = state.positions;
  if (bdf2) {
    potential.anchor = (4 * state.positions - state.previous_positions) / 3;
    velocity = (4 * state.velocities - state.previous_velocities) / 3;
  }
  Eigen::Matrix3Xd p = state.positions + time_step * state.velocities;
  for (std::size_t i = 0; i < body.free.size(); ++i) {
    if (body.free[i]) continue;
    const auto column = static_cast<Eigen::Index>(i);
    p.col(column) = potential.anchor.col(column) = state.positions.col(column);
    velocity.col(column).setZero();
  }
  potential.constant_force = body.external_forces(loads) + velocity * (*body.system.mass / c);
  Eigen::Matrix3Xd x, v, node_forces, damping_forces;
  multiply(*body.system.rows, state.positions, x);
  multiply(*body.system.rows, state.velocities, v);
  body.system.model->velocity_forces(x, v, node_forces);
  multiply(*body.system.rows_transposed, node_forces, damping_forces);
  potential.constant_force += damping_forces;

  StepReport report;
  report.ms_tangent += prepared;
  NewtonOptions newton;
  newton.cap = options.newton_cap;
  newton.tolerance = options.newton_tolerance;
  newton.linear_tolerance = options.linear_tolerance;
  newton.linear_cap = options.linear_cap;
  minimise(potential, *body.preconditioner, newton, p, report, clock);

  BodyState next;
  next.velocities = (p - potential.anchor) / c;
  next.previous_positions = std::move(state.positions);
  next.previous_velocities = std::move(state.velocities);
  next.positions = std::move(p);
  next.previous_step = time_step;
  next.time = state.time + time_step;
  state = std::move(next);
  return report;
}

StepReport Integrator::solve_static(const Loads& loads, BodyState& state, const StepOptions& options, Clock clock) {
  Impl& body = *impl_;
  body.prepare(0, loads.springs);
  const Eigen::Matrix3Xd forces = body.external_forces(loads);
  check_rigid_motions(body.system, loads, body.rest->touched, state.positions, forces);

  StepReport report;
  NewtonOptions newton;
  newton.cap = k_static_cap;
  newton.tolerance = std::min(options.newton_tolerance, k_static_tolerance);
  newton.against_loads = true;
  newton.full_tangent = true;
  newton.linear_tolerance = std::min(options.linear_tolerance, k_static_linear_tolerance);
  newton.linear_cap = options.linear_cap;

  /// Equilibrium under a share of the load; the springs' targets move from where they hold the body now.
  const auto solve = [&](double share, Eigen::Matrix3Xd& p) {
    std::vector<AnchorSpring> springs = loads.springs;
    for (AnchorSpring& spring : springs) {
      const Eigen::Vector3d from = held_point(spring, state.positions);
      spring.target = share < 1 ? Eigen::Vector3d(from + share * (spring.target - from)) : spring.target;
    }
    Potential potential = body.potential(springs);
    potential.constant_force = share * forces;
    minimise(potential, *body.preconditioner, newton, p, report, clock);
    return report.converged;
  };
  Eigen::Matrix3Xd p = state.positions;
  if (!solve(1.0, p)) {
    p = state.positions;
    double share = 0, increment = 0.25;
    while (share < 1) {
      Eigen::Matrix3Xd trial = p;
      const double next = std::min(1.0, share + increment);
      if (solve(next, trial)) {
        p = std::move(trial);
        share = next;
        continue;
      }
      increment /= 2;
      if (increment < k_smallest_load_step)
        throw Error(
            ErrorCode::not_converged,
            fmt::format("No static equilibrium was found beyond {:.3g} of the load: the residual is {:.2g} of "
                        "the loads where {:.0e} was asked for. Lower the load, or step in time with damping.",
                        share, report.residual, newton.tolerance));
    }
  }
  const Eigen::Index n = p.cols();
  const double time = state.time;
  state = BodyState{};
  state.positions = std::move(p);
  state.velocities.setZero(3, n);
  state.time = time;
  return report;
}

}  // namespace argil::fem
