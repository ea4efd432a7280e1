#include "subdiv/refinement.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "subdiv/neighbourhood.h"
#include "tests/shapes/shapes.h"

namespace argil::subdiv {
namespace {

using namespace test;

TEST(Refinement, ComposedStencilsAreTheStepsOneAfterAnother) {
  for (const Shape& shape : catalogue()) {
    SCOPED_TRACE(shape.name);
    const Refinement refinement = refine_to_level(shape.solid, 2);
    ASSERT_EQ(refinement.finest(), 2);
    Eigen::Matrix3Xd positions = shape.positions;
    for (std::size_t level = 0; level <= 2; ++level) {
      if (level > 0) positions = apply(refinement.step_stencils[level], positions);
      EXPECT_LE((apply(refinement.stencils[level], shape.positions) - positions).cwiseAbs().maxCoeff(), 1e-14);
    }
  }
}

TEST(Refinement, CellCountIsForeseenWithoutMakingTheCells) {
  for (const Shape& shape : catalogue()) {
    SCOPED_TRACE(shape.name);
    const Refinement refinement = refine_to_level(shape.solid, 2);
    for (int level = 0; level <= 2; ++level)
      EXPECT_EQ(refined_cell_count(shape.solid, level),
                refinement.levels[static_cast<std::size_t>(level)].cell_count());
  }
  // A count that no machine holds is reported as large, not wrapped around.
  EXPECT_EQ(refined_cell_count(box_grid(1, 1, 1, {1, 1, 1}).solid, 40), static_cast<std::size_t>(-1));
}

TEST(Refinement, ParentsAndCornersLeadBackThroughTheLevels) {
  const Refinement refinement = refine_to_level(build(mixed_cells()).solid, 2);
  for (std::size_t level = 1; level <= 2; ++level) {
    ASSERT_EQ(refinement.parent[level].size(), refinement.levels[level].cell_capacity());
    ASSERT_EQ(refinement.parent_corner[level].size(), refinement.levels[level].cell_capacity());
    for (const CellId c : refinement.levels[level].cells())
      EXPECT_TRUE(refinement.levels[level - 1].is_live(refinement.parent[level][c]));
  }
}

// METHODS §1: the volume of a lone hexahedron, of 2³ and of 3³, that is left after three levels.
TEST(Refinement, SmoothBlocksLoseVolumeAsMeasured) {
  const auto volume_left = [](int n) {
    const Built grid = box_grid(n, n, n, {1, 1, 1});
    const Refinement refinement = refine_to_level(grid.solid, 3);
    const Eigen::Matrix3Xd x = apply(refinement.stencils.back(), grid.positions);
    double volume = 0;
    for (const FaceId f : refinement.solid().faces()) {
      if (!refinement.solid().is_boundary(f)) continue;
      const auto loop = refinement.solid().face_vertices(f);
      Eigen::Vector3d centre(0, 0, 0);
      for (const VertexId v : loop) centre += x.col(v.value) / 4;
      for (std::size_t i = 0; i < 4; ++i)
        volume += centre.dot(x.col(loop[i].value).cross(x.col(loop[(i + 1) % 4].value))) / 6 *
                  (is_back(refinement.solid().boundary_use(f)) ? -1 : 1);
    }
    return volume;
  };
  // Printed to whole percents.
  EXPECT_NEAR(volume_left(1), 0.33, 0.005);
  EXPECT_NEAR(volume_left(2), 0.79, 0.005);
  EXPECT_NEAR(volume_left(3), 0.90, 0.005);
}

TEST(Refinement, LoneHexahedronLosesItsCheckerboardMode) {  // METHODS §1: rank 7 of 8
  const Stencils step = refine(box_grid(1, 1, 1, {1, 1, 1}).solid).stencils;
  const Eigen::VectorXd checkerboard = (Eigen::VectorXd(8) << 1, -1, -1, 1, -1, 1, 1, -1).finished();
  const Eigen::VectorXd fine = apply(step, checkerboard);
  EXPECT_LE(fine.cwiseAbs().maxCoeff(), 1e-15);
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(27, 8);
  for (Eigen::Index j = 0; j < 8; ++j) rows.col(j) = apply(step, Eigen::VectorXd(Eigen::VectorXd::Unit(8, j)));
  EXPECT_EQ(Eigen::FullPivLU<Eigen::MatrixXd>(rows).rank(), 7);
}

}  // namespace
}  // namespace argil::subdiv
