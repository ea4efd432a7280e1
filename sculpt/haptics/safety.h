#pragma once
// The one way that a force takes to a device: finite? stale? clamp, slew, passivity, clamp. Passivity by observer
// and controller in the time domain (Hannaford and Ryu 2002): the work done on the hand is summed, and where the
// next tick would give out more than was taken in, damping along the motion takes the excess back.

#include "sculpt/haptics/device.h"

namespace argil::sculpt {

struct SafetyLimits {
  double max_force = 8;  // [N]
  double max_slew =
      1000;  // [N/s], how fast a force may change; dropping to zero for a fault or silence is not held up
  double start_energy = 1e-3;  // [J] that may be given out before any is taken in; infinity turns passivity off
  double max_energy = 0.5;  // [J] taken in that is remembered at most, so that a long push does not pay for a kick
  double max_damping = 40;  // [N s/m] of the controller; twice the mass of the hand over a tick would be unstable
};

struct SafetyReport {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // [N], to be commanded
  bool not_finite = false, stale = false, clamped = false, slewed = false, damped = false;
};

class SafetyChain {
 public:
  explicit SafetyChain(const SafetyLimits& limits = {});

  /// The force allowed now. Call once a tick: `position` is the device's [m], to where the force of the last call
  /// has brought it; `fresh` says that `wanted` rests on a model and a pose that still hold. A value that is not
  /// finite gives zero and a fault that lasts until reset.
  SafetyReport apply(const Eigen::Vector3d& wanted, const Eigen::Vector3d& position, bool fresh);

  bool fault() const { return fault_; }
  void reset();

  /// What may still be given out [J]; below zero by what the last tick took unforeseen.
  double energy() const { return energy_; }

 private:
  SafetyLimits limits_;
  Eigen::Vector3d last_force_ = Eigen::Vector3d::Zero(), last_position_ = Eigen::Vector3d::Zero();
  double energy_;
  bool started_ = false, fault_ = false;
};

}  // namespace argil::sculpt
