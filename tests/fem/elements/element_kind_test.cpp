#include "fem/elements/element_kind.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/fem/element_bodies.h"

namespace argil::fem {
namespace {

const ElementKind* const k_kinds[] = {&trilinear_hexahedron(), &pyramid(), &bspline_hexahedron()};

TEST(ElementKinds, ShapesSumToOneAndSlopesToZero) {
  for (const ElementKind* kind : k_kinds) {
    double weights = 0;
    for (int p = 0; p < kind->point_count; ++p) {
      weights += kind->weights[static_cast<std::size_t>(p)];
      double sum = 0;
      Eigen::Vector3d slope = Eigen::Vector3d::Zero();
      for (int n = 0; n < kind->node_count; ++n) {
        const auto i = static_cast<std::size_t>(p * kind->node_count + n);
        EXPECT_GE(kind->shapes[i], 0);
        sum += kind->shapes[i];
        for (std::size_t axis = 0; axis < 3; ++axis) slope[static_cast<int>(axis)] += kind->gradients[3 * i + axis];
      }
      EXPECT_NEAR(sum, 1, 5e-15);  // 64 terms
      EXPECT_LE(slope.norm(), 5e-15);
    }
    EXPECT_NEAR(weights, 1, 5e-15);
  }
}

TEST(ElementKinds, GradientsAreDerivativesOfShapesAndTablesAreEvaluations) {
  for (const ElementKind* kind : k_kinds) {
    const double e = 1e-6;
    Eigen::VectorXd plus, minus, shapes;
    Eigen::Matrix3Xd slopes, unused;
    const Eigen::Vector3d at(0.31, 0.62, 0.23);
    kind->evaluate(at, shapes, slopes);
    for (int axis = 0; axis < 3; ++axis) {
      kind->evaluate(at + e * Eigen::Vector3d::Unit(axis), plus, unused);
      kind->evaluate(at - e * Eigen::Vector3d::Unit(axis), minus, unused);
      // e² of the third derivative (at most 1) and 1e-16/e of rounding.
      EXPECT_LE(((plus - minus) / (2 * e) - slopes.row(axis).transpose()).cwiseAbs().maxCoeff(), 1e-9)
          << kind->name;
    }
    const int p = kind->point_count - 1;
    kind->evaluate(kind->points.back(), shapes, slopes);
    for (int n = 0; n < kind->node_count; ++n) {
      const auto i = static_cast<std::size_t>(p * kind->node_count + n);
      EXPECT_EQ(kind->shapes[i], shapes[n]);
      EXPECT_EQ(kind->gradients[3 * i + 2], slopes(2, n));
    }
  }
}

TEST(ElementKinds, CornersAreNumberedAsDocumented) {
  Eigen::VectorXd shapes;
  Eigen::Matrix3Xd slopes;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k) {
        trilinear_hexahedron().evaluate(Eigen::Vector3d(i, j, k), shapes, slopes);
        EXPECT_EQ(shapes[4 * i + 2 * j + k], 1);
      }
  const double corners[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.3, 0.8, 1}};
  for (int n = 0; n < 5; ++n) {
    pyramid().evaluate(Eigen::Vector3d(corners[n][0], corners[n][1], corners[n][2]), shapes, slopes);
    EXPECT_EQ(shapes[n], 1);
  }
}

TEST(ElementKinds, BsplineJoinsItsNeighbourWithTwoDerivatives) {
  // Along u: the end of net 0–3 and the start of net 1–4 give the same value, slope and (by differences) curvature.
  const Eigen::Matrix3Xd net = test::random_vectors(5, 1, 2);
  const auto value = [&](int first, double u) {
    Eigen::VectorXd shapes;
    Eigen::Matrix3Xd slopes;
    bspline_hexahedron().evaluate({u, 0.5, 0.5}, shapes, slopes);
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (int n = 0; n < 64; ++n) x += shapes[n] * net.col(first + n / 16);
    return x;
  };
  const double e = 1e-3;
  EXPECT_LE((value(0, 1) - value(1, 0)).norm(), 1e-15);
  // Cubics differ by the jump of the third derivative times e³/6 only.
  const Eigen::Vector3d beyond = value(0, 1 + e), inside = value(1, e);
  EXPECT_LE((beyond - inside).norm(), 12 * e * e * e);
  EXPECT_GT((value(0, 1 + 0.5) - value(1, 0.5)).norm(), 1e-3);
}

}  // namespace
}  // namespace argil::fem
