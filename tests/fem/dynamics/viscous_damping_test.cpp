#include "fem/dynamics/viscous_damping.h"

#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "fem/measure/energy.h"
#include "fem/solvers/rest_operator.h"
#include "tests/fem/element_bodies.h"
#include "tests/fem/simulated_solid.h"

namespace argil::fem {
namespace {

using test::SimulatedSolid;

void damp(test::Body& body, double seconds) {
  for (ElementBlock& block : body.blocks) block.stiffness_damping.assign(block.volumes.size(), seconds);
}

TEST(ViscousDamping, AtRestItIsStiffnessTimesItsField) {
  for (test::Body body : test::all_bodies()) {
    SCOPED_TRACE(body.name);
    damp(body, 0.25);
    const auto nodes = static_cast<std::size_t>(body.rest.cols());
    ViscousDamping viscous(body.blocks, nodes);
    ASSERT_TRUE(viscous.present());
    viscous.set_state(body.rest);
    const auto model = make_linear(body.blocks, body.rest);
    const auto tangent = model->tangent(body.rest, Projection::none);
    const Eigen::Matrix3Xd v = test::random_vectors(body.rest.cols(), 1, 11);
    Eigen::Matrix3Xd damping, stiffness, assembled = Eigen::Matrix3Xd::Zero(3, v.cols());
    viscous.product(v, damping);
    tangent->stiffness_product(v, stiffness);
    EXPECT_LE((damping - 0.25 * stiffness).norm(), 1e-12 * stiffness.norm());
    viscous.element_matrices([&](std::span<const std::uint32_t> element, const Eigen::MatrixXd& matrix) {
      for (std::size_t a = 0; a < element.size(); ++a)
        for (std::size_t b = 0; b < element.size(); ++b)
          assembled.col(element[a]) +=
              matrix.block<3, 3>(static_cast<Eigen::Index>(3 * a), static_cast<Eigen::Index>(3 * b)) *
              v.col(element[b]);
    });
    EXPECT_LE((damping - assembled).norm(), 1e-12 * damping.norm());
  }
}

TEST(ViscousDamping, NeitherSlowsARigidMotionNorPushesAnywhere) {
  for (test::Body body : test::all_bodies()) {
    SCOPED_TRACE(body.name);
    damp(body, 1);
    ViscousDamping viscous(body.blocks, static_cast<std::size_t>(body.rest.cols()));
    const Eigen::Matrix3Xd x =
        test::rotation(2, {1, 2, 3}) * body.rest + test::random_vectors(body.rest.cols(), 0.2, 12);
    viscous.set_state(x);
    Eigen::Matrix3Xd rigid(3, x.cols()), force;
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      rigid.col(i) = Eigen::Vector3d(3, -1, 2) + Eigen::Vector3d(-1, 4, 2).cross(x.col(i));
    viscous.product(rigid, force);
    // E h² v/h of these bodies is some 1e3; deformed by 20 % of their size.
    EXPECT_LE(force.cwiseAbs().maxCoeff(), 1e-11 * 1000);

    const Eigen::Matrix3Xd v = test::random_vectors(x.cols(), 1, 13), w = test::random_vectors(x.cols(), 1, 14);
    Eigen::Matrix3Xd other;
    viscous.product(v, force);
    viscous.product(w, other);
    EXPECT_GT(force.cwiseProduct(v).sum(), 0);  // takes energy
    EXPECT_NEAR(force.cwiseProduct(w).sum(), other.cwiseProduct(v).sum(), 1e-12 * force.norm() * w.norm());
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
      sum += force.col(i);
      moment += Eigen::Vector3d(x.col(i)).cross(Eigen::Vector3d(force.col(i)));
    }
    EXPECT_LE(sum.norm(), 1e-12 * force.norm() * std::sqrt(static_cast<double>(x.cols())));
    EXPECT_LE(moment.norm(), 1e-11 * force.norm() * x.norm());
  }
}

TEST(ViscousDamping, ThreadsDoNotChangeBits) {
  test::Body body = test::hexahedra(6, 0.2);
  damp(body, 0.1);
  const Eigen::Matrix3Xd v = test::random_vectors(body.rest.cols(), 1, 15);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    ViscousDamping viscous(body.blocks, static_cast<std::size_t>(body.rest.cols()));
    viscous.set_state(body.rest + 0.1 * v);
    Eigen::Matrix3Xd result;
    viscous.product(v, result);
    return result;
  };
  EXPECT_EQ(run(1), run(2));
}

