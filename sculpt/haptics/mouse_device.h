#pragma once
// A mouse or pen as a device: the ray under the pointer meets a plane that faces the viewer and goes through what
// was touched; the wheel moves that plane along the view. How hard a pen is pressed goes with the pose. Force is
// drawn, not felt. The device's frame is the world's.

#include <optional>

#include "sculpt/haptics/device.h"

namespace argil::sculpt {

struct PointerRay {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();       // [m]
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();  // of any length but 0
};

class MouseDevice : public Device {
 public:
  /// Lays the plane through `through`, across `view`, of any length but 0; the device is there at once.
  void grab(const Eigen::Vector3d& through, const Eigen::Vector3d& view);
  /// Where the pointer is. A ray along the plane, or one that meets it behind its origin, leaves the device where
  /// it was; so does one that is not finite.
  void point(const PointerRay& ray);
  /// Away from the viewer by so much [m], on top of what there was.
  void push(double depth);
  void press(std::uint32_t buttons) { buttons_ = buttons; }
  /// Of a pen; cut to 0 … 1. A number that is none leaves it as it was.
  void set_pressure(double pressure);

  DeviceCapabilities capabilities() const override;
  DeviceSample exchange(const ForceCommand& command, Tick tick) override;
  /// That the device would apply if it could: to be drawn [N].
  const Eigen::Vector3d& shown_force() const { return shown_force_; }

 private:
  void meet();

  Eigen::Vector3d through_ = Eigen::Vector3d::Zero(), view_ = -Eigen::Vector3d::UnitZ();
  std::optional<PointerRay> ray_;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero(), shown_force_ = Eigen::Vector3d::Zero();
  std::uint32_t buttons_ = 0;
  double pressure_ = 1;
};

}  // namespace argil::sculpt
