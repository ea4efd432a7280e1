#pragma once
// Between the frame of a device and the world: turn, scale and shift of positions; turn and scale of forces.

#include "sculpt/haptics/device.h"

namespace argil::sculpt {

struct WorldFromDevice {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  double scale = 1;                                       // world metres for a metre of the device
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();  // world place of the device's origin [m]
  double force_scale = 1;                                 // newtons felt for a newton in the world

  Eigen::Vector3d position(const Eigen::Vector3d& device_position) const {
    return translation + scale * (rotation * device_position);
  }
  Eigen::Vector3d device_force(const Eigen::Vector3d& world_force) const {
    return force_scale * (rotation.conjugate() * world_force);
  }

  /// Clutch: the same mapping shifted so that the device, moved elsewhere meanwhile, is again at `world_position`.
  WorldFromDevice clutched(const Eigen::Vector3d& device_position, const Eigen::Vector3d& world_position) const {
    WorldFromDevice shifted = *this;
    shifted.translation = world_position - scale * (rotation * device_position);
    return shifted;
  }
};

}  // namespace argil::sculpt
