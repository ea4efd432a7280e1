// Methods that take the stiffness where the body is. Each solves with the factored consistent mass, once per
// evaluation of the forces; above a step of about 2 over the highest frequency of (K̃, M̃) all of them diverge.

#include "fem/dynamics/integrator_body.h"
#include "fem/dynamics/led_points.h"

namespace argil::fem {

namespace {

struct Motion {
  Eigen::Matrix3Xd p, v;
  double passed = 0;  // since the step began [s]
};

Motion forward_euler(const Motion& now, const Eigen::Matrix3Xd& a, double h) {
  return {now.p + h * now.v, now.v + h * a, now.passed + h};
}

Motion symplectic_euler(const Motion& now, const Eigen::Matrix3Xd& a, double h) {
  Motion next{now.p, now.v + h * a};
  next.p += h * next.v;
  return next;
}

/// The second evaluation sees the velocity at the end as the first extrapolates it, so that damping too is of
/// second order.
template <class Accelerations>
Motion velocity_verlet(const Motion& now, const Eigen::Matrix3Xd& a, const Accelerations& accelerations, double h) {
  Motion next{now.p + h * now.v + (0.5 * h * h) * a, now.v + h * a, h};
  next.v = now.v + (0.5 * h) * (a + accelerations(next));
  return next;
}

template <class Accelerations>
Motion midpoint(const Motion& now, const Eigen::Matrix3Xd& a, const Accelerations& accelerations, double h) {
  const Motion middle = forward_euler(now, a, 0.5 * h);
  return {now.p + h * middle.v, now.v + h * accelerations(middle)};
}

}  // namespace

StepReport Integrator::Impl::explicit_step(const Loads& loads, BodyState& state, double h,
                                           const StepOptions& options, Clock clock) {
  const double start = clock ? clock() : 0;
  const MassFactor& mass = factored_mass(options.method == Method::central_difference ? 0.5 * h : 0);
  StepReport report;
  report.preconditioner = PreconditionerKind::none;
  if (clock) report.ms_tangent = 1e3 * (clock() - start);

  Motion now{state.positions, state.velocities}, next;
  clear_held(free, now.v);
  const bool leads = !loads.led.control_points.empty();
  const LedStep led = led_step(loads.led, state, h);
  set_led_columns(loads.led, led_columns(loads.led, state.velocities), now.v);
  // 3 x control points, zero but where points are led.
  const auto spread = [&](const Eigen::Matrix3Xd& of_led) {
    Eigen::Matrix3Xd all = Eigen::Matrix3Xd::Zero(3, size());
    set_led_columns(loads.led, of_led, all);
    return all;
  };
  const auto accelerations = [&](const Motion& at) {
    Eigen::Matrix3Xd acting = with_mass_damping(forces(loads, state, state.time + at.passed, at.p, at.v), at.v);
    if (leads) acting -= spread(led.accelerations) * *system.mass;
    Eigen::Matrix3Xd result = mass.solve(acting);
    set_led_columns(loads.led, led.accelerations, result);
    return result;
  };
  if (options.method == Method::central_difference) {
    // papers/004 eq. 20 less (2M + hD) p on both sides, where it would cancel; the factor is that of M + hD/2.
    const auto acting_and_past = [&](const Eigen::Matrix3Xd& acting, const Eigen::Matrix3Xd& last,
                                     const Eigen::Matrix3Xd& led_way) {
      if (!leads)
        return Eigen::Matrix3Xd((h * h) * acting +
                                with_mass_damping(last * *system.mass, Eigen::Matrix3Xd((0.5 * h) * last)));
      const Eigen::Matrix3Xd way = spread(led_way);
      return Eigen::Matrix3Xd((h * h) * acting + with_mass_damping((last - way) * *system.mass,
                                                                   Eigen::Matrix3Xd((0.5 * h) * (last + way))));
    };
    const Eigen::Matrix3Xd acting = forces(loads, state, state.time, now.p, now.v);
    Eigen::Matrix3Xd last;
    if (state.previous_step == h) {
      last = now.p - state.previous_positions;
      const Eigen::Matrix3Xd led_last = led_columns(loads.led, last);
      clear_held(free, last);
      set_led_columns(loads.led, led_last, last);
      const Eigen::Matrix3Xd led_way = led.positions - led_columns(loads.led, now.p);
      next.p = now.p + mass.solve(acting_and_past(acting, last, led_way));
    } else {
      // With p₋ = p₊ − 2hv, eq. 20 gives p₊ itself.
      Eigen::Matrix3Xd first = with_mass_damping(acting, now.v);
      if (leads) first -= spread(led.accelerations) * *system.mass;
      next.p = now.p + (0.5 * h * h) * factored_mass(0).solve(first) + h * now.v;
    }
    set_led_columns(loads.led, led.positions, next.p);
    // Eq. 16 (its left side belongs to the middle of its three times) of the step that would follow.
    const MassFactor& again = factored_mass(0.5 * h);
    last = next.p - now.p;
    next.v = last / h;
    const Eigen::Matrix3Xd following = forces(loads, state, state.time + h, next.p, next.v);
    next.v = (last + again.solve(acting_and_past(following, last, h * led.velocities))) / (2 * h);
  } else {
    const Eigen::Matrix3Xd a = accelerations(now);
    switch (options.method) {
      case Method::forward_euler:
        next = forward_euler(now, a, h);
        break;
      case Method::symplectic_euler:
        next = symplectic_euler(now, a, h);
        break;
      case Method::velocity_verlet:
        next = velocity_verlet(now, a, accelerations, h);
        break;
      default:
        next = midpoint(now, a, accelerations, h);
        break;
    }
  }
  set_led_columns(loads.led, led.positions, next.p);
  set_led_columns(loads.led, led.velocities, next.v);
  if (!next.p.allFinite() || !next.v.allFinite()) fail_not_finite();
  std::optional<ContactStep> contact = contact_step(loads, state, state.time + h);
  std::vector<ContactGrip> grips = grips_at(contact, next.p);
  advance(state, std::move(next.p), std::move(next.v), h);
  state.grips = std::move(grips);
  report.converged = true;
  if (clock) report.ms_forces = 1e3 * (clock() - start) - report.ms_tangent;
  return report;
}

}  // namespace argil::fem
