#include "fem/measure/strain.h"

#include <gtest/gtest.h>

#include "fem/measure/recovery.h"
#include "fem/measure/stress.h"
#include "tests/fem/element_bodies.h"

namespace argil::fem {
namespace {

using test::Body;

TEST(Strain, StretchesOfAnAffineMapAreItsSingularValues) {
  const Eigen::Matrix3d map =
      test::rotation(1, {1, 2, 3}) * Eigen::Vector3d(1.5, 0.7, 1.1).asDiagonal() * test::rotation(2, {0, 1, 1});
  for (const Body& body : test::all_bodies())
    for (const ElementBlock& block : body.blocks) {
      const Eigen::Matrix3Xd stretches = principal_stretches(block, map * body.rest);
      ASSERT_EQ(stretches.cols(), static_cast<Eigen::Index>(block.volumes.size()));
      // Conditioned by the Jacobians of flat pyramids.
      EXPECT_LE((stretches.colwise() - Eigen::Vector3d(1.5, 1.1, 0.7)).cwiseAbs().maxCoeff(), 1e-13) << body.name;
    }
  const Body body = test::hexahedra(2, 0.1);
  const Eigen::Matrix3Xd mirrored =
      principal_stretches(body.blocks[0], Eigen::Vector3d(1, 1, -0.5).asDiagonal() * body.rest);
  EXPECT_LE((mirrored.colwise() - Eigen::Vector3d(1, 1, -0.5)).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Strain, EquivalentStrainOfKnownStates) {
  const Body body = test::mixed(3, 0.1);
  const auto at = [&](const Eigen::Matrix3d& map) {
    const Eigen::VectorXd values = equivalent_strain(body.blocks, map * body.rest);
    EXPECT_LE(values.maxCoeff() - values.minCoeff(), 1e-13);  // every node is named and sees the constant
    return values[0];
  };
  EXPECT_NEAR(at(test::rotation(2, {1, 0, 1})), 0, 1e-14);
  EXPECT_NEAR(at(1.3 * Eigen::Matrix3d::Identity()), 0, 1e-14);
  // Uniaxial e along x without lateral contraction: deviator (2, −1, −1) e/3, so sqrt(2/3 · 6/9) e = 2e/3.
  EXPECT_NEAR(at(Eigen::Vector3d(1.12, 1, 1).asDiagonal()), 0.08, 1e-13);
  // At constant volume to first order (e, −e/2, −e/2): e itself.
  EXPECT_NEAR(at(Eigen::Vector3d(1.2, 0.9, 0.9).asDiagonal()), 0.2, 1e-13);
}

TEST(Stress, UniaxialTensionIsYoungTimesStrain) {
  Body body = test::bspline(2, 0.05);
  test::finish(body, 0.3, true);
  const Eigen::Matrix3d map = test::rotation(1, {3, 1, 2}) * Eigen::Vector3d(1.1, 0.97, 0.97).asDiagonal();
  const Eigen::VectorXd stress = von_mises_stress(body.blocks, map * body.rest);
  EXPECT_NEAR(stress.maxCoeff(), 100, 1e-9);
  EXPECT_NEAR(stress.minCoeff(), 100, 1e-9);
}

TEST(Recovery, LeavesOutPointsWithoutStiffnessAndNodesWithoutElements) {
  Body body = test::hexahedra(2, 0);
  ElementBlock& block = body.blocks[0];
  Eigen::VectorXd values = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(block.mu.size()));
  for (int p = 0; p < 8; ++p) {  // element 0 has none, and a wild value
    block.mu[block.point_index(0, p)] = block.lambda[block.point_index(0, p)] = 0;
    values[p] = 1e9;
  }
  const Eigen::VectorXd nodal =
      recover_at_nodes(body.blocks, {&values, 1}, static_cast<std::size_t>(body.rest.cols()) + 1);
  EXPECT_EQ(nodal[0], 0);  // the corner that only element 0 names
  EXPECT_EQ(nodal[nodal.size() - 1], 0);
  for (Eigen::Index i = 1; i + 1 < nodal.size(); ++i) EXPECT_NEAR(nodal[i], 1, 1e-15);
}

}  // namespace
}  // namespace argil::fem
