#pragma once
// Between the frame of a device and the world: turn, scale and shift of positions; turn and scale of forces.

#include "sculpt/haptics/contact_model.h"
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

  /// The model that gives, in the device's frame, the force that it feels.
  ContactModel device_model(const ContactModel& world) const {
    const Eigen::Matrix3d turn = rotation.toRotationMatrix();
    ContactModel device = world;
    device.point = turn.transpose() * (world.point - translation) / scale;
    device.force = device_force(world.force);
    device.derivative = force_scale * scale * turn.transpose() * world.derivative * turn;
    for (std::size_t i = 0; i < world.plane_count; ++i) {
      const ContactPlane& plane = world.planes[i];
      device.planes[i].normal = turn.transpose() * plane.normal;
      device.planes[i].offset = (plane.offset - plane.normal.dot(translation)) / scale;
      device.planes[i].stiffness = force_scale * scale * plane.stiffness;
    }
    return device;
  }

  /// Clutch: the same mapping shifted so that the device, moved elsewhere meanwhile, is again at `world_position`.
  WorldFromDevice clutched(const Eigen::Vector3d& device_position, const Eigen::Vector3d& world_position) const {
    WorldFromDevice shifted = *this;
    shifted.translation = world_position - scale * (rotation * device_position);
    return shifted;
  }
};

}  // namespace argil::sculpt
