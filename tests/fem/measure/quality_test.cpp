#include "fem/measure/quality.h"

#include <gtest/gtest.h>

#include <cmath>

#include "subdiv/primitives.h"

namespace {

using namespace argil;
using namespace argil::subdiv;

TEST(RelativeJacobian, IsOneForBoxesAndTheirAffineImages) {
  Built box = box_grid(2, 3, 1, {1, 2, 0.1});
  EXPECT_NEAR(fem::min_relative_jacobian(box.solid, box.positions).value, 1, 1e-12);
  Eigen::Matrix3d shear;
  shear << 1, 0.7, 0.2, 0, 1, 0.4, 0, 0, 1;
  box.positions = shear * box.positions;
  EXPECT_NEAR(fem::min_relative_jacobian(box.solid, box.positions).value, 1, 1e-12);
}

TEST(RelativeJacobian, IsOneForATetrahedron) {
  // The middle cuts it into four of the same volume, fanned faces each into three.
  const Built cell = tetrahedron({1, 2, 3});
  EXPECT_NEAR(fem::min_relative_jacobian(cell.solid, cell.positions).value, 1, 1e-12);
}

TEST(RelativeJacobian, FallsLinearlyInATaperedHexahedron) {
  // x scaled by 1 + t z at height z: the Jacobian is 1 + t z, smallest at the lower Gauss point; its mean is 1 + t
  // / 2.
  Built box = box_grid(1, 1, 1, {1, 1, 1});
  const double taper = 4;
  for (Eigen::Index v = 0; v < box.positions.cols(); ++v) box.positions(0, v) *= 1 + taper * box.positions(2, v);
  const double lower = 0.5 - 0.5 / std::sqrt(3.0);
  EXPECT_NEAR(fem::min_relative_jacobian(box.solid, box.positions).value, (1 + taper * lower) / (1 + taper / 2),
              1e-12);
}

TEST(RelativeJacobian, NamesTheInvertedCell) {
  Built box = box_grid(3, 1, 1, {3, 1, 1});
  // The plane between cells 1 and 2 is pushed through the far end: cell 2 is inside out.
  for (Eigen::Index v = 0; v < box.positions.cols(); ++v)
    if (box.positions(0, v) == 2) box.positions(0, v) = 3.5;
  const fem::WorstJacobian worst = fem::min_relative_jacobian(box.solid, box.positions);
  EXPECT_EQ(worst.cell, CellId{2});
  EXPECT_EQ(worst.value, -1);
}

}  // namespace
