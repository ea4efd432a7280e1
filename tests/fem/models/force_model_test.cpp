// What every element kind and force model promises (METHODS §7).

#include "fem/models/force_model.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include "tests/fem/element_bodies.h"

namespace argil::fem {
namespace {

using test::Body;

Eigen::Matrix3Xd forces_at(const ForceModel& model, const Eigen::Matrix3Xd& x) {
  Eigen::Matrix3Xd result;
  model.forces(x, result);
  return result;
}
Eigen::Matrix3Xd product_at(const Tangent& tangent, const Eigen::Matrix3Xd& dx) {
  Eigen::Matrix3Xd result;
  tangent.stiffness_product(dx, result);
  return result;
}
double largest(const Eigen::Matrix3Xd& m) {
  return m.cwiseAbs().maxCoeff();
}

/// Smooth large strain, random, turned, flat, mirrored.
std::vector<Eigen::Matrix3Xd> states(const Body& body) {
  const Eigen::Matrix3Xd noise = test::random_vectors(body.rest.cols(), 0.05, 11);
  const Eigen::Matrix3d turn = test::rotation(2.0, {1, 2, -1});
  const Eigen::Matrix3d stretch = Eigen::Vector3d(1.4, 0.8, 1.1).asDiagonal();
  const Eigen::Matrix3d flat = Eigen::Vector3d(1.1, 0.9, 0.02).asDiagonal();
  const Eigen::Matrix3d mirror = Eigen::Vector3d(1.1, 0.9, -0.8).asDiagonal();
  return {stretch * body.rest, body.rest + 4 * noise, turn * (stretch * body.rest + noise),
          turn * (flat * body.rest) + 0.1 * noise, turn * (mirror * body.rest) + 0.1 * noise};
}

TEST(ForceModels, RigidMotionGivesNoForce) {
  const Eigen::Matrix3d turn = test::rotation(2.5, {1, -2, 0.5});
  for (const Body& body : test::all_bodies()) {
    const auto corotational = make_corotational(body.blocks, body.rest);
    const auto linear = make_linear(body.blocks, body.rest);
    const Eigen::Vector3d far(3, -5, 7);
    const double bound = 1e-12 * 1060;  // E h², h ≤ 1
    EXPECT_LE(largest(forces_at(*corotational, (turn * body.rest).colwise() + far)), bound) << body.name;
    EXPECT_LE(largest(forces_at(*linear, body.rest.colwise() + far)), bound) << body.name;
    EXPECT_GT(largest(forces_at(*linear, turn * body.rest)), 1) << "linear elasticity feels rotation";
  }
}

TEST(ForceModels, CorotationalTurnsWithTheFrame) {
  const Eigen::Matrix3d turn = test::rotation(1.2, {0.3, 1, 2});
  for (const Body& body : test::all_bodies())
    for (const Eigen::Matrix3Xd& x : states(body)) {
      const auto model = make_corotational(body.blocks, body.rest);
      const Eigen::Matrix3Xd f = forces_at(*model, x);
      // Mirrored states double the rounding through σ₁ + σ₂ of the flattened points.
      EXPECT_LE(largest(forces_at(*model, turn * x) - turn * f), 1e-11 * largest(f)) << body.name;
      EXPECT_NEAR(model->energy(turn * x), model->energy(x), 1e-12 * model->energy(x)) << body.name;
    }
}

TEST(ForceModels, SumsOfForceAndMomentVanish) {
  for (const Body& body : test::all_bodies())
    for (const Eigen::Matrix3Xd& x : states(body)) {
      const Eigen::Matrix3Xd f = forces_at(*make_corotational(body.blocks, body.rest), x);
      Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
      double forces = 0, moments = 0;
      for (Eigen::Index i = 0; i < f.cols(); ++i) {
        const Eigen::Vector3d fi = f.col(i), xi = x.col(i), torque = xi.cross(fi);
        force += fi;
        moment += torque;
        forces += fi.norm();
        moments += torque.norm();
      }
      EXPECT_LE(force.norm(), 1e-12 * forces) << body.name;
      EXPECT_LE(moment.norm(), 1e-12 * moments) << body.name;  // ghost torque
    }
}

TEST(ForceModels, ForcesAreTheNegativeGradientOfTheEnergy) {
  for (const Body& body : test::all_bodies())
    for (const bool linear : {false, true}) {
      const auto model = linear ? make_linear(body.blocks, body.rest) : make_corotational(body.blocks, body.rest);
      for (const Eigen::Matrix3Xd& x : states(body)) {
        const Eigen::Matrix3Xd f = forces_at(*model, x);
        const Eigen::Matrix3Xd dx = test::random_vectors(x.cols(), 1, 17);
        const double e = 1e-6;
        const double slope = (model->energy(x + e * dx) - model->energy(x - e * dx)) / (2 * e);
        // Central difference: rounding 1e-16 Ψ/e, truncation e² Ψ‴.
        const double scale = f.cwiseProduct(dx).cwiseAbs().sum();
        EXPECT_NEAR(slope, -f.cwiseProduct(dx).sum(), 1e-7 * scale + 1e-9 * model->energy(x)) << body.name;
      }
    }
}

TEST(ForceModels, TangentIsTheNegativeDerivativeOfTheForces) {
  for (const Body& body : test::all_bodies())
    for (const bool linear : {false, true}) {
      const auto model = linear ? make_linear(body.blocks, body.rest) : make_corotational(body.blocks, body.rest);
      for (const Eigen::Matrix3Xd& x : states(body)) {
        const Eigen::Matrix3Xd dx = test::random_vectors(x.cols(), 1, 19);
        const double e = 1e-7;
        const Eigen::Matrix3Xd difference =
            (forces_at(*model, x - e * dx) - forces_at(*model, x + e * dx)) / (2 * e);
        const Eigen::Matrix3Xd product = product_at(*model->tangent(x, Projection::none), dx);
        // Rounding 1e-15 f/e; near mirrored flat points the third derivative grows as 1/(σ₁ + σ₂)².
        EXPECT_LE(largest(product - difference), 1e-5 * largest(product)) << body.name << linear;
      }
    }
}

TEST(ForceModels, ElementTangentsAssembleToTheProduct) {
  for (const Body& body : test::all_bodies())
    for (const Eigen::Matrix3Xd& x : states(body)) {
      const auto tangent = make_corotational(body.blocks, body.rest)->tangent(x, Projection::positive_semidefinite);
      const Eigen::Matrix3Xd dx = test::random_vectors(x.cols(), 1, 23);
      Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, x.cols());
      std::size_t visited = 0;
      tangent->element_tangents([&](std::span<const std::uint32_t> nodes, const Eigen::MatrixXd& stiffness) {
        ++visited;
        ASSERT_EQ(stiffness.rows(), static_cast<Eigen::Index>(3 * nodes.size()));
        Eigen::VectorXd local(stiffness.rows());
        for (std::size_t n = 0; n < nodes.size(); ++n)
          local.segment<3>(static_cast<Eigen::Index>(3 * n)) = dx.col(nodes[n]);
        const Eigen::VectorXd force = stiffness * local;
        for (std::size_t n = 0; n < nodes.size(); ++n)
          sum.col(nodes[n]) += force.segment<3>(static_cast<Eigen::Index>(3 * n));
      });
      std::size_t elements = 0;
      for (const ElementBlock& block : body.blocks) elements += block.element_count();
      EXPECT_EQ(visited, elements);
      EXPECT_LE(largest(sum - product_at(*tangent, dx)), 1e-12 * largest(sum)) << body.name;
    }
}

TEST(ForceModels, ProjectedTangentsHaveNoNegativeEigenvalue) {
  bool indefinite_without = false;
  for (const Body& body : test::all_bodies())
    for (const Eigen::Matrix3Xd& x : states(body))
      for (const Projection projection : {Projection::none, Projection::positive_semidefinite})
        make_corotational(body.blocks, body.rest)
            ->tangent(x, projection)
            ->element_tangents([&](std::span<const std::uint32_t>, const Eigen::MatrixXd& stiffness) {
              const Eigen::VectorXd eigenvalues =
                  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness, Eigen::EigenvaluesOnly).eigenvalues();
              const double smallest = eigenvalues[0], bound = 1e-13 * eigenvalues.cwiseAbs().maxCoeff();
              if (projection == Projection::none)
                indefinite_without = indefinite_without || smallest < -1e-3 * eigenvalues.cwiseAbs().maxCoeff();
              else
                EXPECT_GE(smallest, -bound) << body.name;
            });
  EXPECT_TRUE(indefinite_without) << "the states must need the projection";
}

