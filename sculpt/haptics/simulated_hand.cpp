#include "sculpt/haptics/simulated_hand.h"

#include <cassert>

namespace argil::sculpt {

SimulatedHand::SimulatedHand(Device& intention, const HandOptions& options)
    : intention_(intention), options_(options) {
  assert(options.mass > 0 && options.stiffness >= 0 && options.damping >= 0);
}

DeviceCapabilities SimulatedHand::capabilities() const {
  DeviceCapabilities capabilities;
  capabilities.actuated_axes = 3;
  capabilities.workspace_low = options_.workspace_low;
  capabilities.workspace_high = options_.workspace_high;
  capabilities.max_force = options_.max_force;
  // A wall sampled every T is felt as passive up to K < 2b/T (Colgate and Schenkel 1994, no damping in the wall).
  capabilities.max_stiffness = 2 * options_.damping / k_tick_seconds;
  return capabilities;
}

DeviceSample SimulatedHand::exchange(const ForceCommand& command, Tick tick) {
  if (!started_) {
    sample_ = intention_.exchange({}, tick);
    intended_ = sample_.pose.position;
    started_ = true;
  }
  // A device that heard nothing for long has no force left: only the hand's own motion remains, so the loop is
  // exact, if not short.
  while (sample_.tick + 1 < tick) move(command_, sample_.tick + 1);
  fault_ = fault_ || !command.force.allFinite();
  command_ = fault_ ? ForceCommand{} : command;
  if (sample_.tick < tick) move(command_, tick);
  const bool felt = tick <= command_.valid_until;
  sample_.mode = fault_ ? DeviceMode::fault : felt ? DeviceMode::force : DeviceMode::idle;
  return sample_;
}

void SimulatedHand::move(const ForceCommand& command, Tick tick) {
  constexpr double dt = k_tick_seconds;
  Eigen::Vector3d force = force_at(command, tick);
  if (const double size = force.norm(); size > options_.max_force) force *= options_.max_force / size;

  const DeviceSample intention = intention_.exchange({}, tick);
  const Eigen::Vector3d intended_velocity = (intention.pose.position - intended_) / dt;
  const Eigen::Vector3d before = sample_.pose.position;
  velocity_ = (options_.mass * velocity_ + dt * (options_.stiffness * (intention.pose.position - before) +
                                                 options_.damping * intended_velocity + force)) /
              (options_.mass + dt * options_.damping + dt * dt * options_.stiffness);
  const Eigen::Vector3d free = before + dt * velocity_;
  const Eigen::Vector3d kept = free.cwiseMax(options_.workspace_low).cwiseMin(options_.workspace_high);
  for (int axis = 0; axis < 3; ++axis)
    if (kept[axis] != free[axis]) velocity_[axis] = 0;  // the end of the workspace stops it

  intended_ = intention.pose.position;
  sample_ = intention;
  sample_.pose.position = kept;
  sample_.tick = tick;
  work_ += force.dot(kept - before);
}

}  // namespace argil::sculpt
