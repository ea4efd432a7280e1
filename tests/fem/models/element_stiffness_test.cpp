// Matrices of elements: shared where elements are congruent, and what warping them gives.

#include "fem/models/element_stiffness.h"

#include <gtest/gtest.h>

#include "fem/models/model_table.h"
#include "tests/fem/element_bodies.h"

namespace argil::fem {
namespace {

using test::Body;

TEST(ElementStiffness, CongruentElementsShareTheirMatrix) {
  Body body = test::hexahedra(4, 0);
  test::finish(body, 0.3, true);
  body.rest.colwise() += Eigen::Vector3d(31.7, -12.3, 5.1);  // rounding differs from element to element
  const ElementStiffness shared(body.blocks, body.rest, Formulation::plain);
  EXPECT_EQ(shared.distinct_count(0), 1u);
  body.blocks[0].mu[8 * 5] *= 1.001;
  EXPECT_FALSE(shared.is_current());
  const ElementStiffness painted(body.blocks, body.rest, Formulation::plain);
  EXPECT_EQ(painted.distinct_count(0), 2u);
  EXPECT_EQ(painted.index(0, 5), 1u);
  EXPECT_EQ(painted.index(0, 6), 0u);

  const Body distorted = test::hexahedra(3, 0.2);
  EXPECT_EQ(ElementStiffness(distorted.blocks, distorted.rest, Formulation::plain).distinct_count(0), 27u);
}

TEST(ElementStiffness, MatricesAreThoseOfTheElements) {
  for (const Body& body : test::all_bodies())
    for (const Formulation formulation :
         {Formulation::plain, Formulation::b_bar, Formulation::incompatible_modes}) {
      const ElementStiffness stiffness(body.blocks, body.rest, formulation);
      for (std::size_t b = 0; b < body.blocks.size(); ++b)
        for (std::size_t e = 0; e < body.blocks[b].element_count(); ++e) {
          // One element at a time from its table of gradients, where the linear model computes four side by side.
          const Eigen::MatrixXd expected = element_stiffness(body.blocks[b], e, body.rest, formulation);
          const Eigen::Map<const Eigen::MatrixXd> found(stiffness.matrix(b, e), expected.rows(), expected.cols());
          EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff()) << body.name;
        }
    }
}

TEST(ElementStiffness, OtherMatricesAreAskedForOncePerKindOfCongruentElements) {
  Body body = test::hexahedra(3, 0);
  test::finish(body, 0.3, true);
  body.blocks[0].mu[8 * 4] *= 1.5;
  const ElementStiffness stiffness(body.blocks, body.rest, [](const ElementBlock& distinct, double* matrices) {
    ASSERT_EQ(distinct.element_count(), 2u);
    for (std::size_t e = 0; e < 2; ++e)
      for (std::size_t i = 0; i < 24 * 24; ++i) matrices[24 * 24 * e + i] = distinct.mu[8 * e];
  });
  for (std::size_t e = 0; e < 27; ++e) EXPECT_EQ(stiffness.matrix(0, e)[7], body.blocks[0].mu[8 * e]);
}

TEST(ElementStiffness, ProductIsThatOfTheMatrix) {
  for (const std::size_t size : {15u, 24u, 30u, 192u}) {
    const auto n = static_cast<Eigen::Index>(size);
    Eigen::MatrixXd k = Eigen::MatrixXd::NullaryExpr(
        n, n, [](Eigen::Index i, Eigen::Index j) { return std::sin(static_cast<double>(2 * i * j + i)); });
    const Eigen::VectorXd v =
        Eigen::VectorXd::NullaryExpr(n, [](Eigen::Index i) { return std::cos(static_cast<double>(i)); });
    Eigen::VectorXd result(n);
    std::vector<double> one(size);
    multiply_stiffness(k.data(), size, v.data(), result.data());
    EXPECT_LE((result - k * v).cwiseAbs().maxCoeff(), 1e-12);
    std::vector<FourDoubles> four(size), products(size);
    for (std::size_t lane = 0; lane < 4; ++lane)
      for (std::size_t i = 0; i < size; ++i) four[i].values[lane] = v[static_cast<Eigen::Index>((i + lane) % size)];
    multiply_stiffness_of_four(k.data(), size, four.data(), products.data());
    for (std::size_t lane = 0; lane < 4; ++lane) {
      for (std::size_t i = 0; i < size; ++i) one[i] = four[i].values[lane];
      multiply_stiffness(k.data(), size, one.data(), result.data());
      for (std::size_t i = 0; i < size; ++i)  // every bit
        EXPECT_EQ(products[i].values[lane], result[static_cast<Eigen::Index>(i)]);
    }
  }
}

/// |Σ x × f| / Σ |x × f| about the middle.
double ghost_torque(const Body& body, const std::string& model_name, const Eigen::Matrix3Xd& x) {
  const auto model = make_model({model_name}, body.blocks, body.rest);
  Eigen::Matrix3Xd f;
  model->forces(x, f);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double sum = 0;
  const Eigen::Vector3d middle = x.rowwise().mean();
  for (Eigen::Index n = 0; n < x.cols(); ++n) {
    const Eigen::Vector3d arm = x.col(n) - middle, fn = f.col(n), torque = arm.cross(fn);
    moment += torque;
    sum += torque.norm();
  }
  return moment.norm() / sum;
}

TEST(WarpedStiffness, GhostTorqueGrowsWithDistortion) {
  // METHODS §4: 0.3, 1.3, 15 % at 1, 5, 20 % random distortion (of the present state; one element, the root mean
  // square of several states). An affine state has none.
  Body cube = test::hexahedra(1, 0);
  test::finish(cube, 0.3, true);
  const double distortions[] = {0.01, 0.05, 0.2};
  double ghost[3];
  for (int i = 0; i < 3; ++i) {
    double square = 0, consistent = 0;
    for (unsigned seed = 0; seed < 50; ++seed) {
      const Eigen::Matrix3Xd x = cube.rest + test::random_vectors(8, distortions[i], 100 + seed);
      square += std::pow(ghost_torque(cube, "warped_stiffness", x), 2) / 50;
      consistent = std::max(consistent, ghost_torque(cube, "corotational", x));
    }
    ghost[i] = std::sqrt(square);
    std::printf("warped stiffness, distortion %.2f: ghost torque %.3f %%, corotational %.1e\n", distortions[i],
                100 * ghost[i], consistent);
    EXPECT_LE(consistent, 1e-13 / distortions[i]);
  }
  const Eigen::Matrix3d affine = test::rotation(1, {1, 2, 3}) * Eigen::Vector3d(1.3, 0.9, 1.1).asDiagonal();
  EXPECT_LE(ghost_torque(cube, "warped_stiffness", affine * cube.rest), 1e-14);
  EXPECT_GT(ghost[0], 0.001);
  EXPECT_NEAR(ghost[1] / ghost[0], 5, 1);
  EXPECT_GT(ghost[2], 3 * ghost[1]);
}

}  // namespace
}  // namespace argil::fem