TEST(ForceModels, ProjectionLeavesAStretchedStateAlone) {
  const Body body = test::hexahedra(2, 0.1);
  const Eigen::Matrix3Xd x = 1.05 * body.rest, dx = test::random_vectors(x.cols(), 1, 29);
  const auto model = make_corotational(body.blocks, body.rest);
  const Eigen::Matrix3Xd exact = product_at(*model->tangent(x, Projection::none), dx);
  EXPECT_LE(largest(product_at(*model->tangent(x, Projection::positive_semidefinite), dx) - exact),
            1e-15 * largest(exact));
}

TEST(ForceModels, TangentAtRestEqualsTheLinearStiffness) {
  for (const Body& body : test::all_bodies()) {
    const Eigen::Matrix3Xd dx = test::random_vectors(body.rest.cols(), 1, 31);
    const Eigen::Matrix3Xd linear =
        product_at(*make_linear(body.blocks, body.rest)->tangent(body.rest, Projection::none), dx);
    const Eigen::Matrix3Xd corotational =
        product_at(*make_corotational(body.blocks, body.rest)->tangent(body.rest, Projection::none), dx);
    EXPECT_LE(largest(corotational - linear), 1e-14 * largest(linear)) << body.name;
  }
}

TEST(ForceModels, EachElementHasSixZeroModesAtRest) {
  for (const Body& body : test::all_bodies())
    make_corotational(body.blocks, body.rest)
        ->tangent(body.rest, Projection::none)
        ->element_tangents([&](std::span<const std::uint32_t>, const Eigen::MatrixXd& stiffness) {
          const Eigen::VectorXd eigenvalues =
              Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness, Eigen::EigenvaluesOnly).eigenvalues();
          const double top = eigenvalues[eigenvalues.size() - 1];
          EXPECT_LE(eigenvalues.head(6).cwiseAbs().maxCoeff(), 1e-13 * top) << body.name;
          // 64 B-spline control points: the softest true mode is a corner that the cell hardly feels.
          EXPECT_GE(eigenvalues[6], 1e-10 * top) << body.name;
        });
}