/// Rate at which the first mode of a cantilever dies away, over β ω²/2, with β of that share of critical damping.
double decay(Method method, int steps_a_period, double ratio = 0.02) {
  SimulatedSolid solid(test::box(6, 1, 1, {0.6, 0.1, 0.1}), 0, {1e5, 0.3, 1000, 0}, {}, true);
  const auto held = [](const Eigen::Vector3d& x) { return x.x() < 1e-9; };
  solid.fix(held);
  const RestOperator rest = rest_operator(solid.system, true);
  const Eigen::SparseMatrix<double> full = rest.stiffness.selfadjointView<Eigen::Lower>();
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
    if (!solid.system.fixed[static_cast<std::size_t>(i)]) free.push_back(i);
  const auto n = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd stiffness(3 * n, 3 * n), mass = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      for (Eigen::Index r = 0; r < 3; ++r) {
        const Eigen::Index a = free[static_cast<std::size_t>(i)], b = free[static_cast<std::size_t>(j)];
        for (Eigen::Index s = 0; s < 3; ++s) stiffness(3 * i + r, 3 * j + s) = full.coeff(3 * a + r, 3 * b + s);
        mass(3 * i + r, 3 * j + r) = solid.discretization.mass.coeff(a, b);
      }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness, mass);
  const double frequency = std::sqrt(modes.eigenvalues()[0]), beta = 2 * ratio / frequency;
  // Small: the viscous stress is linear in small strain only.
  for (Eigen::Index i = 0; i < n; ++i)
    solid.state.positions.col(free[static_cast<std::size_t>(i)]) +=
        1e-4 * modes.eigenvectors().col(0).segment<3>(3 * i);
  solid.fields.stiffness_damping = Eigen::VectorXd::Constant(solid.fields.young_modulus.size(), beta);
  EXPECT_TRUE(update_fields(solid.discretization, solid.refinement, solid.fields));
  const auto total = [&] {
    const Energy parts = energy(solid.system, solid.state);
    return parts.kinetic + parts.elastic;
  };
  const double begin = total();
  Integrator integrator(solid.system);
  StepOptions options;
  options.method = method;
  options.spectral_radius = 1;
  options.newton_tolerance = 1e-9;
  options.linear_tolerance = 1e-8;
  const double period = 2 * std::numbers::pi / frequency;
  for (int i = 0; i < 3 * steps_a_period; ++i)
    static_cast<void>(integrator.step({}, solid.state, period / steps_a_period, options));
  return std::log(begin / total()) / (beta * frequency * frequency * 3 * period);
}

TEST(ViscousDamping, FirstModeDecaysAtHalfBetaOmegaSquared) {
  // Energy decays at β ω². The time step adds (ωh)²/12 ≈ 0.2 % at 40 steps a period.
  EXPECT_NEAR(decay(Method::generalised_alpha, 40), 1, 0.02);
  EXPECT_NEAR(decay(Method::bdf2, 1000), 1, 0.02);
  // The highest frequency is some 100 times the first, and explicit damping wants β ω² h < 2 of it.
  EXPECT_NEAR(decay(Method::velocity_verlet, 1500, 0.005), 1, 0.02);
  EXPECT_NEAR(decay(Method::central_difference, 1500, 0.005), 1, 0.02);
}

/// Kinetic energy that a spinning free bar keeps, with and without damping.
double kept_energy(Method method, double beta, double time_step) {
  SimulatedSolid solid(test::box(4, 1, 1, {0.4, 0.1, 0.1}), 1, {1e5, 0.3, 1000, 0});
  if (beta > 0) {
    solid.fields.stiffness_damping = Eigen::VectorXd::Constant(solid.fields.young_modulus.size(), beta);
    EXPECT_TRUE(update_fields(solid.discretization, solid.refinement, solid.fields));
  }
  const Eigen::Vector3d centre(0.2, 0.05, 0.05), spin(0, 0, 10);
  for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
    solid.state.velocities.col(i) = spin.cross(solid.rest.col(i) - centre);
  const double start = energy(solid.system, solid.state).kinetic;
  Integrator integrator(solid.system);
  StepOptions options;
  options.method = method;
  const int steps = static_cast<int>(std::lround(0.5 / time_step));
  for (int i = 0; i < steps; ++i) static_cast<void>(integrator.step({}, solid.state, time_step, options));
  return energy(solid.system, solid.state).kinetic / start;
}

TEST(ViscousDamping, FreeSpinIsNotDamped) {
  // β = 5 ms is half of critical damping for the bar's first bending mode. It takes the swinging that the sudden
  // spin begins (some 1 % of the energy), and no more of the spin.
  for (const Method method : {Method::bdf2, Method::implicit_euler, Method::generalised_alpha}) {
    SCOPED_TRACE(method_kind(method).name);
    EXPECT_NEAR(kept_energy(method, 0.005, 1.0 / 60), kept_energy(method, 0, 1.0 / 60), 0.02);
  }
}

}  // namespace
}  // namespace argil::fem
