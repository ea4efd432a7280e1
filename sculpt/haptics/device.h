#pragma once
// The seam to pointing and force devices (DESIGN.md, "Devices"): a pose and buttons come in, a force goes out, in
// one exchange that never waits. Whoever owns the device paces it by a virtual or a real clock. Everything is SI,
// in the device's own frame; mapping.h leads to the world.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>

namespace argil::sculpt {

using Tick = std::int64_t;                      // of 1 ms
inline constexpr double k_tick_seconds = 1e-3;  // [s]

enum class DeviceMode {
  closed,        // no device, or its recording is over
  uncalibrated,  // poses are not to be trusted yet
  idle,          // senses; applies no force
  force,         // senses, and applies the force commanded
  brake,         // resists motion by its own means, after a stop
  fault          // refused a command or lost itself; applies no force until it is opened again
};

struct DevicePose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

struct DeviceSample {
  DevicePose pose;
  std::uint32_t buttons = 0;  // bit i: button i is pressed
  Tick tick = 0;              // when the pose was true
  DeviceMode mode = DeviceMode::closed;
  double pressure = 1;  // 0 … 1, of a pen; 1 where none is sensed
};

/// A force to apply until a tick; after it the device applies none, whatever else it hears or not.
struct ForceCommand {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // [N]
  Tick valid_until = 0;                             // the last tick that it holds for
};

struct DeviceCapabilities {
  int sensed_axes = 3, actuated_axes = 0;  // degrees of freedom
  Eigen::Vector3d workspace_low = Eigen::Vector3d::Constant(-1),
                  workspace_high = Eigen::Vector3d::Constant(1);  // [m]
  double max_force = 0;      // [N], largest that it can apply; 0: felt by the eye only
  double max_stiffness = 0;  // [N/m], largest stable wall at its rate
  double rate = 1000;        // [1/s], exchanges that it can take
  bool senses_pressure = false;
};

struct ContactModel;

class Device {
 public:
  virtual ~Device() = default;
  virtual DeviceCapabilities capabilities() const = 0;

  /// True for a device that has its servo beside it: it is told contact models, not forces.
  virtual bool takes_models() const { return false; }
  /// Hands it the newest model, in its own frame, if it takes any; never waits.
  virtual void publish(const ContactModel&, Tick /*now*/) {}

  /// Hands over the command for the tick that ends now, and returns the newest sample; never waits and never throws
  /// for what the device does (its mode says it). `tick` must not fall.
  virtual DeviceSample exchange(const ForceCommand& command, Tick tick) = 0;
};

/// The force that a device which was given `command` applies at `tick`.
inline Eigen::Vector3d force_at(const ForceCommand& command, Tick tick) {
  return tick <= command.valid_until ? command.force : Eigen::Vector3d::Zero();
}

}  // namespace argil::sculpt
