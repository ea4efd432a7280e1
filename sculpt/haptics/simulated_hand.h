#pragma once
// A hand that holds a force device, so that the loop closes in a test: a mass drawn by a spring and damper to the
// path that it intends, and pushed off it by the force of the device.
//
//   intended path ──/\/\/──┬── mass ◄── device's force          m a = k (x_i − x) + b (v_i − v) + f
//                  ──[==]──┘
//
// One step a tick, implicit in the hand's own spring and damper (stable for any of their values), explicit in the
// device's force, as sampling makes it.

#include "sculpt/haptics/device.h"

namespace argil::sculpt {

struct HandOptions {
  double mass = 0.2;       // [kg], hand and handle together
  double stiffness = 200;  // [N/m]
  double damping = 8;      // [N s/m]
  double max_force = 20;   // [N], what the device's motors give; more is cut to it
  Eigen::Vector3d workspace_low = Eigen::Vector3d::Constant(-2),
                  workspace_high = Eigen::Vector3d::Constant(2);  // [m]
};

class SimulatedHand : public Device {
 public:
  /// `intention` gives the path, orientation and buttons, and must outlive the hand.
  explicit SimulatedHand(Device& intention, const HandOptions& options = {});

  DeviceCapabilities capabilities() const override;

  /// Moves the hand to `tick`: ticks that nothing was heard in under the last command until it expires, the last
  /// one under `command`. A command that is not finite is refused, and the mode is `fault` from then on.
  DeviceSample exchange(const ForceCommand& command, Tick tick) override;

  /// Work that the device has done on the hand so far [J]; a passive loop keeps it below what it held at first.
  double work_received() const { return work_; }
  const Eigen::Vector3d& velocity() const { return velocity_; }  // [m/s]

 private:
  void move(const ForceCommand& command, Tick tick);

  Device& intention_;
  HandOptions options_;
  DeviceSample sample_;
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero(), intended_ = Eigen::Vector3d::Zero();
  ForceCommand command_;
  double work_ = 0;
  bool started_ = false, fault_ = false;
};

}  // namespace argil::sculpt
