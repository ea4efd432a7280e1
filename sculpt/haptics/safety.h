#pragma once
// The one way that a force takes to a device: finite? stale? clamp, passivity, slew. Passivity by observer and
// controller in the time domain (after Hannaford and Ryu 2002): the work done on the hand is summed, and no force
// is larger than what can still be wound down before it has given out more than was taken in. The slew limit comes
// last, so that no step is ever larger, whatever was wanted or broke; that is why passivity looks ahead.

#include "sculpt/haptics/device.h"

namespace argil::sculpt {

struct SafetyLimits {
  double max_force = 8;   // [N]
  double max_slew = 500;  // [N/s], how fast a force may change, falling to zero for a fault or silence included
  double wind_down = 60;  // [N/s], how fast passivity takes back a force that moves with the hand, if it can
  double max_speed = 20;  // [m/s]; a pose that comes faster has jumped: no force is wanted, no work counted
  double start_energy = 3e-5;  // [J] that may be given out before any is taken in; infinity turns passivity off
  double max_energy = 0.5;  // [J] taken in that is remembered at most, so that a long push does not pay for a kick
  double least_mass = 0.1;  // [kg] of hand and handle together, that a force sets in motion at most so fast
};

struct SafetyReport {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // [N], to be commanded
  bool not_finite = false, stale = false, jumped = false, clamped = false, slewed = false, damped = false;
};

class SafetyChain {
 public:
  explicit SafetyChain(const SafetyLimits& limits = {});

  /// The force allowed now. Call once a tick: `position` is the device's [m], to where the force of the last call
  /// has brought it; `fresh` says that `wanted` rests on a model and a pose that still hold. What is not fresh lets
  /// the force fall to zero; so does a value that is not finite, and is a fault that lasts until reset.
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
