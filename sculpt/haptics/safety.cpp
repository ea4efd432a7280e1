#include "sculpt/haptics/safety.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace argil::sculpt {

namespace {

bool clamp_size(Eigen::Vector3d& force, double largest) {
  const double size = force.stableNorm();  // 1e300 N must not overflow
  if (size <= largest) return false;
  force *= largest / size;
  return true;
}

// The largest force that can still be wound down before it has given out `energy` [J] to a hand that now moves
// along it with `speed` [m/s] (against it: below 0). Wound down at a rate r, a force f gives f² speed / (2 r) by
// the motion that there is, and f⁴ / (8 r² mass) by that which it makes: f⁴ + 2 g f² = h energy.
double largest_to_wind_down(double energy, double speed, const SafetyLimits& limits) {
  if (energy > 1e100 || limits.max_slew > 1e100) return energy > 0 ? std::numeric_limits<double>::infinity() : 0;
  const double h = 8 * limits.max_slew * limits.max_slew * limits.least_mass;
  const double g = h * speed / (4 * (speed > 0 ? limits.wind_down : limits.max_slew));
  const double under_root = g * g + h * energy;
  if (under_root < 0) return 0;
  const double root = std::sqrt(under_root);
  return std::sqrt(std::max(0.0, g > 0 ? h * energy / (g + root) : root - g));
}

}  // namespace

SafetyChain::SafetyChain(const SafetyLimits& limits) : limits_(limits), energy_(limits.start_energy) {
  assert(limits.max_force >= 0 && limits.max_slew > 0 && limits.start_energy >= 0 && limits.least_mass > 0 &&
         limits.wind_down > 0);
}

void SafetyChain::reset() {
  const Eigen::Vector3d force = last_force_;  // that it goes on from
  *this = SafetyChain(limits_);
  last_force_ = force;
}

SafetyReport SafetyChain::apply(const Eigen::Vector3d& wanted, const Eigen::Vector3d& position, bool fresh) {
  SafetyReport report;
  report.not_finite = !wanted.allFinite() || !position.allFinite();
  report.stale = !fresh;
  fault_ = fault_ || report.not_finite;

  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  if (position.allFinite()) {
    if (started_) motion = position - last_position_;
    report.jumped = motion.stableNorm() > limits_.max_speed * k_tick_seconds;
    if (report.jumped) motion.setZero();
    last_position_ = position;
    started_ = true;
  }
  const double most = std::max(limits_.max_energy, limits_.start_energy);
  energy_ = std::min(energy_ - last_force_.dot(motion), most);

  const bool silent = fault_ || report.stale || report.jumped;
  Eigen::Vector3d force = silent ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : wanted;
  report.clamped = clamp_size(force, limits_.max_force);

  if (const double size = force.stableNorm(); size > 0) {
    const double speed = force.dot(motion) / (size * k_tick_seconds);
    const double allowed = largest_to_wind_down(energy_, speed, limits_);
    if (size > allowed) {
      report.damped = true;
      // Neither taken back nor given again at once, or it would rattle; half of the reserve pays for that.
      const double last = last_force_.stableNorm(), step = limits_.wind_down * k_tick_seconds;
      const double with_reserve = largest_to_wind_down(energy_ + limits_.start_energy / 2, speed, limits_);
      clamp_size(force, std::min(with_reserve, std::clamp(allowed, last - step, last + step)));
    }
  }

  Eigen::Vector3d change = force - last_force_;
  report.slewed = clamp_size(change, limits_.max_slew * k_tick_seconds);
  if (report.slewed) force = last_force_ + change;
  clamp_size(force, limits_.max_force);  // of rounding
  last_force_ = report.force = force;
  return report;
}

}  // namespace argil::sculpt
