#include "fem/contact/obstacle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace argil::fem {
namespace {

Obstacle plane() {
  return {.id = 1, .shape = ObstacleShape::plane};
}
Obstacle sphere() {
  return {.id = 1, .shape = ObstacleShape::sphere, .size = {0.7, 0, 0}};
}
Obstacle box() {
  return {.id = 1, .shape = ObstacleShape::box, .size = {0.5, 0.3, 0.8}};
}
Obstacle capsule() {
  return {.id = 1, .shape = ObstacleShape::capsule, .size = {0.4, 0.6, 0}};
}

/// Points of the surface, `step` apart at most, made without the distance.
std::vector<Eigen::Vector3d> surface_of(const Obstacle& obstacle, double step) {
  std::vector<Eigen::Vector3d> points;
  const auto round = [&](double radius, double half) {
    const int n = static_cast<int>(std::ceil(M_PI * radius / step));
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j < 2 * n; ++j) {
        const double a = M_PI * i / n, b = M_PI * j / n;
        const Eigen::Vector3d on(radius * std::sin(a) * std::cos(b), radius * std::sin(a) * std::sin(b),
                                 radius * std::cos(a));
        points.emplace_back(on + Eigen::Vector3d(0, 0, on.z() < 0 ? -half : half));
        if (half > 0 && i == 0)
          for (double z = -half; z <= half; z += step)
            points.emplace_back(radius * std::cos(b), radius * std::sin(b), z);
      }
  };
  switch (obstacle.shape) {
    case ObstacleShape::plane:
      for (double x = -3; x <= 3; x += step)
        for (double y = -3; y <= 3; y += step) points.emplace_back(x, y, 0);
      break;
    case ObstacleShape::sphere:
      round(obstacle.size[0], 0);
      break;
    case ObstacleShape::capsule:
      round(obstacle.size[0], obstacle.size[1]);
      break;
    case ObstacleShape::box:
      for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0})
          for (double s = -1; s <= 1; s += step)
            for (double t = -1; t <= 1; t += step) {
              Eigen::Vector3d at;
              at[axis] = side * obstacle.size[axis];
              at[(axis + 1) % 3] = s * obstacle.size[(axis + 1) % 3];
              at[(axis + 2) % 3] = t * obstacle.size[(axis + 2) % 3];
              points.push_back(at);
            }
      break;
  }
  return points;
}

bool inside(const Obstacle& obstacle, const Eigen::Vector3d& x) {
  switch (obstacle.shape) {
    case ObstacleShape::plane:
      return x.z() < 0;
    case ObstacleShape::sphere:
      return x.norm() < obstacle.size[0];
    case ObstacleShape::box:
      return (x.cwiseAbs() - obstacle.size).maxCoeff() < 0;
    case ObstacleShape::capsule:
      return std::hypot(std::hypot(x.x(), x.y()), std::max(std::abs(x.z()) - obstacle.size[1], 0.0)) <
             obstacle.size[0];
  }
  return false;
}

TEST(Obstacle, DistanceIsThatOfTheNearestOfManyPointsOfTheSurface) {
  constexpr double k_step = 0.02;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1.4, 1.4);
  for (const Obstacle& obstacle : {plane(), sphere(), box(), capsule()}) {
    SCOPED_TRACE(word(obstacle.shape));
    const std::vector<Eigen::Vector3d> surface = surface_of(obstacle, k_step);
    for (int i = 0; i < 60; ++i) {
      const Eigen::Vector3d x(place(random), place(random), place(random));
      double nearest = 1e300;
      for (const Eigen::Vector3d& point : surface) nearest = std::min(nearest, (point - x).norm());
      const SignedDistance found = signed_distance(obstacle, x);
      EXPECT_EQ(found.distance < 0, inside(obstacle, x));
      EXPECT_LE(std::abs(found.distance), nearest + 1e-12);
      // A sample lies within a cell's half diagonal of the nearest place.
      EXPECT_NEAR(std::abs(found.distance), nearest, k_step);
    }
  }
}

TEST(Obstacle, NormalIsTheDistancesGradientAndLeadsToTheSurface) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1.4, 1.4);
  constexpr double k_eps = 1e-6;
  for (const Obstacle& obstacle : {plane(), sphere(), box(), capsule()}) {
    SCOPED_TRACE(word(obstacle.shape));
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d x(place(random), place(random), place(random));
      const SignedDistance found = signed_distance(obstacle, x);
      EXPECT_NEAR(found.normal.norm(), 1, 1e-14);
      EXPECT_NEAR(signed_distance(obstacle, x - found.distance * found.normal).distance, 0, 1e-14);
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d step = k_eps * Eigen::Vector3d::Unit(axis);
        const double slope =
            (signed_distance(obstacle, x + step).distance - signed_distance(obstacle, x - step).distance) /
            (2 * k_eps);
        // Curvature is at most some 10 here, but for places beside a middle, which the seed leaves out.
        EXPECT_NEAR(slope, found.normal[axis], 1e-8);
      }
    }
  }
}

TEST(Obstacle, EvenItsMiddleHasANormal) {
  for (const Obstacle& obstacle : {plane(), sphere(), box(), capsule()}) {
    const SignedDistance found = signed_distance(obstacle, Eigen::Vector3d::Zero());
    EXPECT_NEAR(found.normal.norm(), 1, 1e-15) << word(obstacle.shape);
    if (obstacle.shape == ObstacleShape::plane) continue;
    EXPECT_DOUBLE_EQ(-found.distance, largest_depth(obstacle)) << word(obstacle.shape);
  }
}

TEST(Obstacle, VelocityIsHowItsPointsMove) {
  Obstacle obstacle = box();
  obstacle.position = {0.3, -0.2, 1};
  obstacle.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, -1).normalized()));
  obstacle.velocity = {0.5, 0.1, -2};
  obstacle.angular_velocity = {3, -1, 2};
  obstacle.time = 2;
  constexpr double k_time = 2.35, k_eps = 1e-6;
  const Eigen::Vector3d own(0.4, 0.1, -0.6);
  const Eigen::Vector3d slope =
      (pose_at(obstacle, k_time + k_eps).world(own) - pose_at(obstacle, k_time - k_eps).world(own)) / (2 * k_eps);
  const ObstaclePose pose = pose_at(obstacle, k_time);
  EXPECT_LT((velocity_at(obstacle, k_time, pose.world(own)) - slope).norm(), 1e-8);
  EXPECT_LT((pose.own(pose.world(own)) - own).norm(), 1e-14);
  EXPECT_NEAR((pose.rotation.transpose() * pose.rotation - Eigen::Matrix3d::Identity()).norm(), 0, 1e-14);
}

}  // namespace
}  // namespace argil::fem
