#include "fem/solvers/solver_choice.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "fem/loads.h"
#include "fem/solvers/mass_factor.h"
#include "fem/solvers/pcg.h"
#include "fem/solvers/supernodal.h"
#include "subdiv/error.h"
#include "tests/fem/simulated_solid.h"

namespace argil::fem {
namespace {

using test::SimulatedSolid;

TEST(SolverChoice, FollowsItsRule) {
  const PreconditionerKind hard = has_supernodal() ? PreconditionerKind::supernodal : PreconditionerKind::jacobi;
  constexpr double k_infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(choose_solver({3000, 1e6, k_infinite}), PreconditionerKind::factor);
  EXPECT_EQ(choose_solver({3003, 1, 1}), PreconditionerKind::jacobi);
  EXPECT_EQ(choose_solver({3003, 101, 1}), hard);
  EXPECT_EQ(choose_solver({3003, 1, 1.01 * k_largest_stiffness_number}), hard);
  EXPECT_EQ(choose_solver({3003, 1, k_infinite}), hard);
  EXPECT_THAT(solver_rule(), testing::HasSubstr("3000"));
}

TEST(SolverChoice, ReadsItsInputsFromTheSystem) {
  SimulatedSolid solid(test::box(6, 2, 2, {0.6, 0.2, 0.2}), 0, {1e5, 0.3, 1000, 0});
  EXPECT_NEAR(stiffness_contrast(solid.system), 1, 1e-12);
  for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
    if (solid.rest(0, i) > 0.25) solid.fields.young_modulus[i] *= 50;
  ASSERT_TRUE(update_fields(solid.discretization, solid.refinement, solid.fields));
  // The quadrature points of the cells between lie inside, so that some see nearly one value, some the other.
  EXPECT_NEAR(stiffness_contrast(solid.system), 50, 1e-9);
  const RestOperator rest = rest_operator(solid.system, false);
  const std::vector<std::uint8_t> free(solid.system.fixed.size(), 1);
  const double once = stiffness_number(solid.system, rest, 1e-4, free);
  EXPECT_NEAR(stiffness_number(solid.system, rest, 4e-4, free), 4 * once, 1e-9 * once);
  EXPECT_EQ(stiffness_number(solid.system, rest, 0, free), std::numeric_limits<double>::infinity());
  // In a uniform grid K_ii/M_ii is some 6 E/(ρ h²) of trilinear hexahedra.
  SimulatedSolid uniform(test::box(6, 6, 6, {0.6, 0.6, 0.6}), 0, {1e5, 0.3, 1000, 0});
  const std::vector<std::uint8_t> all(uniform.system.fixed.size(), 1);
  const double number = stiffness_number(uniform.system, rest_operator(uniform.system, false), 1e-2, all);
  EXPECT_GT(number, 1e-2 * 1e5 / (1000 * 0.01));
  EXPECT_LT(number, 20 * 1e-2 * 1e5 / (1000 * 0.01));
}

TEST(Supernodal, SolvesTheRestProblemAtOnceWithTheSameBitsEachTime) {
  if (!has_supernodal()) GTEST_SKIP() << "this build has no CHOLMOD";
  SimulatedSolid solid(test::box(6, 3, 3, {2, 1, 1}), 1, {1e3, 0.4, 1, 0});
  solid.fix([](const Eigen::Vector3d& x) { return x.z() < 1e-9; });
  const RestOperator rest = rest_operator(solid.system, true);
  std::vector<std::uint8_t> free;
  for (const std::uint8_t fixed : solid.system.fixed) free.push_back(fixed ? 0 : 1);
  const Eigen::SparseMatrix<double> inertia = solid.discretization.mass * 1e2;
  const auto tangent = solid.model->tangent(solid.discretization.rest_nodes, Projection::none);
  const LinearOperator matrix = [&](const Eigen::Matrix3Xd& d, Eigen::Matrix3Xd& result) {
    Eigen::Matrix3Xd forces;
    tangent->stiffness_product(nodes(solid.system, d), forces);
    result = generalised_forces(solid.system, forces) + d * inertia;
    for (Eigen::Index i = 0; i < result.cols(); ++i)
      if (!free[static_cast<std::size_t>(i)]) result.col(i).setZero();
  };
  Eigen::Matrix3Xd right = Eigen::Matrix3Xd::Zero(3, solid.rest.cols()), solution, z, again;
  for (Eigen::Index i = 0; i < right.cols(); ++i)
    if (free[static_cast<std::size_t>(i)]) right.col(i) << std::sin(1.0 * static_cast<double>(i)), 1, -0.5;
  const auto preconditioner = make_preconditioner(PreconditionerKind::supernodal, rest, inertia, {}, free);
  ASSERT_EQ(preconditioner->kind(), PreconditionerKind::supernodal);
  const LinearOutcome outcome = pcg(matrix, *preconditioner, right, solution, 1e-8, 500);
  EXPECT_TRUE(outcome.converged);
  EXPECT_LE(outcome.iterations, 2);  // the shift of the diagonal is 1e-10 of it
  // Springs that are not in the factor cost an iteration or two each.
  const auto other = make_supernodal(rest, inertia, free);
  ASSERT_NE(other, nullptr);
  preconditioner->apply(right, z);
  other->apply(right, again);
  EXPECT_EQ(z, again);
}

TEST(Supernodal, ABodyThatNothingHoldsHasNone) {
  const SimulatedSolid solid(test::box(2, 2, 2, {1, 1, 1}), 1);
  const RestOperator rest = rest_operator(solid.system, true);
  const std::vector<std::uint8_t> free(solid.system.rows->column_count, 1);
  const auto preconditioner = make_preconditioner(PreconditionerKind::supernodal, rest, {}, {}, free);
  Eigen::Matrix3Xd r = Eigen::Matrix3Xd::Ones(3, solid.rest.cols()), z;
  preconditioner->apply(r, z);
  EXPECT_TRUE(z.allFinite());
}

/// A cantilever of more than 3000 unknowns, half of it 1000 times as stiff, stepped and solved.
TEST(Supernodal, IsTakenForContrastAndAgreesWithJacobi) {
  SimulatedSolid solid(test::box(30, 6, 6, {0.3, 0.06, 0.06}), 0, {1e4, 0.3, 1000, 0});
  for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
    if (solid.rest(0, i) < 0.145) solid.fields.young_modulus[i] *= 1000;
  ASSERT_TRUE(update_fields(solid.discretization, solid.refinement, solid.fields));
  solid.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
  ASSERT_GT(3 * solid.system.rows->column_count, k_largest_factor);
  Loads loads{gravity_forces(solid.discretization, {0, 0, -9.81}), {}};
  const auto tip = static_cast<std::uint32_t>(solid.rest.cols() - 1);
  loads.springs.push_back({{tip}, {1.0}, solid.rest.col(tip) + Eigen::Vector3d(0, 0.01, 0), 5});
  StepOptions options;
  options.newton_cap = 10;
  options.newton_tolerance = 1e-7;
  options.linear_tolerance = 1e-7;
  const auto run = [&](bool with_blocks) {
    System system = solid.system;
    if (!with_blocks) system.blocks = {};  // then nothing is known of the contrast
    Integrator integrator(system);
    BodyState state = solid.state;
    StepReport report;
    for (int i = 0; i < 2; ++i) report = integrator.step(loads, state, 1.0 / 240, options);
    return std::pair(report, state);
  };
  const auto [jacobi, slow] = run(false);
  const auto [factor, fast] = run(true);
  EXPECT_EQ(jacobi.preconditioner, PreconditionerKind::jacobi);
  EXPECT_EQ(factor.preconditioner, has_supernodal() ? PreconditionerKind::supernodal : PreconditionerKind::jacobi);
  if (has_supernodal()) {
    EXPECT_LT(5 * factor.linear_iterations, jacobi.linear_iterations);
  }
  // Both to 1e-7 of residuals that the stiff half dominates.
  EXPECT_LE((slow.positions - fast.positions).norm(), 1e-3 * (fast.positions - solid.rest).norm());
}

TEST(RestOperatorInParallel, ThreadsDoNotChangeBits) {
  const SimulatedSolid solid(test::box(5, 4, 3, {5, 4, 3}), 1);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return rest_operator(solid.system, true);
  };
  const RestOperator one = run(1), two = run(2), diagonal = rest_operator(solid.system, false);
  ASSERT_EQ(one.stiffness.nonZeros(), two.stiffness.nonZeros());
  EXPECT_EQ(Eigen::VectorXd(one.stiffness.coeffs()), Eigen::VectorXd(two.stiffness.coeffs()));
  // A step must not depend on whether an earlier one asked for the whole matrix.
  EXPECT_EQ(one.diagonal, diagonal.diagonal);
}

TEST(MassFactor, SolvesWithTheFreePart) {
  const SimulatedSolid solid(test::box(3, 2, 2, {3, 2, 2}), 1);
  std::vector<std::uint8_t> free(solid.system.fixed.size(), 1);
  free[2] = free[7] = 0;
  const MassFactor factor(solid.discretization.mass, free);
  Eigen::Matrix3Xd right = Eigen::Matrix3Xd::Zero(3, solid.rest.cols());
  for (Eigen::Index i = 0; i < right.cols(); ++i) right.col(i) << std::cos(2.0 * static_cast<double>(i)), 1, 0.1;
  const Eigen::Matrix3Xd solution = factor.solve(right);
  EXPECT_EQ(solution.col(2), Eigen::Vector3d::Zero());
  Eigen::Matrix3Xd product = solution * solid.discretization.mass;
  for (const Eigen::Index i : {2, 7}) product.col(i) = right.col(i);
  EXPECT_LE((product - right).norm(), 1e-8 * right.norm());  // the shift of the diagonal is 1e-10 of it

  std::vector<std::uint8_t> none(free.size(), 0);
  EXPECT_EQ(MassFactor(solid.discretization.mass, none).solve(right).norm(), 0);
  Eigen::SparseMatrix<double> massless = 0 * solid.discretization.mass;
  EXPECT_THROW(MassFactor(massless, free), Error);
}

}  // namespace
}  // namespace argil::fem
