#include "fem/contact/obstacle.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace argil::fem {

namespace {

/// Distance from a middle, with a direction where there is none.
SignedDistance from_middle(const Eigen::Vector3d& offset, double radius, const Eigen::Vector3d& otherwise) {
  const double length = std::sqrt(offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]);
  return {length - radius, length > 0 ? Eigen::Vector3d(offset / length) : otherwise};
}

SignedDistance from_box(const Eigen::Vector3d& half, const Eigen::Vector3d& own) {
  Eigen::Vector3d over, outside;
  for (int i = 0; i < 3; ++i) {
    over[i] = std::abs(own[i]) - half[i];
    outside[i] = std::copysign(std::max(over[i], 0.0), own[i]);
  }
  if (over[0] > 0 || over[1] > 0 || over[2] > 0) return from_middle(outside, 0, Eigen::Vector3d::UnitZ());
  int nearest = 0;
  for (int i = 1; i < 3; ++i)
    if (over[i] > over[nearest]) nearest = i;
  SignedDistance result{over[nearest], Eigen::Vector3d::Zero()};
  result.normal[nearest] = std::copysign(1.0, own[nearest]);
  return result;
}

}  // namespace

std::string_view word(ObstacleShape shape) {
  switch (shape) {
    case ObstacleShape::plane:
      return "plane";
    case ObstacleShape::sphere:
      return "sphere";
    case ObstacleShape::box:
      return "box";
    case ObstacleShape::capsule:
      return "capsule";
  }
  return "";
}

ObstaclePose pose_at(const Obstacle& obstacle, double time) {
  const double passed = time - obstacle.time;
  ObstaclePose pose{obstacle.position + passed * obstacle.velocity, obstacle.orientation.toRotationMatrix()};
  const Eigen::Vector3d& w = obstacle.angular_velocity;
  const double rate = std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
  if (rate > 0) pose.rotation = Eigen::AngleAxisd(rate * passed, w / rate).toRotationMatrix() * pose.rotation;
  return pose;
}

Eigen::Vector3d velocity_at(const Obstacle& obstacle, double time, const Eigen::Vector3d& point) {
  const Eigen::Vector3d arm = point - (obstacle.position + (time - obstacle.time) * obstacle.velocity);
  return obstacle.velocity + obstacle.angular_velocity.cross(arm);
}

SignedDistance signed_distance(const Obstacle& obstacle, const Eigen::Vector3d& own) {
  switch (obstacle.shape) {
    case ObstacleShape::plane:
      return {own.z(), Eigen::Vector3d::UnitZ()};
    case ObstacleShape::sphere:
      return from_middle(own, obstacle.size[0], Eigen::Vector3d::UnitZ());
    case ObstacleShape::box:
      return from_box(obstacle.size, own);
    case ObstacleShape::capsule: {
      const double half = obstacle.size[1];
      const Eigen::Vector3d offset(own.x(), own.y(), own.z() - std::clamp(own.z(), -half, half));
      return from_middle(offset, obstacle.size[0], Eigen::Vector3d::UnitX());
    }
  }
  return {std::numeric_limits<double>::infinity(), Eigen::Vector3d::UnitZ()};
}

double largest_depth(const Obstacle& obstacle) {
  switch (obstacle.shape) {
    case ObstacleShape::plane:
      return std::numeric_limits<double>::infinity();
    case ObstacleShape::sphere:
    case ObstacleShape::capsule:
      return obstacle.size[0];
    case ObstacleShape::box:
      return std::min({obstacle.size[0], obstacle.size[1], obstacle.size[2]});
  }
  return 0;
}

namespace {

/// The normal of an entry: of a box always that of a face.
Eigen::Vector3d entry_normal(const Obstacle& obstacle, const Eigen::Vector3d& normal) {
  if (obstacle.shape != ObstacleShape::box) return normal;
  int most = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(normal[i]) > std::abs(normal[most])) most = i;
  Eigen::Vector3d result = Eigen::Vector3d::Zero();
  result[most] = std::copysign(1.0, normal[most]);
  return result;
}

double along(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Whether the obstacle, seen along a direction, covers the point.
bool covers(const Obstacle& obstacle, const Eigen::Vector3d& direction, const Eigen::Vector3d& own) {
  if (obstacle.shape == ObstacleShape::plane) return true;
  if (obstacle.shape == ObstacleShape::box) {
    for (int i = 0; i < 3; ++i)
      if (direction[i] == 0 && std::abs(own[i]) > obstacle.size[i]) return false;
    return true;
  }
  // The shadow of the axis, which is a point for a sphere.
  const Eigen::Vector3d across = own - along(own, direction) * direction;
  const double half = obstacle.shape == ObstacleShape::capsule ? obstacle.size[1] : 0;
  const Eigen::Vector3d axis =
      half * (Eigen::Vector3d::UnitZ() - direction.z() * direction);  // from the middle to one end
  const double square = along(axis, axis);
  const double at = square > 0 ? std::clamp(along(across, axis) / square, -1.0, 1.0) : 0;
  const Eigen::Vector3d offset = across - at * axis;
  return along(offset, offset) < obstacle.size[0] * obstacle.size[0];
}

}  // namespace

std::optional<Entry> first_touch(const Obstacle& obstacle, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  constexpr int k_steps = 64;
  const Eigen::Vector3d way = to - from;
  const double length = std::sqrt(along(way, way));
  if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
  SignedDistance there = signed_distance(obstacle, from);
  if (there.distance <= 0) {
    const Eigen::Vector3d normal = entry_normal(obstacle, there.normal);
    if (along(way, normal) >= 0) return std::nullopt;
    return Entry{from - there.distance * there.normal, normal};
  }
  const double close =
      1e-9 * (obstacle.shape == ObstacleShape::plane ? length : std::min(length, largest_depth(obstacle)));
  double gone = 0;
  for (int step = 0; step < k_steps; ++step) {
    // The distance from a convex shape is convex along the way: Newton's steps do not go past its first zero.
    const double slope = along(there.normal, way) / length;
    if (slope >= 0) return std::nullopt;
    gone -= there.distance / slope;
    if (gone > length) return std::nullopt;
    const Eigen::Vector3d at = from + (gone / length) * way;
    there = signed_distance(obstacle, at);
    if (there.distance > close) continue;
    return Entry{at, entry_normal(obstacle, there.normal)};
  }
  return std::nullopt;
}

SignedDistance signed_distance(const Obstacle& obstacle, const Entry& entry, const Eigen::Vector3d& own) {
  const double depth = along(entry.at - own, entry.normal);
  if (depth > 0 && covers(obstacle, entry.normal, own)) return {-depth, entry.normal};
  return signed_distance(obstacle, own);
}

}  // namespace argil::fem
