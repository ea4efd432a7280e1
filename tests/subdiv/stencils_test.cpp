#include "subdiv/stencils.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <Eigen/Dense>

#include "subdiv/refinement.h"
#include "tests/shapes/shapes.h"

namespace argil::subdiv {
namespace {

using namespace test;

Eigen::MatrixXd dense(const Stencils& stencils) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(stencils.row_count()),
                                            static_cast<Eigen::Index>(stencils.column_count));
  for (std::size_t i = 0; i < stencils.row_count(); ++i)
    for (std::size_t j = 0; j < stencils.row(i).columns.size(); ++j)
      m(static_cast<Eigen::Index>(i), stencils.row(i).columns[j]) = stencils.row(i).weights[j];
  return m;
}

TEST(Stencils, ProductsAreThoseOfTheMatrices) {
  const Solid coarse = build(fan(5, 2)).solid;
  const RefinementStep a = refine(coarse), b = refine(a.fine);
  const Stencils both = compose(b.stencils, a.stencils);
  const Eigen::MatrixXd product = dense(b.stencils) * dense(a.stencils);
  EXPECT_LE((dense(both) - product).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_EQ(dense(transpose(both)), dense(both).transpose());
  const Eigen::Matrix3Xd values = random_positions(coarse.vertex_capacity(), 3);
  EXPECT_LE((apply(both, values) - values * product.transpose()).cwiseAbs().maxCoeff(), 1e-14);
  const Eigen::VectorXd field = values.row(1);
  EXPECT_EQ(apply(both, field), Eigen::VectorXd(apply(both, values).row(1)));
}

TEST(Stencils, IdentityIsNeutralAndAppendingStacksRows) {
  const Stencils step = refine(box_grid(1, 1, 1, {1, 1, 1}).solid).stencils;
  EXPECT_EQ(dense(compose(step, Stencils::identity(8))), dense(step));
  EXPECT_EQ(dense(compose(Stencils::identity(27), step)), dense(step));
  Stencils stacked = Stencils::identity(8);
  stacked.append(step);
  stacked.append(step.row(5).columns, step.row(5).weights);
  ASSERT_EQ(stacked.row_count(), 8U + 27 + 1);
  EXPECT_EQ(dense(stacked).bottomRows(1), dense(step).row(5));
  EXPECT_EQ(dense(stacked).middleRows(8, 27), dense(step));
}

TEST(Stencils, BitsDoNotDependOnTheNumberOfThreads) {
  const Built grid = box_grid(8, 7, 6, {1, 1, 1});
  const Eigen::Matrix3Xd values = random_positions(grid.solid.vertex_capacity(), 4);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const Refinement refinement = refine_to_level(grid.solid, 2);
    return std::pair(refinement.stencils.back(), apply(refinement.stencils.back(), values));
  };
  const auto [one, positions_of_one] = run(1);
  const auto [four, positions_of_four] = run(4);
  EXPECT_EQ(one.offsets, four.offsets);
  EXPECT_EQ(one.columns, four.columns);
  EXPECT_EQ(one.weights, four.weights);
  EXPECT_EQ(positions_of_one, positions_of_four);
}

}  // namespace
}  // namespace argil::subdiv
