// Static solutions against REFERENCES.md.

#include <gmock/gmock.h>

#include "fem/loads.h"
#include "tests/fem/simulated_solid.h"

namespace argil::fem {
namespace {

using test::SimulatedSolid;

struct Cantilever {
  std::array<int, 3> cells{8, 2, 2};
  int level = 0;
  Space space = Space::standard;
  bool linear = true;
};

/// Displacement of the tip's centre under gravity (REFERENCES §1).
Eigen::Vector3d tip(const Cantilever& of) {
  SimulatedSolid solid(test::box(of.cells[0], of.cells[1], of.cells[2], {0.4, 0.1, 0.1}), of.level,
                       {1000, 0.3, 1.25, 0}, {of.space, 1}, of.linear);
  solid.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
  const Loads loads{gravity_forces(solid.discretization, {0, 0, -9.81}), {}};
  Integrator integrator(solid.system);
  integrator.solve_static(loads, solid.state, {});
  const Eigen::Vector3d centre(0.4, 0.05, 0.05);
  return position(locate(solid.discretization, centre).stencil, solid.state.positions) - centre;
}

TEST(Statics, CantileverOfTrilinearHexahedraIsThatOfTheReference) {
  // REFERENCES §1 gives five digits.
  EXPECT_NEAR(-tip({}).z(), 0.042414, 1e-6);
  EXPECT_NEAR(-tip({{16, 4, 4}}).z(), 0.046966, 1e-6);
}

TEST(Statics, CantileverComesCloserWithLevelAndSpace) {
  const double limit = 0.04910, hexahedra = 0.042414;
  const double level_one = -tip({{8, 2, 2}, 1}).z(), cubic = -tip({{8, 2, 2}, 0, Space::cubic}).z();
  EXPECT_LT(limit - level_one, 0.6 * (limit - hexahedra));
  EXPECT_GT(limit, level_one);
  EXPECT_LT(limit - cubic, 0.6 * (limit - level_one));
  EXPECT_GT(limit, cubic);
}

TEST(Statics, LargeDisplacementStaysNearTheNonlinearReference) {
  // 20-node hexahedra of the same mesh give 0.048003 with St. Venant–Kirchhoff; at 5 % of rotation the corotational
  // model differs by less than the mesh does.
  const Eigen::Vector3d found = tip({{16, 4, 4}, 0, Space::cubic, false});
  EXPECT_NEAR(-found.z(), 0.04866, 0.02 * 0.04866);
  EXPECT_NEAR(found.x(), -0.003318, 0.1 * 0.003318);  // of second order in the rotation, and slower to converge
}

TEST(Statics, StretchedCubeWithoutPoissonRatioHasForceOneHalf) {
  // REFERENCES §7 for the corotational model: stress E (λ − 1) per unit rest area, as R = 1.
  SimulatedSolid solid(test::box(2, 2, 2, {1, 1, 1}), 1, {1000, 0, 1, 0});
  solid.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9 || x.x() > 1 - 1e-9; });
  for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
    if (solid.rest(0, i) > 1 - 1e-9) solid.state.positions(0, i) = 1.5;
  Integrator integrator(solid.system);
  integrator.solve_static({}, solid.state, {});
  const Eigen::Matrix3Xd reaction = reactions(solid.system, {}, solid.state.positions);
  double force = 0;
  for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
    if (solid.rest(0, i) > 1 - 1e-9) force += reaction(0, i);
  EXPECT_NEAR(force, 500, 1e-4);  // equilibrium to 1e-8 of the reactions
}

TEST(Statics, SpringsHoldABodyAsPinsDo) {
  SimulatedSolid pinned(test::box(4, 1, 1, {0.4, 0.1, 0.1}), 1, {1000, 0.3, 1.25, 0});
  pinned.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
  SimulatedSolid sprung(test::box(4, 1, 1, {0.4, 0.1, 0.1}), 1, {1000, 0.3, 1.25, 0});
  Loads loads{gravity_forces(pinned.discretization, {0, 0, -9.81}), {}};
  Integrator of_pinned(pinned.system);
  of_pinned.solve_static(loads, pinned.state, {});
  for (Eigen::Index i = 0; i < sprung.rest.cols(); ++i)
    if (sprung.rest(0, i) < 1e-9)
      loads.springs.push_back({{static_cast<std::uint32_t>(i)}, {1.0}, sprung.rest.col(i), 1e6});
  Integrator of_sprung(sprung.system);
  of_sprung.solve_static(loads, sprung.state, {});
  // The penalty gives way by reaction / stiffness: moment 0.01 N m over 0.1 m, so 1e-7 m, times the bar's length
  // over its height.
  EXPECT_LE((sprung.state.positions - pinned.state.positions).cwiseAbs().maxCoeff(), 5e-6);
}

TEST(Statics, LargeLoadConvergesFromRest) {
  // Bends by more than a right angle: the whole load at once is far from where Newton converges fast.
  SimulatedSolid solid(test::box(10, 1, 1, {1, 0.1, 0.1}), 0, {1e6, 0, 1000, 0}, {Space::cubic, 1});
  solid.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
  const Loads loads{gravity_forces(solid.discretization, {0, 0, -20}), {}};
  Integrator integrator(solid.system);
  const StepReport report = integrator.solve_static(loads, solid.state, {});
  EXPECT_TRUE(report.converged);
  EXPECT_LT(report.residual, 1e-7);
  EXPECT_LT(solid.state.positions.row(2).minCoeff(), -0.6);
}

}  // namespace
}  // namespace argil::fem
