#pragma once
// A device that is steered by rates: the sticks of a gamepad, the cap of a 3D mouse. What it says is how fast to
// go; where it is comes from adding that up, so it has no drift of its own and stands still when nothing is
// touched.

#include <array>
#include <optional>

#include "sculpt/haptics/device.h"

namespace argil::sculpt {

/// Deflections in [−1, 1]: along x, y, z, and turns about them, in the device's frame.
struct RateInput {
  std::array<double, 6> axes{};
  std::uint32_t buttons = 0;
};

/// The seam to the hardware.
class RateSource {
 public:
  virtual ~RateSource() = default;
  /// What the hand does now, without waiting; nothing while the device is not there.
  virtual std::optional<RateInput> poll() = 0;
  /// Shakes the hand by this share in [0, 1], until it is told otherwise; may do nothing.
  virtual void rumble(double share) = 0;
};

struct RateOptions {
  double dead_zone = 0.1;                                         // of the deflection, where it counts as none
  double exponent = 2;                                            // 1: linear; more: finer near rest
  double speed = 0.3;                                             // [m/s] at full deflection
  double turn = 1.5;                                              // [rad/s] at full deflection
  double full_force = 8;                                          // [N] that shakes it all
  Eigen::Vector3d workspace_low = Eigen::Vector3d::Constant(-1);  // [m]
  Eigen::Vector3d workspace_high = Eigen::Vector3d::Constant(1);
};

class RateDevice : public Device {
 public:
  /// The source must outlive it.
  explicit RateDevice(RateSource& source, const RateOptions& options = {});
  /// Puts it somewhere, as when a tool takes hold; within the workspace.
  void place(const DevicePose& pose);

  DeviceCapabilities capabilities() const override;
  /// Silences of more than 50 ticks count as 50: a program that hung does not let the device fly.
  DeviceSample exchange(const ForceCommand& command, Tick tick) override;

 private:
  double rate(double deflection) const;

  RateSource& source_;
  RateOptions options_;
  DeviceSample sample_;
  bool started_ = false;
};

}  // namespace argil::sculpt
