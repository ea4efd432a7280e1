#include "sculpt/haptics/safety.h"

#include <algorithm>
#include <cassert>

namespace argil::sculpt {

namespace {

bool clamp_size(Eigen::Vector3d& force, double largest) {
  const double size = force.stableNorm();  // 1e300 N must not overflow
  if (size <= largest) return false;
  force *= largest / size;
  return true;
}

}  // namespace

SafetyChain::SafetyChain(const SafetyLimits& limits) : limits_(limits), energy_(limits.start_energy) {
  assert(limits.max_force >= 0 && limits.max_slew > 0 && limits.start_energy >= 0 && limits.max_damping >= 0);
}

void SafetyChain::reset() {
  *this = SafetyChain(limits_);
}

SafetyReport SafetyChain::apply(const Eigen::Vector3d& wanted, const Eigen::Vector3d& position, bool fresh) {
  SafetyReport report;
  report.not_finite = !wanted.allFinite() || !position.allFinite();
  report.stale = !fresh;
  fault_ = fault_ || report.not_finite;

  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  if (position.allFinite()) {
    if (started_) motion = position - last_position_;
    last_position_ = position;
    started_ = true;
  }
  const double most = std::max(limits_.max_energy, limits_.start_energy);
  energy_ = std::min(energy_ - last_force_.dot(motion), most);

  if (fault_ || report.stale) {
    last_force_.setZero();
    return report;
  }

  Eigen::Vector3d force = wanted;
  report.clamped = clamp_size(force, limits_.max_force);

  Eigen::Vector3d change = force - last_force_;
  report.slewed = clamp_size(change, limits_.max_slew * k_tick_seconds);
  force = last_force_ + change;

  // If the next tick moves as this one did, it gives out force·motion.
  const double excess = force.dot(motion) - energy_;
  if (excess > 0 && motion.squaredNorm() > 0) {
    const double damping = std::min(excess / motion.squaredNorm(), limits_.max_damping / k_tick_seconds);
    force -= damping * motion;
    report.damped = true;
  }
  report.clamped = clamp_size(force, limits_.max_force) || report.clamped;
  last_force_ = report.force = force;
  return report;
}

}  // namespace argil::sculpt
