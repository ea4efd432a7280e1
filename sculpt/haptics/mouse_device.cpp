#include "sculpt/haptics/mouse_device.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace argil::sculpt {

void MouseDevice::grab(const Eigen::Vector3d& through, const Eigen::Vector3d& view) {
  assert(through.allFinite() && view.allFinite() && view.squaredNorm() > 0);
  position_ = through_ = through;
  view_ = view.normalized();
  ray_.reset();
}

void MouseDevice::point(const PointerRay& ray) {
  if (!ray.origin.allFinite() || !ray.direction.allFinite()) return;
  ray_ = ray;
  meet();
}

void MouseDevice::push(double depth) {
  if (!std::isfinite(depth)) return;
  through_ += depth * view_;
  if (ray_)
    meet();
  else
    position_ += depth * view_;
}

void MouseDevice::set_pressure(double pressure) {
  if (std::isfinite(pressure)) pressure_ = std::clamp(pressure, 0.0, 1.0);
}

void MouseDevice::meet() {
  const double along = ray_->direction.dot(view_), ahead = (through_ - ray_->origin).dot(view_);
  // Nearly along the plane the pointer's pixels would be metres apart.
  if (along <= 1e-3 * ray_->direction.norm() || ahead < 0) return;
  position_ = ray_->origin + ahead / along * ray_->direction;
}

DeviceCapabilities MouseDevice::capabilities() const {
  DeviceCapabilities capabilities;
  capabilities.workspace_low.setConstant(-1e9);
  capabilities.workspace_high.setConstant(1e9);
  capabilities.senses_pressure = true;
  return capabilities;
}

DeviceSample MouseDevice::exchange(const ForceCommand& command, Tick tick) {
  shown_force_ = command.force.allFinite() ? force_at(command, tick) : Eigen::Vector3d(Eigen::Vector3d::Zero());
  DeviceSample sample;
  sample.pose.position = position_;
  sample.buttons = buttons_;
  sample.pressure = pressure_;
  sample.tick = tick;
  sample.mode = DeviceMode::idle;
  return sample;
}

}  // namespace argil::sculpt
