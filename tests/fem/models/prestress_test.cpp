// Initial stress: closed forms and finite differences.

#include "fem/models/prestress.h"

#include <gtest/gtest.h>

#include "fem/models/model_table.h"
#include "subdiv/error.h"
#include "tests/fem/assembled_statics.h"
#include "tests/fem/element_bodies.h"

namespace argil::fem {
namespace {

using test::Body;

void set_prestress(Body& body, double stress) {
  for (ElementBlock& block : body.blocks) block.prestress.assign(block.mu.size(), stress);
}

TEST(Prestress, ForcesAndTangentAreDerivativesOfTheEnergy) {
  for (Body& body : std::vector<Body>{test::mixed(2, 0.1), test::bspline(1, 0.1)}) {
    set_prestress(body, 200);
    const auto model = make_model({}, body.blocks, body.rest);
    const Eigen::Matrix3Xd x = 1.1 * body.rest + test::random_vectors(body.rest.cols(), 0.1, 3);
    const Eigen::Matrix3Xd dx = test::random_vectors(x.cols(), 1, 5);
    Eigen::Matrix3Xd f, before, after, product;
    model->forces(x, f);
    const double e = 1e-6;
    const double slope = (model->energy(x + e * dx) - model->energy(x - e * dx)) / (2 * e);
    EXPECT_NEAR(slope, -f.cwiseProduct(dx).sum(), 1e-7 * f.cwiseProduct(dx).cwiseAbs().sum()) << body.name;
    model->forces(x - e * dx, before);
    model->forces(x + e * dx, after);
    const auto tangent = model->tangent(x, Projection::none);
    tangent->stiffness_product(dx, product);
    EXPECT_LE((product - (before - after) / (2 * e)).cwiseAbs().maxCoeff(), 1e-6 * product.cwiseAbs().maxCoeff());
    // One matrix an element, in which the geometric stiffness is.
    Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, x.cols());
    std::size_t visited = 0, elements = 0;
    tangent->element_tangents([&](std::span<const std::uint32_t> nodes, const Eigen::MatrixXd& k) {
      ++visited;
      for (std::size_t a = 0; a < nodes.size(); ++a)
        for (std::size_t b = 0; b < nodes.size(); ++b)
          sum.col(nodes[a]) +=
              k.block<3, 3>(static_cast<Eigen::Index>(3 * a), static_cast<Eigen::Index>(3 * b)) * dx.col(nodes[b]);
    });
    for (const ElementBlock& block : body.blocks) elements += block.element_count();
    EXPECT_EQ(visited, elements);
    EXPECT_LE((sum - product).cwiseAbs().maxCoeff(), 1e-12 * product.cwiseAbs().maxCoeff());
  }
}

TEST(Prestress, CompressionIsProjectedAway) {
  Body body = test::hexahedra(2, 0.1);
  set_prestress(body, -1e5);
  const auto model = make_model({}, body.blocks, body.rest);
  Eigen::Matrix3Xd dx = test::random_vectors(body.rest.cols(), 1, 5), product;
  model->tangent(body.rest, Projection::none)->stiffness_product(dx, product);
  EXPECT_LT(product.cwiseProduct(dx).sum(), 0);
  model->tangent(body.rest, Projection::positive_semidefinite)->stiffness_product(dx, product);
  EXPECT_GT(product.cwiseProduct(dx).sum(), 0);
}

TEST(Prestress, FreeBodyShrinksToTheClosedForm) {
  // St. Venant–Kirchhoff under isotropic s: stretch l in all directions with (3λ + 2μ) (l² − 1)/2 + s = 0.
  Body body = test::hexahedra(2, 0.1);
  test::finish(body, 0.3, true);
  const double s = 150;
  set_prestress(body, s);
  const double mu = body.blocks[0].mu[0], lambda = body.blocks[0].lambda[0];
  const double stretch = std::sqrt(1 - 2 * s / (3 * lambda + 2 * mu));
  const auto model = make_model({"st_venant_kirchhoff"}, body.blocks, body.rest);
  test::Held held = test::Held::Constant(3, body.rest.cols(), false);
  // Six coordinates hold the rigid motions: node 0 whole, and corners on two axes from it.
  const Eigen::Index along_z = 2, along_y = 6;  // of the 3³ nodes
  held.col(0).setConstant(true);
  held(0, along_z) = held(1, along_z) = held(0, along_y) = true;
  Eigen::Matrix3Xd x = stretch * (body.rest.colwise() - Eigen::Vector3d(body.rest.col(0)));
  Eigen::Matrix3Xd f;
  model->forces(x, f);
  EXPECT_LE(f.cwiseAbs().maxCoeff(), 1e-12 * s);
  // And Newton finds it from the rest shape, but for the turn of that frame.
  x = test::equilibrium(*model, held, Eigen::Matrix3Xd::Zero(3, x.cols()), body.rest);
  const auto distance = [&](const Eigen::Matrix3Xd& y, Eigen::Index i, Eigen::Index j) {
    return (y.col(i) - y.col(j)).norm();
  };
  for (Eigen::Index i = 1; i < x.cols(); ++i)
    EXPECT_NEAR(distance(x, 0, i), stretch * distance(body.rest, 0, i), 1e-8);
}

TEST(Prestress, ClampedBarStiffensAsAString) {
  // A slender bar, its ends held, under tension N = s A along it and a small transverse load q per length: the beam
  // under tension, E I w″″ − N w″ = q; for N l² ≫ E I the string's q l²/(8 N).
  const int n = 40;
  const double length = 10, width = 0.25, young = 1000, stress = 400;
  Body body = test::grid_body("bar", 1, 0, [](int) { return false; });
  body.blocks.resize(1);
  body.blocks[0] = {};
  body.blocks[0].kind = &trilinear_hexahedron();
  body.rest.resize(3, 4 * (n + 1));
  for (int i = 0; i <= n; ++i)
    for (int c = 0; c < 4; ++c) body.rest.col(4 * i + c) << length * i / n, width * (c >> 1), width * (c & 1);
  for (std::uint32_t i = 0; i < n; ++i)
    test::add_element(body.blocks[0],
                      {4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3, 4 * i + 4, 4 * i + 5, 4 * i + 6, 4 * i + 7});
  test::finish(body, 0.0, true);
  for (double& mu : body.blocks[0].mu) mu = young / 2;
  for (double& lambda : body.blocks[0].lambda) lambda = 0;
  Eigen::Matrix3d tension = Eigen::Matrix3d::Zero();
  tension(0, 0) = stress;
  InitialStresses stresses{std::vector<Eigen::Matrix3d>(body.blocks[0].mu.size(), tension)};
  const auto model =
      make_prestressed(make_model({"linear", Formulation::incompatible_modes}, body.blocks, body.rest), body.blocks,
                       body.rest, stresses);
  test::Held held = test::Held::Constant(3, body.rest.cols(), false);
  Eigen::Matrix3Xd loads = Eigen::Matrix3Xd::Zero(3, body.rest.cols());
  const double q = 1e-3;
  for (Eigen::Index i = 0; i < body.rest.cols(); ++i) {
    if (i < 4 || i >= 4 * n) held.col(i).setConstant(true);
    loads(2, i) = -q * length / n / 4;
  }
  const Eigen::Matrix3Xd x = test::equilibrium(*model, held, loads, body.rest);
  const double found = body.rest(2, 2 * n) - x(2, 2 * n);
  // Clamped beam under tension, k² = N/(E I): w = q l²/(8N) − (q l/(2 N k)) tanh(k l/4).
  const double area = width * width, inertia = area * area / 12, force = stress * area;
  const double k = std::sqrt(force / (young * inertia));
  const double string = q * length * length / (8 * force);
  const double beam = string - q * length / (2 * force * k) * std::tanh(k * length / 4);
  std::printf("bar under tension: %.6f, beam %.6f, string %.6f, slack beam %.6f\n", found, beam, string,
              q * std::pow(length, 4) / (384 * young * inertia));
  EXPECT_NEAR(found, beam, 0.01 * beam);  // the beam has no shear, which gives 0.6 % here
  EXPECT_LT(found, 0.2 * q * std::pow(length, 4) / (384 * young * inertia));
}

}  // namespace
}  // namespace argil::fem
