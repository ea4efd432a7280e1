#include "fem/solvers/rest_operator.h"

#include <gmock/gmock.h>

#include "fem/solvers/block_accumulator.h"
#include "fem/solvers/pcg.h"
#include "tests/fem/simulated_solid.h"

namespace argil::fem {
namespace {

using test::SimulatedSolid;

TEST(RestOperator, IsTheReducedTangentAtRest) {
  for (const Space space : {Space::standard, Space::cubic}) {
    const SimulatedSolid solid(subdiv::wedge({1, 1, 1}), 2, {}, {space, 1});
    const RestOperator rest = rest_operator(solid.system, true);
    const Eigen::SparseMatrix<double> full = rest.stiffness.selfadjointView<Eigen::Lower>();
    const auto tangent = solid.model->tangent(solid.discretization.rest_nodes, Projection::none);
    for (Eigen::Index unknown = 0; unknown < 3 * solid.rest.cols(); ++unknown) {
      Eigen::Matrix3Xd direction = Eigen::Matrix3Xd::Zero(3, solid.rest.cols()), forces;
      direction(unknown % 3, unknown / 3) = 1;
      tangent->stiffness_product(nodes(solid.system, direction), forces);
      const Eigen::Matrix3Xd expected = generalised_forces(solid.system, forces);
      const Eigen::VectorXd column = full.col(unknown);
      // Two orders of summation over some hundred elements of stiffness about E h.
      EXPECT_LE((column - Eigen::Map<const Eigen::VectorXd>(expected.data(), expected.size())).norm(), 1e-10);
      const auto point = static_cast<std::size_t>(unknown / 3);
      EXPECT_NEAR(rest.diagonal[point](unknown % 3, unknown % 3), expected(unknown % 3, unknown / 3), 1e-10);
    }
  }
}

TEST(Preconditioner, FactorSolvesTheRestProblemAtOnceAndJacobiInMore) {
  SimulatedSolid solid(test::box(3, 3, 3, {1, 1, 1}), 1);
  solid.fix([](const Eigen::Vector3d& x) { return x.z() < 1e-9; });
  const RestOperator rest = rest_operator(solid.system, true);
  std::vector<std::uint8_t> free;
  for (const std::uint8_t fixed : solid.system.fixed) free.push_back(fixed ? 0 : 1);
  const Eigen::SparseMatrix<double> inertia = solid.discretization.mass * 1e4;
  const std::vector<AnchorSpring> springs{{{5, 40}, {0.25, 0.75}, Eigen::Vector3d::Zero(), 500}};
  const auto tangent = solid.model->tangent(solid.discretization.rest_nodes, Projection::none);
  const LinearOperator matrix = [&](const Eigen::Matrix3Xd& d, Eigen::Matrix3Xd& result) {
    Eigen::Matrix3Xd forces;
    tangent->stiffness_product(nodes(solid.system, d), forces);
    result = generalised_forces(solid.system, forces) + d * inertia;
    const Eigen::Vector3d held = 500 * held_point(springs[0], d);
    for (std::size_t e = 0; e < 2; ++e)
      result.col(static_cast<Eigen::Index>(springs[0].control_points[e])) += springs[0].weights[e] * held;
    for (Eigen::Index i = 0; i < result.cols(); ++i)
      if (!free[static_cast<std::size_t>(i)]) result.col(i).setZero();
  };
  Eigen::Matrix3Xd right = Eigen::Matrix3Xd::Zero(3, solid.rest.cols()), solution, product;
  for (Eigen::Index i = 0; i < right.cols(); ++i)
    if (free[static_cast<std::size_t>(i)]) right.col(i) << std::sin(1.0 * static_cast<double>(i)), 1, -0.5;
  int factor_iterations = 0;
  for (const PreconditionerKind kind : {PreconditionerKind::factor, PreconditionerKind::jacobi}) {
    const auto preconditioner = make_preconditioner(kind, rest, inertia, springs, free);
    ASSERT_EQ(preconditioner->kind(), kind);
    const LinearOutcome outcome = pcg(matrix, *preconditioner, right, solution, 1e-8, 500);
    EXPECT_TRUE(outcome.converged);
    matrix(solution, product);
    EXPECT_LE((product - right).norm(), 2e-8 * right.norm());
    if (kind == PreconditionerKind::factor) {
      EXPECT_LE(outcome.iterations, 2);  // the shift of the diagonal is 1e-10 of it
      factor_iterations = outcome.iterations;
    } else {
      EXPECT_GT(outcome.iterations, factor_iterations);
    }
  }
}

TEST(Preconditioner, ABodyThatNothingHoldsStillGetsOne) {
  const SimulatedSolid solid(test::box(2, 2, 2, {1, 1, 1}), 1);
  const RestOperator rest = rest_operator(solid.system, true);
  const std::vector<std::uint8_t> free(solid.system.rows->column_count, 1);
  const auto preconditioner = make_preconditioner(PreconditionerKind::factor, rest, {}, {}, free);
  Eigen::Matrix3Xd r = Eigen::Matrix3Xd::Random(3, solid.rest.cols()), z;
  preconditioner->apply(r, z);
  EXPECT_TRUE(z.allFinite());
}

TEST(Pcg, ReportsNegativeCurvature) {
  const SimulatedSolid solid(test::box(1, 1, 1, {1, 1, 1}), 0);
  const RestOperator rest = rest_operator(solid.system, false);
  EXPECT_EQ(rest.stiffness.size(), 0);
  const std::vector<std::uint8_t> free(8, 1);
  const auto jacobi = make_preconditioner(PreconditionerKind::jacobi, rest, {}, {}, free);
  const Eigen::Matrix3Xd right = Eigen::Matrix3Xd::Ones(3, 8);
  Eigen::Matrix3Xd solution;
  const LinearOutcome outcome = pcg([](const Eigen::Matrix3Xd& d, Eigen::Matrix3Xd& result) { result = -d; },
                                    *jacobi, right, solution, 1e-8, 9);
  EXPECT_TRUE(outcome.negative_curvature);
  EXPECT_GT(solution.cwiseProduct(right).sum(), 0);  // still a direction of descent
}

TEST(BlockAccumulator, SumsLikeADenseMatrix) {
  BlockAccumulator sums(2);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(600, 600);
  for (std::uint32_t n = 0; n < 20000; ++n) {
    const std::uint32_t row = n * 7919U % 300U, column = (n * 104729U / 3U) % 300U;
    double* block = sums.block(row, column);
    for (int k = 0; k < 4; ++k) {
      block[k] += n + k;
      expected(2 * row + k % 2, 2 * column + k / 2) += n + k;
    }
  }
  EXPECT_EQ(Eigen::MatrixXd(sums.matrix(300)), expected);  // integers: no rounding
}

}  // namespace
}  // namespace argil::fem
