#include <fmt/format.h>

#include "fem/dynamics/integrator_body.h"
#include "fem/dynamics/rigid_modes.h"
#include "subdiv/error.h"

namespace argil::fem {

namespace {

constexpr double k_static_tolerance = 1e-8;
constexpr double k_static_linear_tolerance = 1e-6;
constexpr int k_static_cap = 60;
constexpr double k_smallest_load_step = 1.0 / 256;

}  // namespace

StepReport Integrator::solve_static(const Loads& loads, BodyState& state, const StepOptions& options, Clock clock) {
  Impl& body = *impl_;
  std::optional<ContactStep> contact = contact_step(loads, state, state.time);
  // What touches now holds the body, and is what the preconditioner is made for.
  Loads held = loads;
  if (contact) {
    contact->set_state(state.positions);
    for (AnchorSpring& spring : contact->springs()) held.springs.push_back(std::move(spring));
  }
  const Progress preparing = options.progress.part(0, 0.3), solving = options.progress.part(0.3, 1);
  body.prepare({}, held.springs, preparing);
  const Eigen::Matrix3Xd forces = body.load_forces(loads);
  check_rigid_motions(body.system, held, body.rest->touched, state.positions, forces);

  StepReport report;
  NewtonOptions newton;
  newton.cap = k_static_cap;
  newton.tolerance = std::min(options.newton_tolerance, k_static_tolerance);
  newton.against_loads = true;
  newton.full_tangent = true;
  newton.linear_tolerance = std::min(options.linear_tolerance, k_static_linear_tolerance);
  newton.linear_cap = options.linear_cap;

  /// Equilibrium under a share of the load; the springs' targets move from where they hold the body now.
  const auto solve = [&](double share, Eigen::Matrix3Xd& p, const Progress& progress) {
    newton.progress = progress;
    std::vector<AnchorSpring> springs = loads.springs;
    for (AnchorSpring& spring : springs) {
      const Eigen::Vector3d from = held_point(spring, state.positions);
      spring.target = share < 1 ? Eigen::Vector3d(from + share * (spring.target - from)) : spring.target;
    }
    Potential potential = body.potential(springs);
    potential.constant_force = share * forces;
    potential.contact = contact ? &*contact : nullptr;
    minimise(potential, *body.preconditioner, newton, p, report, clock);
    return report.converged;
  };
  Eigen::Matrix3Xd p = state.positions;
  if (!solve(1.0, p, solving)) {
    p = state.positions;
    double share = 0, increment = 0.25;
    while (share < 1) {
      Eigen::Matrix3Xd trial = p;
      const double next = std::min(1.0, share + increment);
      if (solve(next, trial, solving.part(share, next))) {
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
  std::vector<ContactGrip> grips = grips_at(contact, p);
  state = BodyState{};
  state.positions = std::move(p);
  state.velocities.setZero(3, n);
  state.time = time;
  state.grips = std::move(grips);
  return report;
}

}  // namespace argil::fem
