// Ten-node tetrahedra as a reference from outside.

#include "fem/discretization/quadratic_tetrahedra.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "fem/elements/quadratic_tetrahedron.h"
#include "fem/loads.h"
#include "fem/models/model_table.h"
#include "tests/fem/element_bodies.h"
#include "tests/fem/simulated_solid.h"

namespace argil::fem {
namespace {

NodalFields fields_of(const subdiv::Built& built, const test::Material& material) {
  const auto n = static_cast<Eigen::Index>(built.solid.vertex_capacity());
  return {Eigen::VectorXd::Constant(n, material.young_modulus),
          Eigen::VectorXd::Constant(n, material.poisson_ratio), Eigen::VectorXd::Constant(n, material.density),
          Eigen::VectorXd::Constant(n, material.damping)};
}

/// A box whose vertices are moved at random.
subdiv::Built distorted_box(int n, double distortion) {
  subdiv::Built built = subdiv::box_grid(n, n, n, {1, 1, 1});
  built.positions += test::random_vectors(built.positions.cols(), distortion / n, 7);
  return built;
}

TEST(QuadraticTetrahedron, ShapesAreOneAtTheirNodesAndSumToOne) {
  const Eigen::Vector3d corners[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  constexpr int k_edges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
  Eigen::VectorXd shapes, before, after;
  Eigen::Matrix3Xd slopes, unused;
  for (int node = 0; node < 10; ++node) {
    const Eigen::Vector3d at =
        node < 4 ? corners[node] : 0.5 * (corners[k_edges[node - 4][0]] + corners[k_edges[node - 4][1]]);
    quadratic_tetrahedron().evaluate(at, shapes, slopes);
    for (int other = 0; other < 10; ++other) EXPECT_NEAR(shapes[other], other == node, 1e-15);
  }
  const Eigen::Vector3d at(0.2, 0.3, 0.1);
  quadratic_tetrahedron().evaluate(at, shapes, slopes);
  EXPECT_NEAR(shapes.sum(), 1, 1e-15);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(axis);
    quadratic_tetrahedron().evaluate(at - step, before, unused);
    quadratic_tetrahedron().evaluate(at + step, after, unused);
    EXPECT_LE(((after - before) / 2e-6 - slopes.row(axis).transpose()).norm(), 1e-9);
  }
}

TEST(QuadraticTetrahedra, VolumeMassAndZeroModes) {
  const subdiv::Built built = distorted_box(2, 0.1);
  const Discretization d = quadratic_tetrahedra(built.solid, built.positions, fields_of(built, {1000, 0.3, 7, 0}));
  EXPECT_EQ(d.blocks[0].element_count(), 8u * 24u);
  double volume = 0;  // by the divergence theorem over the boundary's triangles
  const ElementBlock& block = d.blocks[0];
  for (const double v : block.volumes) volume += v;
  EXPECT_NEAR(d.rest_volume, volume, 1e-14);
  EXPECT_NEAR(volume, 1, 0.2);
  EXPECT_NEAR(d.total_mass, 7 * volume, 1e-12);
  // Moments of a quadratic field are exact: xᵀ M x = ρ ∫ x².
  const subdiv::Built box = subdiv::box_grid(2, 1, 1, {2, 1, 1});
  const Discretization exact = quadratic_tetrahedra(box.solid, box.positions, fields_of(box, {1000, 0.3, 3, 0}));
  const Eigen::VectorXd x = exact.rest_nodes.row(0).transpose(), square = x.cwiseProduct(x);
  EXPECT_NEAR(x.dot(exact.mass * x), 3 * 8.0 / 3, 1e-12);
  EXPECT_NEAR(square.dot(exact.mass * square), 3 * 32.0 / 5, 1e-12);  // degree four: four points would miss it
  for (const std::string name : {"corotational", "stable_neo_hookean", "neo_hookean", "warped_stiffness"})
    make_model({name}, d.blocks, d.rest_nodes)
        ->tangent(d.rest_nodes, Projection::none)
        ->element_tangents([&](std::span<const std::uint32_t>, const Eigen::MatrixXd& k) {
          const Eigen::VectorXd values =
              Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();
          EXPECT_LE(values.head(6).cwiseAbs().maxCoeff(), 1e-12 * values[29]) << name;
          EXPECT_GE(values[6], 1e-6 * values[29]) << name;
        });
}

TEST(QuadraticTetrahedra, PatchTestIsExact) {
  const subdiv::Built built = distorted_box(3, 0.15);
  const Discretization d = quadratic_tetrahedra(built.solid, built.positions, fields_of(built, {}));
  Eigen::Matrix3d affine;
  affine << 1.1, 0.05, -0.02, 0.03, 0.95, 0.1, -0.04, 0.02, 1.05;
  for (const std::string name :
       {"corotational", "linear", "stable_neo_hookean", "neo_hookean", "st_venant_kirchhoff"}) {
    Eigen::Matrix3Xd f;
    make_model({name}, d.blocks, d.rest_nodes)->forces(affine * d.rest_nodes, f);
    double inside = 0;
    for (Eigen::Index i = 0; i < f.cols(); ++i) {
      const Eigen::Vector3d x = d.rest_nodes.col(i);  // moved by up to 0.05 near the sides
      if (x.minCoeff() > 0.12 && x.maxCoeff() < 0.88) inside = std::max(inside, f.col(i).cwiseAbs().maxCoeff());
    }
    EXPECT_GT(f.cwiseAbs().maxCoeff(), 0.1);
    EXPECT_LE(inside, 1e-12) << name;
  }
}

TEST(QuadraticTetrahedra, CantileverIsWithinOnePerCentOfTheLimit) {
  // REFERENCES §1, by the integrator, the loads and the models that every other space uses.
  const subdiv::Built built = subdiv::box_grid(8, 2, 2, {0.4, 0.1, 0.1});
  const Discretization d =
      quadratic_tetrahedra(built.solid, built.positions, fields_of(built, {1000, 0.3, 1.25, 0}));
  const auto tip = [&](const std::string& name) {
    const auto model = make_model({name}, d.blocks, d.rest_nodes);
    System system;
    system.rows = &d.nodes.rows;
    system.rows_transposed = &d.rows_transposed;
    system.model = model.get();
    system.rest_nodes = &d.rest_nodes;
    system.mass = &d.mass;
    system.damping = &d.damping;
    system.fixed.assign(d.nodes.node_count(), 0);
    std::size_t centre = 0;
    for (std::size_t i = 0; i < system.fixed.size(); ++i) {
      const Eigen::Vector3d x = d.rest_nodes.col(static_cast<Eigen::Index>(i));
      system.fixed[i] = x.x() < 1e-9;
      if ((x - Eigen::Vector3d(0.4, 0.05, 0.05)).norm() < 1e-9) centre = i;
    }
    BodyState state;
    state.positions = d.rest_nodes;
    state.velocities.setZero(3, d.rest_nodes.cols());
    Integrator integrator(system);
    integrator.solve_static({gravity_forces(d, {0, 0, -9.81}), {}}, state, {});
    const Eigen::Vector3d moved = state.positions.col(static_cast<Eigen::Index>(centre)) -
                                  d.rest_nodes.col(static_cast<Eigen::Index>(centre));
    std::printf("quadratic tetrahedra 8x2x2, %s: u_z %.6f u_x %.6f\n", name.c_str(), moved.z(), moved.x());
    return moved;
  };
  EXPECT_NEAR(-tip("linear").z(), 0.04910, 0.01 * 0.04910);
  const Eigen::Vector3d nonlinear = tip("st_venant_kirchhoff");
  EXPECT_NEAR(-nonlinear.z(), 0.04866, 0.01 * 0.04866);
  EXPECT_NEAR(nonlinear.x(), -0.003318, 0.02 * 0.003318);
}

}  // namespace
}  // namespace argil::fem
