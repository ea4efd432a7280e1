// Closed forms and corner cases of the corotational model; what every model promises is in model_table_test.cpp.

#include "fem/models/force_model.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/fem/element_bodies.h"
#include "tests/fem/models/model_calls.h"

namespace argil::fem {
namespace {

using test::Body;
using test::forces_at;
using test::largest;
using test::product_at;

TEST(ForceModels, ProjectionLeavesAStretchedStateAlone) {
  const Body body = test::hexahedra(2, 0.1);
  const Eigen::Matrix3Xd x = 1.05 * body.rest, dx = test::random_vectors(x.cols(), 1, 29);
  const auto model = make_corotational(body.blocks, body.rest);
  const Eigen::Matrix3Xd exact = product_at(*model->tangent(x, Projection::none), dx);
  EXPECT_LE(largest(product_at(*model->tangent(x, Projection::positive_semidefinite), dx) - exact),
            1e-15 * largest(exact));
}

TEST(ForceModels, PatchTestOfARandomTricubicNetIsLimitedByQuadrature) {
  // ∇N det J has degree 8 in each coordinate, one more than 4 Gauss points integrate: small, but not rounding.
  Body body = test::bspline(4, 0.1);
  test::finish(body, 0.3, true);
  Eigen::Matrix3d affine = 1.1 * Eigen::Matrix3d::Identity();
  affine(0, 1) = 0.1;
  const Eigen::Matrix3Xd f = forces_at(*make_corotational(body.blocks, body.rest), affine * body.rest);
  double residual = 0;
  for (const auto node : body.interior) residual = std::max(residual, f.col(node).cwiseAbs().maxCoeff());
  const double stress = 250, h = 0.25;
  EXPECT_LE(residual, 1e-7 * stress * h * h);
  EXPECT_GE(residual, 1e-12 * stress * h * h);
}

TEST(ForceModels, UniaxialStretchHasTheClosedForm) {
  // ν = 0, stretch s along x: Ψ/V = μ (s − 1)², P = 2μ (s − 1) = E (s − 1); force on each end face of the unit
  // cube.
  Body body = test::hexahedra(2, 0);
  test::finish(body, 0.0, true);
  const Eigen::Matrix3d stretch = Eigen::Vector3d(1.5, 1, 1).asDiagonal();
  const auto model = make_corotational(body.blocks, body.rest);
  const Eigen::Matrix3Xd f = forces_at(*model, stretch * body.rest);
  double pull = 0;
  for (Eigen::Index i = 0; i < f.cols(); ++i)
    if (body.rest(0, i) == 1) pull += f(0, i);
  EXPECT_NEAR(pull, -500, 1e-10);
  EXPECT_NEAR(model->energy(stretch * body.rest), 500 * 0.25, 1e-10);
}

TEST(ForceModels, PaintedMaterialIsFeltWithoutANewModel) {
  Body body = test::hexahedra(2, 0.1);
  const auto model = make_corotational(body.blocks, body.rest);
  const Eigen::Matrix3Xd x = 1.2 * body.rest;
  const Eigen::Matrix3Xd before = forces_at(*model, x);
  for (double& mu : body.blocks[0].mu) mu *= 4;
  for (double& lambda : body.blocks[0].lambda) lambda *= 4;
  EXPECT_LE(largest(forces_at(*model, x) - 4 * before), 1e-13 * largest(before));
}

TEST(ForceModels, PointsWithoutMaterialGiveNoForce) {
  Body body = test::pyramids(1, 0.1);
  for (auto* values : {&body.blocks[0].mu, &body.blocks[0].lambda}) std::fill(values->begin(), values->end(), 0.0);
  const auto model = make_corotational(body.blocks, body.rest);
  EXPECT_EQ(largest(forces_at(*model, 0.0 * body.rest)), 0);
  const auto tangent = model->tangent(0.0 * body.rest, Projection::positive_semidefinite);
  EXPECT_EQ(largest(product_at(*tangent, body.rest)), 0);
}

TEST(ForceModels, CollapseToAPointOrALineStaysFinite) {
  const Body body = test::mixed(2, 0.1);
  const auto model = make_corotational(body.blocks, body.rest);
  Eigen::Matrix3Xd line = Eigen::Matrix3Xd::Zero(3, body.rest.cols());
  line.row(1) = body.rest.row(0);
  for (const Eigen::Matrix3Xd& x : {Eigen::Matrix3Xd(0.0 * body.rest), line}) {
    EXPECT_TRUE(forces_at(*model, x).allFinite());
    const auto tangent = model->tangent(x, Projection::positive_semidefinite);
    EXPECT_TRUE(product_at(*tangent, body.rest).allFinite());
  }
  // F = 0, R = I: Ψ = Σ V (3μ + 9λ/2).
  double expected = 0;
  for (const ElementBlock& block : body.blocks)
    for (std::size_t i = 0; i < block.mu.size(); ++i)
      expected += block.volumes[i] * (3 * block.mu[i] + 4.5 * block.lambda[i]);
  EXPECT_NEAR(model->energy(0.0 * body.rest), expected, 1e-12 * expected);
}

}  // namespace
}  // namespace argil::fem
