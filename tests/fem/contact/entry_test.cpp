// Where a straight way enters an obstacle, against the roots of quadratic equations and slabs.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fem/contact/obstacle.h"

namespace argil::fem {
namespace {

Obstacle shape(ObstacleShape of, const Eigen::Vector3d& size) {
  Obstacle obstacle;
  obstacle.shape = of;
  obstacle.size = size;
  return obstacle;
}

TEST(FirstTouch, OfASphereIsTheSmallerRoot) {
  const Obstacle ball = shape(ObstacleShape::sphere, {0.3, 0, 0});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(-1, 1);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d from(at(random), at(random), at(random)), to(at(random), at(random), at(random));
    if (from.norm() < 0.3) continue;
    const Eigen::Vector3d way = to - from;
    const double a = way.squaredNorm(), b = from.dot(way), c = from.squaredNorm() - 0.09, d = b * b - a * c;
    const auto found = first_touch(ball, from, to);
    if (std::abs(d) < 1e-3 * a) continue;  // it grazes
    const double root = d > 0 ? (-b - std::sqrt(d)) / a : 2;
    ASSERT_EQ(found.has_value(), root > 0 && root < 1) << i;
    if (!found) continue;
    ++hits;
    EXPECT_LT((found->at - (from + root * way)).norm(), 1e-7);
    EXPECT_NEAR(found->normal.dot(found->at) / 0.3, 1, 1e-8);
  }
  EXPECT_GT(hits, 100);
}

TEST(FirstTouch, OfABoxIsThatOfItsSlabs) {
  const Eigen::Vector3d half(0.5, 0.3, 0.005);
  const Obstacle wall = shape(ObstacleShape::box, half);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-1, 1);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d from(at(random), at(random), at(random)), to(at(random), at(random), at(random));
    const Eigen::Vector3d way = to - from;
    double enter = -1, leave = 2;
    int axis = -1;
    for (int k = 0; k < 3; ++k) {
      const double t = (-std::copysign(half[k], way[k]) - from[k]) / way[k];
      if (t > enter) enter = t, axis = k;
      leave = std::min(leave, (std::copysign(half[k], way[k]) - from[k]) / way[k]);
    }
    if (enter < 0) continue;  // it begins within, or behind
    const bool meets = enter < leave && enter < 1;
    if (std::abs(enter - leave) < 1e-4) continue;
    const auto found = first_touch(wall, from, to);
    ASSERT_EQ(found.has_value(), meets) << i;
    if (!found) continue;
    ++hits;
    EXPECT_LT((found->at - (from + enter * way)).norm(), 1e-7);
    EXPECT_EQ(found->normal.cwiseAbs(), Eigen::Vector3d::Unit(axis)) << i;
    EXPECT_LT(found->normal.dot(way), 0);
  }
  EXPECT_GT(hits, 100);
}

TEST(FirstTouch, FromWithinCountsOnlyFurtherIn) {
  const Obstacle wall = shape(ObstacleShape::box, {0.5, 0.5, 0.005});
  const Eigen::Vector3d within(0, 0, 0.004);
  const auto in = first_touch(wall, within, within - Eigen::Vector3d(0, 0, 1));
  ASSERT_TRUE(in);
  EXPECT_NEAR(in->at.z(), 0.005, 1e-15);
  EXPECT_EQ(in->normal, Eigen::Vector3d::UnitZ());
  EXPECT_FALSE(first_touch(wall, within, within + Eigen::Vector3d(0, 0, 1)));
  EXPECT_FALSE(first_touch(wall, within, within));
}

TEST(DistanceFromAnEntry, GrowsBeyondTheMiddleAndEndsBesideTheObstacle) {
  const Obstacle wall = shape(ObstacleShape::box, {0.5, 0.5, 0.005});
  const Entry top{{0, 0, 0.005}, Eigen::Vector3d::UnitZ()};
  for (const double z : {0.004, 0.0, -0.004, -0.1, -2.0}) {
    const SignedDistance found = signed_distance(wall, top, {0.3, 0.1, z});
    EXPECT_NEAR(found.distance, z - 0.005, 1e-15);
    EXPECT_EQ(found.normal, Eigen::Vector3d::UnitZ());
  }
  EXPECT_GT(signed_distance(wall, top, {0.6, 0.1, -0.1}).distance, 0);
  EXPECT_GT(signed_distance(wall, top, {0.3, 0.1, 0.1}).distance, 0);
  const Obstacle rod = shape(ObstacleShape::capsule, {0.1, 0.4, 0});
  const Entry side{{0.1, 0, 0.2}, Eigen::Vector3d::UnitX()};
  EXPECT_NEAR(signed_distance(rod, side, {-0.5, 0.05, 0.45}).distance, -0.6, 1e-15);
  EXPECT_GT(signed_distance(rod, side, {-0.5, 0.05, 0.6}).distance, 0);
  EXPECT_GT(signed_distance(rod, side, {-0.5, 0.15, 0}).distance, 0);
}

}  // namespace
}  // namespace argil::fem
