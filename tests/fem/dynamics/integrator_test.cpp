#include "fem/dynamics/integrator.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>
#include <Eigen/Dense>

#include <cmath>
#include <cstring>
#include <numbers>

#include "fem/loads.h"
#include "fem/measure/energy.h"
#include "fem/solvers/solver_choice.h"
#include "subdiv/error.h"
#include "tests/fem/dynamics/tight_steps.h"
#include "tests/fem/simulated_solid.h"
#include "tests/fem/spring_model.h"

namespace argil::fem {
namespace {

using test::SimulatedSolid;
using test::tight;

bool same_bits(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return a.cols() == b.cols() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

/// Error of an oscillating mass against cos ωt at a time when its cosine and sine are both large.
double oscillator_error(Method method, int steps) {
  test::SpringBody body(1.0, 4.0, 1.0);  // ω = 2
  body.state.positions(0, 1) = 1.1;
  Integrator integrator(body.system);
  const double duration = 1.25 * std::numbers::pi + 0.4;
  for (int i = 0; i < steps; ++i) integrator.step({}, body.state, duration / steps, tight(method));
  return std::abs(body.state.positions(0, 1) - (1 + 0.1 * std::cos(2 * duration)));
}

TEST(Integrator, Bdf2IsSecondOrderAndImplicitEulerFirst) {
  const double bdf2 = std::log2(oscillator_error(Method::bdf2, 400) / oscillator_error(Method::bdf2, 800));
  const double euler =
      std::log2(oscillator_error(Method::implicit_euler, 1600) / oscillator_error(Method::implicit_euler, 3200));
  EXPECT_NEAR(bdf2, 2.0, 0.1);  // the error's next term is about Δt of the first, some 5 %
  EXPECT_NEAR(euler, 1.0, 0.1);
}

TEST(Integrator, FirstStepAndChangedStepAreImplicitEuler) {
  test::SpringBody one(1.0, 4.0, 1.0), other(1.0, 4.0, 1.0);
  one.state.positions(0, 1) = other.state.positions(0, 1) = 1.3;
  Integrator a(one.system), b(other.system);
  a.step({}, one.state, 0.1, tight(Method::bdf2));
  b.step({}, other.state, 0.1, tight(Method::implicit_euler));
  EXPECT_TRUE(same_bits(one.state.positions, other.state.positions));
  a.step({}, one.state, 0.05, tight(Method::bdf2));
  b.step({}, other.state, 0.05, tight(Method::implicit_euler));
  EXPECT_TRUE(same_bits(one.state.positions, other.state.positions));
  a.step({}, one.state, 0.05, tight(Method::bdf2));
  b.step({}, other.state, 0.05, tight(Method::implicit_euler));
  EXPECT_FALSE(same_bits(one.state.positions, other.state.positions));
}

TEST(Integrator, FreeFallIsExactInVelocity) {
  SimulatedSolid solid(test::box(2, 2, 2, {0.2, 0.2, 0.2}), 1);
  const Eigen::Vector3d g(0, 0, -9.81);
  Loads loads{gravity_forces(solid.discretization, g), {}};
  Integrator integrator(solid.system);
  for (int i = 0; i < 10; ++i) integrator.step(loads, solid.state, 0.01, tight());
  // Implicit Euler and BDF2 both integrate a constant acceleration exactly in velocity.
  for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
    EXPECT_LE((solid.state.velocities.col(i) - 0.1 * g).norm(), 1e-9);
}

TEST(Integrator, LinearMomentumIsKept) {
  SimulatedSolid solid(test::box(3, 2, 2, {0.3, 0.2, 0.2}), 1, {1e4, 0.3, 100, 0});
  for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
    solid.state.velocities.col(i) =
        Eigen::Vector3d(0.3, -0.2, 0.5) +
        2.0 * Eigen::Vector3d(std::sin(7.0 * static_cast<double>(i)), 0, std::cos(3.0 * static_cast<double>(i)));
  const Eigen::Vector3d start = momentum(solid.system, solid.state).linear;
  Integrator integrator(solid.system);
  for (int i = 0; i < 20; ++i) integrator.step({}, solid.state, 1.0 / 60, tight());
  // Internal forces sum to zero to rounding; what is left is the tolerance of Newton's method.
  EXPECT_LE((momentum(solid.system, solid.state).linear - start).norm(), 1e-9 * start.norm());
}

TEST(Integrator, PinsDoNotMoveAndReactionsBalanceTheLoad) {
  SimulatedSolid solid(test::box(4, 1, 1, {0.4, 0.1, 0.1}), 1, {1000, 0.3, 1.25, 0});
  solid.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
  const Eigen::Vector3d g(0, 0, -9.81);
  Loads loads{gravity_forces(solid.discretization, g), {}};
  Integrator integrator(solid.system);
  for (int i = 0; i < 5; ++i) integrator.step(loads, solid.state, 1.0 / 60, {});
  EXPECT_GT((solid.state.positions - solid.rest).norm(), 1e-3);
  integrator.solve_static(loads, solid.state, {});
  for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
    if (solid.system.fixed[static_cast<std::size_t>(i)]) {
      EXPECT_EQ(solid.state.positions.col(i), solid.rest.col(i));
    }
  const Eigen::Matrix3Xd reaction = reactions(solid.system, loads, solid.state.positions);
  const double weight = solid.discretization.total_mass * 9.81;
  // Equilibrium to 1e-8 of the load in every free point.
  EXPECT_LE((reaction.rowwise().sum() - Eigen::Vector3d(0, 0, weight)).norm(), 1e-6 * weight);
}

TEST(Integrator, UndoGivesTheSameBits) {
  SimulatedSolid solid(test::box(3, 1, 1, {0.3, 0.1, 0.1}), 1, {1000, 0.3, 1.25, 0.5});
  solid.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
  Loads loads{gravity_forces(solid.discretization, {0, 0, -9.81}), {}};
  Integrator integrator(solid.system);
  integrator.step(loads, solid.state, 1.0 / 60, {});
  const BodyState kept = solid.state;
  const auto run = [&](Integrator& by) {
    BodyState state = kept;
    for (int i = 0; i < 3; ++i) by.step(loads, state, 1.0 / 60, {});
    by.step(loads, state, 1.0 / 120, {});
    return state;
  };
  const BodyState first = run(integrator), again = run(integrator);
  Integrator fresh(solid.system);
  const BodyState other = run(fresh);
  EXPECT_TRUE(same_bits(first.positions, again.positions) && same_bits(first.velocities, again.velocities));
  EXPECT_TRUE(same_bits(first.positions, other.positions) && same_bits(first.velocities, other.velocities));
}

TEST(Integrator, ThreadsDoNotChangeBits) {
  SimulatedSolid solid(test::box(4, 4, 4, {0.4, 0.4, 0.4}), 2, {1000, 0.3, 1.25, 0});
  solid.fix([](const Eigen::Vector3d& x) { return x.z() < 1e-9; });
  Loads loads{gravity_forces(solid.discretization, {3, 0, -9.81}), {}};
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Integrator integrator(solid.system);
    BodyState state = solid.state;
    for (int i = 0; i < 2; ++i) integrator.step(loads, state, 1.0 / 60, {});
    return state;
  };
  EXPECT_TRUE(same_bits(run(1).positions, run(2).positions));
}

TEST(Integrator, OtherPinsAndMaterialsAreAsInAFreshIntegrator) {
  SimulatedSolid solid(test::box(3, 1, 1, {0.3, 0.1, 0.1}), 1, {1000, 0.3, 1.25, 0});
  const Loads loads{gravity_forces(solid.discretization, {0, 0, -9.81}), {}};
  Integrator kept(solid.system);
  BodyState before = solid.state;
  kept.step(loads, before, 1.0 / 60, {});

  solid.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
  solid.fields.young_modulus *= 3;
  ASSERT_TRUE(update_fields(solid.discretization, solid.refinement, solid.fields));
  solid.model = make_corotational(solid.discretization.blocks, solid.discretization.rest_nodes);
  // The integrator sees the model through its system, so a new model means a new integrator; pins and arrays do
  // not.
  solid.system.model = solid.model.get();
  Integrator fresh(solid.system), repinned(solid.system);
  repinned.set_fixed(std::vector<std::uint8_t>(solid.system.fixed.size(), 0));
  BodyState a = solid.state, b = solid.state;
  repinned.step(loads, b, 1.0 / 60, {});
  EXPECT_FALSE(same_bits(b.positions, before.positions));
  repinned.set_fixed(solid.system.fixed);
  repinned.materials_changed();
  b = solid.state;
  for (int i = 0; i < 2; ++i) {
    fresh.step(loads, a, 1.0 / 60, {});
    repinned.step(loads, b, 1.0 / 60, {});
  }
  EXPECT_TRUE(same_bits(a.positions, b.positions));
}

TEST(Integrator, ManyUnknownsTakeJacobi) {
  SimulatedSolid solid(test::box(12, 9, 9, {0.12, 0.09, 0.09}), 0, {1e4, 0.3, 1000, 0});
  solid.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
  ASSERT_GT(3 * solid.system.rows->column_count, k_largest_factor);
  const Loads loads{gravity_forces(solid.discretization, {0, 0, -9.81}), {}};
  Integrator integrator(solid.system);
  const StepReport report = integrator.step(loads, solid.state, 1.0 / 60, {});
  EXPECT_EQ(report.preconditioner, PreconditionerKind::jacobi);
  EXPECT_TRUE(report.converged);
  EXPECT_GT(report.linear_iterations, 10);
}

TEST(Integrator, SpringDrawsTheBodyToItsTarget) {
  SimulatedSolid solid(test::box(2, 2, 2, {0.2, 0.2, 0.2}), 1, {1e5, 0.3, 100, 5});
  const SurfacePatch surface = whole_surface(solid.discretization, solid.refinement.solid());
  const PointStencil grip =
      brush_stencil(solid.discretization, surface, solid.discretization.rest_nodes, {{0.1, 0.1, 0.2}, 0.08});
  const Eigen::Vector3d target = position(grip, solid.rest) + Eigen::Vector3d(0, 0, 0.05);
  const Loads loads{{}, {anchor_spring(grip, target, 1e5)}};
  Integrator integrator(solid.system);
  for (int i = 0; i < 200; ++i) integrator.step(loads, solid.state, 1.0 / 60, {});
  // Nothing else holds the body, so at rest the whole of it hangs where the spring pulls it, without force.
  EXPECT_LE((position(grip, solid.state.positions) - target).norm(), 1e-4);
}

TEST(Integrator, RefusesWhatHasNoAnswerAndLeavesTheState) {
  SimulatedSolid solid(test::box(2, 1, 1, {0.2, 0.1, 0.1}), 1);
  Integrator integrator(solid.system);
  const Loads loads{gravity_forces(solid.discretization, {0, 0, -9.81}), {}};
  try {
    integrator.solve_static(loads, solid.state, {});
    FAIL() << "an unpinned body has no equilibrium under gravity";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_THAT(error.what(), testing::HasSubstr("Pin at least three points"));
  }
  // Pinned along one line, the body still turns about it.
  SimulatedSolid hinged(test::box(2, 1, 1, {0.2, 0.1, 0.1}), 1);
  hinged.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9 && x.z() < 1e-9; });
  Integrator hinge(hinged.system);
  EXPECT_THROW(hinge.solve_static(loads, hinged.state, {}), Error);

  Loads broken = loads;
  broken.forces(0, 0) = std::nan("");
  const BodyState before = solid.state;
  EXPECT_THROW(integrator.step(broken, solid.state, 1.0 / 60, {}), Error);
  EXPECT_TRUE(same_bits(before.positions, solid.state.positions));
  EXPECT_EQ(solid.state.previous_step, 0);
  EXPECT_THROW(integrator.step(loads, solid.state, 0, {}), Error);
}

TEST(Integrator, RecoversFromAMirroredStart) {
  SimulatedSolid solid(test::box(2, 2, 2, {0.2, 0.2, 0.2}), 1, {1e4, 0.3, 100, 5});
  solid.fix([](const Eigen::Vector3d& x) { return x.z() < 1e-9; });
  solid.state.positions.row(2) *= -0.5;
  Integrator integrator(solid.system);
  for (int i = 0; i < 60; ++i) {
    integrator.step({}, solid.state, 1.0 / 60, {});
    ASSERT_TRUE(solid.state.positions.allFinite());
  }
}

}  // namespace
}  // namespace argil::fem
