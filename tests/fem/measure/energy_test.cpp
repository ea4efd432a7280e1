#include "fem/measure/energy.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/fem/simulated_solid.h"

namespace argil::fem {
namespace {

TEST(Energy, RigidMotionHasTheEnergyAndMomentumOfARigidBox) {
  const Eigen::Vector3d size(0.4, 0.2, 0.1), centre = size / 2, velocity(1, -2, 0.5), spin(0.3, -0.4, 2);
  test::SimulatedSolid solid(test::box(4, 2, 1, size), 1, {1000, 0.3, 500, 0});
  for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
    solid.state.velocities.col(i) = velocity + spin.cross(solid.rest.col(i) - centre);
  const double mass = 500 * size.prod();
  const Eigen::Vector3d inertia =
      mass / 12 *
      Eigen::Vector3d(size.y() * size.y() + size.z() * size.z(), size.x() * size.x() + size.z() * size.z(),
                      size.x() * size.x() + size.y() * size.y());
  const Energy found = energy(solid.system, solid.state);
  // A velocity that is affine in the control points is so in the body, hence all integrals are exact.
  EXPECT_NEAR(found.kinetic, 0.5 * mass * velocity.squaredNorm() + 0.5 * spin.dot(inertia.cwiseProduct(spin)),
              1e-12 * mass);
  EXPECT_NEAR(found.elastic, 0, 1e-20);
  const Momentum kept = momentum(solid.system, solid.state);
  EXPECT_LE((kept.linear - mass * velocity).norm(), 1e-12 * mass);
  EXPECT_LE((kept.angular - mass * centre.cross(velocity) - inertia.cwiseProduct(spin)).norm(), 1e-12 * mass);
}

}  // namespace
}  // namespace argil::fem
