#pragma once
// Rigid obstacles that a body may lie on, slide along or be pushed by: a plane, and solid spheres, boxes and
// capsules. Each gives the signed distance of a point, the direction in which it grows, and how it moves there.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace argil::fem {

enum class ObstacleShape { plane, sphere, box, capsule };
[[nodiscard]] std::string_view word(ObstacleShape shape);

/// In its own frame a plane is z = 0 with the obstacle beneath it, and a capsule lies along z.
struct Obstacle {
  std::uint32_t id = 0;  // tells the obstacles of a body apart
  ObstacleShape shape = ObstacleShape::plane;
  /// [m] Sphere: its radius, twice unused. Box: half its edges. Capsule: its radius, half its axis, unused.
  Eigen::Vector3d size = Eigen::Vector3d::Zero();
  Eigen::Vector3d position =
      Eigen::Vector3d::Zero();  // [m], at `time`; of the middle, of a plane any of its points
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();  // of unit length; world from own frame
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();               // [m/s], of `position`
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();       // [rad/s], about `position`
  double time = 0;                                                  // [s]
  double friction = 0;                                              // Coulomb's coefficient, at rest and sliding
  double stiffness = 0;  // pressure a depth [Pa/m]; 0: by the rule of contact_surface.h
};

/// Where an obstacle is: world = position + rotation · own.
struct ObstaclePose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  [[nodiscard]] Eigen::Vector3d world(const Eigen::Vector3d& own) const { return position + rotation * own; }
  [[nodiscard]] Eigen::Vector3d own(const Eigen::Vector3d& world) const {
    return rotation.transpose() * (world - position);
  }
};
/// At a time, both velocities lasting.
[[nodiscard]] ObstaclePose pose_at(const Obstacle& obstacle, double time);
/// Of the obstacle's matter at a point in the world [m/s].
[[nodiscard]] Eigen::Vector3d velocity_at(const Obstacle& obstacle, double time, const Eigen::Vector3d& point);

/// Distance [m], negative inside, and its gradient, of unit length: the outward normal of the nearest surface
/// point. Inside a box that is its nearest face (of faces equally near the first of x, y, z), so that a point
/// deeper than the middle is sent out on the other side. The middle of a sphere and the axis of a capsule count as
/// if a little towards z, or x.
struct SignedDistance {
  double distance = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};
/// Of a point given in the obstacle's own frame; the normal is in it as well.
[[nodiscard]] SignedDistance signed_distance(const Obstacle& obstacle, const Eigen::Vector3d& own);

/// How deep a point can lie before it is sent out on another side than it came in by [m]; infinite for a plane.
[[nodiscard]] double largest_depth(const Obstacle& obstacle);

/// Where a straight way enters an obstacle, and the outward normal there; of an edge or corner of a box that of one
/// of its faces.
struct Entry {
  Eigen::Vector3d at = Eigen::Vector3d::Zero(), normal = Eigen::Vector3d::Zero();
};
/// Of a way in the obstacle's own frame: its first point of contact, or, from a beginning within and further in,
/// the surface point nearest to that. Nothing where it misses or leads out. By Newton's method on the distance,
/// which is convex: to 1e-9 of the size; at most 64 steps, after which a way that grazes counts as a miss.
[[nodiscard]] std::optional<Entry> first_touch(const Obstacle& obstacle, const Eigen::Vector3d& from,
                                               const Eigen::Vector3d& to);
/// As signed_distance(), of a point that came in by `entry`: while it is beneath the entry's plane and somewhere
/// along its normal the obstacle lies or lay above it, it is that deep under the plane, be it out on the other
/// side.
[[nodiscard]] SignedDistance signed_distance(const Obstacle& obstacle, const Entry& entry,
                                             const Eigen::Vector3d& own);

}  // namespace argil::fem
