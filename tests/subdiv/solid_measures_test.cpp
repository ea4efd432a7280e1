#include "subdiv/solid_measures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "subdiv/primitives.h"
#include "tests/subdiv/cells.h"

namespace argil::subdiv {
namespace {

using namespace test;

constexpr double k_round_off = 1e-13;  // sums of some hundred terms of order one

TEST(SolidMeasures, BoxHasItsVolumeCentreAndInertiaFarFromTheOrigin) {
  Built built = box_grid(3, 2, 4, {1, 2, 3});
  const Eigen::Vector3d shift(1000, -2000, 500);
  built.positions.colwise() += shift;
  const MassProperties m = mass_properties(built.solid, built.positions);
  // Coordinates of 1e3 carry 1e-13 each.
  EXPECT_NEAR(m.volume, 6, 1e-11);
  EXPECT_LT((m.centre - shift - Eigen::Vector3d(0.5, 1, 1.5)).norm(), 1e-11);
  const Eigen::Vector3d expected(6 * (4 + 9) / 12.0, 6 * (1 + 9) / 12.0, 6 * (1 + 4) / 12.0);
  EXPECT_LT((m.inertia - Eigen::Matrix3d(expected.asDiagonal())).norm(), 1e-11);
}

TEST(SolidMeasures, TetrahedronHasItsProductsOfInertia) {
  const Built built = tetrahedron({1, 1, 1});
  const MassProperties m = mass_properties(built.solid, built.positions);
  EXPECT_NEAR(m.volume, 1.0 / 6, k_round_off);
  EXPECT_LT((m.centre - Eigen::Vector3d::Constant(0.25)).norm(), k_round_off);
  // Over a tetrahedron, with its vertices r_k about the centroid, ∫ r rᵀ = V/20 Σ r_k r_kᵀ.
  EXPECT_NEAR(m.inertia(0, 0), 1.0 / 6 * 6 / 80, k_round_off);
  EXPECT_NEAR(m.inertia(0, 1), 1.0 / 6 / 80, k_round_off);
}

TEST(SolidMeasures, VolumesOfThePrimitivesAndTheDodecahedron) {
  const auto volume = [](const Built& b) { return cell_volume(b.solid, b.positions, CellId{0u}); };
  EXPECT_NEAR(volume(tetrahedron({1, 2, 3})), 1, k_round_off);
  EXPECT_NEAR(volume(wedge({1, 2, 3})), 3, k_round_off);
  EXPECT_NEAR(volume(pyramid({1, 2, 3})), 2, k_round_off);
  EXPECT_NEAR(volume(build(dodecahedron())), (15 + 7 * std::sqrt(5.0)) / 4, k_round_off);
}

TEST(SolidMeasures, BentFacesAreSharedSoThatVolumesAddUp) {
  Built built = box_grid(2, 1, 1, {2, 1, 1});
  const double before = mass_properties(built.solid, built.positions).volume;
  built.positions(0, 4) += 0.3;  // a corner of the wall between the cells, moved within the top or bottom
  const double left = cell_volume(built.solid, built.positions, CellId{0u});
  const double right = cell_volume(built.solid, built.positions, CellId{1u});
  EXPECT_GT(left, 1.05);
  EXPECT_NEAR(left + right, before, k_round_off);
}

TEST(SolidMeasures, ScaledJacobianIsOneForABoxWhateverItsSize) {
  Built built = box_grid(2, 2, 2, {1, 20, 300});
  EXPECT_NEAR(min_scaled_jacobian(built.solid, built.positions)->value, 1, k_round_off);
  EXPECT_FALSE(min_scaled_jacobian(wedge({1, 1, 1}).solid, wedge({1, 1, 1}).positions).has_value());
}

TEST(SolidMeasures, ScaledJacobianOfAShearedBoxIsTheSineOfItsAngle) {
  Built built = box_grid(2, 1, 1, {2, 1, 1});
  const double slope = 0.75;
  for (Eigen::Index v = 0; v < built.positions.cols(); ++v) built.positions(0, v) += slope * built.positions(1, v);
  const auto worst = min_scaled_jacobian(built.solid, built.positions);
  EXPECT_NEAR(worst->value, 1 / std::sqrt(1 + slope * slope), k_round_off);
  EXPECT_EQ(worst->cell, CellId{0u});
}

TEST(SolidMeasures, ScaledJacobianTellsFlatTwistedAndInvertedCells) {
  Built built = box_grid(2, 1, 1, {2, 1, 1});
  Eigen::Matrix3Xd flat = built.positions;
  flat.col(2) = flat.col(1);  // an edge of cell 1 vanishes
  EXPECT_NEAR(min_scaled_jacobian(built.solid, flat)->value, 0, k_round_off);
  EXPECT_EQ(min_scaled_jacobian(built.solid, flat)->cell, CellId{1u});
  // Turning the top by 180 degrees leaves every corner at most flat, but the centre's axes vanish.
  const Built cube = box_grid(1, 1, 1, {1, 1, 1});
  Eigen::Matrix3Xd twisted = cube.positions;
  twisted.col(4).swap(twisted.col(7));
  twisted.col(5).swap(twisted.col(6));
  EXPECT_LT(min_scaled_jacobian(cube.solid, twisted)->value, 1e-12);
  EXPECT_EQ(inverted_cells(built.solid, built.positions).count, 0u);
  EXPECT_FALSE(inverted_cells(built.solid, built.positions).first.valid());
  Eigen::Matrix3Xd inverted = built.positions;
  for (const int v : {2, 5, 8, 11}) inverted(0, v) = 0.5;
  EXPECT_EQ(inverted_cells(built.solid, inverted).count, 1u);
  EXPECT_EQ(inverted_cells(built.solid, inverted).first, CellId{1u});
  EXPECT_NEAR(min_scaled_jacobian(built.solid, inverted)->value, -1, k_round_off);
}

TEST(SolidMeasures, ValencesOfInteriorEdges) {
  EXPECT_THAT(interior_edge_valences(box_grid(3, 3, 3, {1, 1, 1}).solid),
              testing::ElementsAre(testing::Pair(4u, 36u)));
  EXPECT_THAT(interior_edge_valences(build(wedges_about_edge(3, true)).solid),
              testing::ElementsAre(testing::Pair(3u, 1u)));
  EXPECT_THAT(interior_edge_valences(build(wedges_about_edge(3, false)).solid), testing::IsEmpty());
}

TEST(SolidMeasures, KindsOfCells) {
  CellLists lists = wedges_about_edge(3, true);
  EXPECT_THAT(cell_kind_counts(build(lists).solid), testing::ElementsAre(0, 0, 3, 0, 0));
  EXPECT_THAT(cell_kind_counts(build(dodecahedron()).solid), testing::ElementsAre(0, 0, 0, 0, 1));
  EXPECT_THAT(cell_kind_counts(box_grid(2, 2, 1, {1, 1, 1}).solid), testing::ElementsAre(0, 0, 0, 4, 0));
}

}  // namespace
}  // namespace argil::subdiv