TEST(ForceModels, PatchTestIsExactInsideOfMixedMeshes) {
  Eigen::Matrix3d affine;
  affine << 1.1, 0.05, -0.02, 0.03, 0.95, 0.1, -0.04, 0.02, 1.05;
  std::vector<Body> bodies = {test::hexahedra(4, 0.2), test::pyramids(2, 0.15), test::mixed(4, 0.15),
                              test::irregular_cell(0.05), test::bspline(4, 0)};
  // Unequal layers, sheared: Jacobians that differ from point to point.
  Eigen::Matrix3d shear;
  shear << 1, 0.3, 0, 0.1, 1.2, -0.2, 0, 0.4, 0.9;
  bodies.back().rest = shear * bodies.back().rest;
  for (Body& body : bodies) {
    test::finish(body, 0.3, true);
    ASSERT_FALSE(body.interior.empty()) << body.name;
    for (const bool linear : {false, true}) {
      const auto model = linear ? make_linear(body.blocks, body.rest) : make_corotational(body.blocks, body.rest);
      const Eigen::Matrix3Xd f = forces_at(*model, affine * body.rest);
      const double stress = 100;  // ≈ E · strain, and boundary nodes carry it
      EXPECT_GT(largest(f), 1e-3 * stress) << body.name;
      double residual = 0;
      for (const auto node : body.interior) residual = std::max(residual, f.col(node).cwiseAbs().maxCoeff());
      EXPECT_LE(residual, 1e-13 * stress) << body.name << linear;
    }
  }
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
