#include "fem/measure/energy.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>

#include "fem/loads.h"
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

TEST(Wrench, OfReactionsBalancesForceAndMomentOfTheWeight) {
  const Eigen::Vector3d size(0.4, 0.1, 0.1);
  test::SimulatedSolid solid(test::box(4, 1, 1, size), 1, {1e5, 0.3, 500, 0});
  solid.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
  Loads loads;
  loads.forces = gravity_forces(solid.discretization, {0, 0, -9.81});
  Integrator integrator(solid.system);
  (void)integrator.solve_static(loads, solid.state, {});
  const Wrench held = wrench(reactions(solid.system, loads, solid.state.positions), solid.state.positions);
  const Wrench weight = wrench(loads.forces, solid.state.positions);
  // Equilibrium is found to 1e-8 of the loads.
  EXPECT_LT((held.force + weight.force).norm(), 1e-6 * weight.force.norm());
  EXPECT_LT((held.moment + weight.moment).norm(), 1e-6 * weight.moment.norm());
  EXPECT_NEAR(weight.force.z(), -9.81 * solid.discretization.total_mass, 1e-9);
  EXPECT_GT(weight.moment.y(), 0.15 * 9.81 * solid.discretization.total_mass);
}

TEST(Energy, OfLoadsIsMinusTheWorkThatTheyHaveDone) {
  test::SimulatedSolid solid(test::box(2, 1, 1, {0.2, 0.1, 0.1}), 1, {1e5, 0.3, 500, 0});
  Loads loads;
  loads.forces = gravity_forces(solid.discretization, {0, 0, -9.81});
  solid.state.positions.row(2).array() -= 0.3;
  EXPECT_NEAR(load_potential(loads, solid.rest, solid.state.positions),
              -9.81 * 0.3 * solid.discretization.total_mass, 1e-12);
  const AnchorSpring spring{
      {0, 1},
      {0.25, 0.75},
      held_point({{0, 1}, {0.25, 0.75}}, solid.state.positions) + Eigen::Vector3d(0.3, 0, 0.4),
      20};
  EXPECT_NEAR(spring_energy(std::array{spring}, solid.state.positions), 0.5 * 20 * 0.25, 1e-12);
  EXPECT_NEAR(wrench(std::array{spring}, solid.state.positions).force.z(), 8, 1e-12);
}

}  // namespace
}  // namespace argil::fem
