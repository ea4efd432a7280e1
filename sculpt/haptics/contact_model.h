#pragma once
// What the simulation tells the servo, which runs faster than it: the force on the device near a point, its
// derivative, and the planes of contacts before they touch. Never a force alone to be held: at 60 steps a second a
// held force of 1000 N/m makes energy, planes sent ahead do not (a test shows both).

#include <array>
#include <cstddef>

#include "sculpt/haptics/device.h"
#include "sculpt/haptics/latest_channel.h"

namespace argil::sculpt {

/// A wall: points x with normal·x < offset are inside it and pushed out along the normal.
struct ContactPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // of length 1, out of the obstacle
  double offset = 0;                                  // [m]
  double stiffness = 0;                               // [N/m], >= 0
};

/// In world coordinates. Planes carry contacts, `force` and `derivative` all the rest.
struct ContactModel {
  static constexpr std::size_t k_max_planes = 8;

  Eigen::Vector3d point = Eigen::Vector3d::Zero();       // [m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero();       // at the point [N]
  Eigen::Matrix3d derivative = Eigen::Matrix3d::Zero();  // d force / d position [N/m]
  std::array<ContactPlane, k_max_planes> planes;
  std::size_t plane_count = 0;
  Tick valid_until = 0;
};

/// force + derivative (x − point) + Σ planes stiffness · depth · normal [N].
[[nodiscard]] Eigen::Vector3d contact_force(const ContactModel& model, const Eigen::Vector3d& position);

/// From the simulation to the servo.
using ContactChannel = LatestChannel<ContactModel>;

}  // namespace argil::sculpt
