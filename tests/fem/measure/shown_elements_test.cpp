#include "fem/measure/shown_elements.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "subdiv/limit.h"
#include "subdiv/primitives.h"
#include "subdiv/refinement.h"

namespace {

using namespace argil;
using namespace argil::subdiv;

fem::NodalFields constant_fields(Eigen::Index count) {
  return {Eigen::VectorXd::Constant(count, 2e5), Eigen::VectorXd::Constant(count, 0.25),
          Eigen::VectorXd::Constant(count, 1000), Eigen::VectorXd::Zero(count)};
}

// A pyramid as control mesh has hexahedra and an irregular cell at every level.
class ShownElements : public testing::Test {
 protected:
  Built control = pyramid({1, 1, 1});
  Refinement refinement = refine_to_level(control.solid, 2);
  Eigen::Matrix3Xd rest = apply(refinement.stencils.back(), control.positions);
  fem::ShownElements shown{refinement.solid(), rest, constant_fields(rest.cols())};
};

TEST_F(ShownElements, UniaxialStretchGivesItsStrainAndStressAtEveryVertex) {
  const double stretch = 1.1;
  Eigen::Matrix3Xd moved = rest;
  moved.row(0) *= stretch;
  // Deviator of diag(0.1, 0, 0): equivalent strain sqrt(2/3 · 2/3) · 0.1; von Mises stress 2 μ · 0.1, μ = E / (2 (1
  // + ν)).
  const Eigen::VectorXd strain = shown.equivalent_strain(moved), stress = shown.von_mises_stress(moved);
  const double mu = 2e5 / 2.5;
  for (Eigen::Index v = 0; v < rest.cols(); ++v) {
    EXPECT_NEAR(strain[v], 2.0 / 3 * (stretch - 1), 1e-10);
    EXPECT_NEAR(stress[v], 2 * mu * (stretch - 1), 1e-10 * mu);
  }
}

TEST_F(ShownElements, RotationShowsNothing) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  EXPECT_LT(shown.equivalent_strain(turn * rest).maxCoeff(), 1e-12);
}

TEST(ShownElementsAtLimitPoints, SeeTheSameStrainAsAtTheVertices) {
  const Built box = box_grid(3, 3, 3, {1, 1, 1});
  const Refinement refinement = refine_to_level(box.solid, 1);
  const Eigen::Matrix3Xd rest =
      apply(limit_stencils(refinement.solid()), apply(refinement.stencils.back(), box.positions));
  const fem::ShownElements shown(refinement.solid(), rest, constant_fields(rest.cols()));
  Eigen::Matrix3Xd moved = rest;
  moved.row(2) *= 0.9;
  const Eigen::VectorXd strain = shown.equivalent_strain(moved);
  EXPECT_NEAR(strain.minCoeff(), 0.2 / 3, 1e-10);
  EXPECT_NEAR(strain.maxCoeff(), 0.2 / 3, 1e-10);
}

}  // namespace
