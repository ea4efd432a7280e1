#include "fem/measure/tetrahedron_grid.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "fem/measure/cell_tetrahedra.h"
#include "subdiv/primitives.h"
#include "subdiv/solid_measures.h"

namespace argil::fem {
namespace {

using namespace subdiv;

double volume_of(const Eigen::Matrix3Xd& points, const std::array<std::uint32_t, 4>& t) {
  const Eigen::Vector3d a = points.col(t[0]);
  return (points.col(t[1]) - a).cross(points.col(t[2]) - a).dot(points.col(t[3]) - a) / 6;
}

TEST(CellTetrahedra, FillEveryKindOfCellOnceAndTurnTheSameWay) {
  for (const Built& built : {box_grid(2, 3, 1, {1, 2, 0.5}), tetrahedron({1, 2, 3}), pyramid({1, 1, 2})}) {
    const CellTetrahedra cut = cell_tetrahedra(built.solid);
    const Eigen::Matrix3Xd points = apply(cut.points, built.positions);
    double sum = 0, expected = 0;
    for (const auto& t : cut.corners) {
      EXPECT_GT(volume_of(points, t), 0);
      sum += volume_of(points, t);
    }
    for (const CellId c : built.solid.cells()) expected += cell_volume(built.solid, built.positions, c);
    EXPECT_NEAR(sum, expected, 1e-12 * expected);
  }
  const Built box = box_grid(2, 1, 1, {2, 1, 1});
  EXPECT_EQ(cell_tetrahedra(box.solid).corners.size(), 2U * 24);
  CellData<std::uint8_t> kept(box.solid.cell_capacity(), 0);
  kept[CellId{1}] = 1;
  for (const std::uint32_t cell : cell_tetrahedra(box.solid, kept).cells) EXPECT_EQ(cell, 1U);
}

TEST(TetrahedronGrid, FindsEveryPointWithWeightsThatGiveItBack) {
  const Built box = box_grid(5, 3, 2, {5, 3, 1});
  const CellTetrahedra cut = cell_tetrahedra(box.solid);
  const Eigen::Matrix3Xd points = apply(cut.points, box.positions);
  const TetrahedronGrid grid(points, cut.corners);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d at(5 * part(random), 3 * part(random), part(random));
    const auto found = grid.locate(at);
    ASSERT_TRUE(found);
    Eigen::Vector3d back = Eigen::Vector3d::Zero();
    for (std::size_t k = 0; k < 4; ++k) {
      back += found->weights[k] * points.col(cut.corners[found->tetrahedron][k]);
      EXPECT_GE(found->weights[k], -1e-9);
    }
    EXPECT_LT((back - at).norm(), 1e-12);
    EXPECT_LT(cut.cells[found->tetrahedron], 30U);
  }
  EXPECT_TRUE(grid.locate({0, 0, 0}));
  EXPECT_TRUE(grid.locate({5, 3, 1}));
  EXPECT_FALSE(grid.locate({5.01, 1, 0.5}));
  EXPECT_FALSE(grid.locate({-1, -1, -1}));
  EXPECT_FALSE(grid.locate({NAN, 0, 0}));
  const auto beyond = grid.locate({5.1, 1.2, 0.5}, 2);
  ASSERT_TRUE(beyond);
  EXPECT_EQ(beyond->weights[0] + beyond->weights[1] + beyond->weights[2] + beyond->weights[3], 1);
  EXPECT_FALSE(grid.locate({50, 1, 0.5}, 2));
}

TEST(TetrahedronGrid, OfNothingHoldsNothing) {
  EXPECT_FALSE(TetrahedronGrid({}, {}).locate({0, 0, 0}, 2));
}

}  // namespace
}  // namespace argil::fem
