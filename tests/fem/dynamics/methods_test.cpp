// Orders of convergence of every method, and what METHODS §5 says of each.

#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>

#include "fem/loads.h"
#include "fem/measure/energy.h"
#include "fem/solvers/mass_factor.h"
#include "fem/solvers/rest_operator.h"
#include "subdiv/error.h"
#include "tests/fem/dynamics/tight_steps.h"
#include "tests/fem/simulated_solid.h"
#include "tests/fem/spring_model.h"

namespace argil::fem {
namespace {

using test::SimulatedSolid;
using test::tight;

/// A bar held at one end, thrown sideways and stretched so that it turns by some 20° and strains by some 15 %, with
/// gravity, a spring at its tip and both kinds of damping.
class ThrownBar {
 public:
  ThrownBar() : solid_(test::box(4, 1, 1, {0.4, 0.1, 0.1}), 0, {1e4, 0.3, 1000, 2}) {
    solid_.fields.stiffness_damping = Eigen::VectorXd::Constant(solid_.rest.cols(), 2e-4);
    EXPECT_TRUE(update_fields(solid_.discretization, solid_.refinement, solid_.fields));
    solid_.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
    for (Eigen::Index i = 0; i < solid_.rest.cols(); ++i) {
      const double x = solid_.rest(0, i) / 0.4;
      solid_.state.velocities.col(i) = x * x * Eigen::Vector3d(0.6, 0.5, 1.5);
    }
    loads_.forces = gravity_forces(solid_.discretization, {0, 0, -9.81});
    const auto tip = static_cast<std::uint32_t>(solid_.rest.cols() - 1);
    loads_.springs.push_back({{tip}, {1.0}, solid_.rest.col(tip) + Eigen::Vector3d(0, 0.05, 0), 40});
  }
  Eigen::Matrix3Xd positions(Method method, int steps) {
    BodyState state = solid_.state;
    Integrator integrator(solid_.system);
    for (int i = 0; i < steps; ++i) static_cast<void>(integrator.step(loads_, state, 0.12 / steps, tight(method)));
    return state.positions;
  }
  const Eigen::Matrix3Xd& rest() const { return solid_.rest; }

 private:
  SimulatedSolid solid_;
  Loads loads_;
};

TEST(Methods, ConvergeWithTheirOrderToOneMotion) {
  ThrownBar bar;
  // Steps at which the next term of the error is small: the highest frequency of the bar is some 170 rad/s, and of
  // forward Euler the error of mode ω grows as exp(ω² h t/2).
  const std::map<Method, int> coarsest{{Method::bdf2, 200},
                                       {Method::implicit_euler, 400},
                                       {Method::semi_implicit, 400},
                                       {Method::generalised_alpha, 100},
                                       {Method::central_difference, 100},
                                       {Method::forward_euler, 3200},
                                       {Method::symplectic_euler, 800},
                                       {Method::velocity_verlet, 100},
                                       {Method::midpoint, 200}};
  const Eigen::Matrix3Xd reference = bar.positions(Method::velocity_verlet, 3200);
  const double motion = (reference - bar.rest()).norm();
  ASSERT_GT(motion, 0.2);
  for (const MethodKind& kind : method_table()) {
    if (kind.order == 0) continue;  // not to the motion
    SCOPED_TRACE(kind.name);
    ASSERT_TRUE(coarsest.contains(kind.method));
    const int steps = coarsest.at(kind.method);
    const Eigen::Matrix3Xd once = bar.positions(kind.method, steps), twice = bar.positions(kind.method, 2 * steps),
                           again = bar.positions(kind.method, 4 * steps);
    const double order = std::log2((once - twice).norm() / (twice - again).norm());
    EXPECT_NEAR(order, kind.order, 0.15);  // the error's next term is some 5 to 10 % of the first
    // Extrapolated with that order the motion is the reference's to a few parts in 1e4.
    const double share = 1.0 / (std::pow(2.0, kind.order) - 1);
    EXPECT_LE((again + share * (again - twice) - reference).norm(), 1e-3 * motion);
    RecordProperty(std::string(kind.name), std::to_string(order));
  }
}

/// Dense stiffness and mass of a linear body in its free control points.
struct Pencil {
  Eigen::MatrixXd stiffness, mass;
  explicit Pencil(const SimulatedSolid& solid) {
    const RestOperator rest = rest_operator(solid.system, true);
    std::vector<Eigen::Index> free;
    for (std::size_t i = 0; i < solid.system.fixed.size(); ++i)
      if (!solid.system.fixed[i]) free.push_back(static_cast<Eigen::Index>(i));
    const Eigen::SparseMatrix<double> full = rest.stiffness.selfadjointView<Eigen::Lower>();
    const Eigen::MatrixXd k(full), m(solid.discretization.mass);
    const auto n = static_cast<Eigen::Index>(free.size());
    stiffness.resize(3 * n, 3 * n);
    mass.setZero(3 * n, 3 * n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) {
        const Eigen::Index a = free[static_cast<std::size_t>(i)], b = free[static_cast<std::size_t>(j)];
        stiffness.block<3, 3>(3 * i, 3 * j) = k.block<3, 3>(3 * a, 3 * b);
        for (int axis = 0; axis < 3; ++axis) mass(3 * i + axis, 3 * j + axis) = m(a, b);
      }
  }
  double highest_frequency() const {
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness, mass, Eigen::EigenvaluesOnly);
    return std::sqrt(modes.eigenvalues().tail<1>()[0]);
  }
};

void shake(SimulatedSolid& solid, double size) {
  for (Eigen::Index i = 0; i < solid.rest.size(); ++i)
    solid.state.positions.data()[i] += size * std::sin(7.0 * static_cast<double>(i * i + 3 * i));
}

/// Largest displacement after some steps at a share of 2/ω_max, from a small random one; infinite if not finite.
double reached(Method method, double share, int steps) {
  SimulatedSolid solid(test::box(2, 2, 2, {0.2, 0.2, 0.2}), 1, {1e4, 0.3, 1000, 0}, {}, true);
  solid.fix([](const Eigen::Vector3d& x) { return x.z() < 1e-9; });
  const double h = share * 2 / Pencil(solid).highest_frequency();
  shake(solid, 1e-4);
  for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
    if (solid.system.fixed[static_cast<std::size_t>(i)]) solid.state.positions.col(i) = solid.rest.col(i);
  Integrator integrator(solid.system);
  try {
    for (int i = 0; i < steps; ++i) static_cast<void>(integrator.step({}, solid.state, h, tight(method)));
  } catch (const Error&) {
    return INFINITY;
  }
  return (solid.state.positions - solid.rest).cwiseAbs().maxCoeff();
}

TEST(Methods, ExplicitOnesAreStableUpToTwoOverTheHighestFrequency) {
  // At 0.99 of the limit the highest mode swings by at most 1/√(1 − 0.99²) = 7 times its start; at 1.01 it grows by
  // (1.01 + √(1.01² − 1))² = 1.33 a step. So the limit lies within 1 % of 2/ω_max of the pencil in use.
  for (const Method method : {Method::central_difference, Method::symplectic_euler, Method::velocity_verlet}) {
    SCOPED_TRACE(method_kind(method).name);
    EXPECT_LT(reached(method, 0.99, 4000), 5e-3);
    EXPECT_GT(reached(method, 1.01, 400), 1e10);
  }
  EXPECT_EQ(reached(Method::central_difference, 1.01, 4000), INFINITY);
}

TEST(Methods, HighestFrequencyIsThatOfTheTable) {
  // METHODS §5, consistent trilinear mass: ω² = κ E/(ρ h²), one free cell κ = 30 at ν = 0.3 and 600 at 0.49; bodies
  // of four and more cells 26.7 and 365. Found 27.2, 26.4, 26.0, 25.8 and 385, 369, 366, 364 with 4, 6, 8, 10
  // cells.
  const auto kappa = [](int n, double poisson_ratio) {
    SimulatedSolid solid(test::box(n, n, n, {0.1 * n, 0.1 * n, 0.1 * n}), 0, {1e4, poisson_ratio, 1000, 0}, {},
                         true);
    const std::vector<std::uint8_t> free(solid.system.fixed.size(), 1);
    const MassFactor mass(solid.discretization.mass, free);
    const auto tangent = solid.model->tangent(solid.discretization.rest_nodes, Projection::none);
    Eigen::Matrix3Xd v(3, solid.rest.cols()), forces;
    for (Eigen::Index i = 0; i < v.size(); ++i) v.data()[i] = std::sin(7.0 * static_cast<double>(i * i + i));
    double square = 0;
    for (int i = 0; i < 1500; ++i) {
      v /= v.norm();
      tangent->stiffness_product(nodes(solid.system, v), forces);
      v = mass.solve(generalised_forces(solid.system, forces));
      square = v.norm();
    }
    return square * 1000 * 0.01 / 1e4;
  };
  EXPECT_NEAR(kappa(1, 0.3), 30, 0.5);
  EXPECT_NEAR(kappa(1, 0.49), 600, 10);
  EXPECT_NEAR(kappa(4, 0.3), 27.17, 0.1);
  EXPECT_NEAR(kappa(6, 0.3), 26.4, 0.1);
  EXPECT_NEAR(kappa(6, 0.49), 369.4, 1);
}

/// Energy of a freely swinging linear body after some steps over its first.
double energy_ratio(Method method, double share, int steps) {
  SimulatedSolid solid(test::box(2, 2, 2, {0.2, 0.2, 0.2}), 1, {1e4, 0.3, 1000, 0}, {}, true);
  shake(solid, 1e-4);
  const double h = share * 2 / Pencil(solid).highest_frequency();
  const auto total = [&] {
    const Energy parts = energy(solid.system, solid.state);
    return parts.kinetic + parts.elastic;
  };
  const double begin = total();
  Integrator integrator(solid.system);
  for (int i = 0; i < steps; ++i) static_cast<void>(integrator.step({}, solid.state, h, tight(method)));
  return total() / begin;
}

/// The scheme of papers/004 is central difference in parts, with a damping of its own.
TEST(Methods, PublishedSchemeIsDampedCentralDifferenceInParts) {
  const auto body = [](double damping) {
    auto solid = std::make_unique<SimulatedSolid>(test::box(2, 2, 2, {0.2, 0.2, 0.2}), 0,
                                                  test::Material{1e4, 0.3, 1000, damping});
    solid->fix([](const Eigen::Vector3d& x) { return x.z() < 1e-9; });
    for (Eigen::Index i = 0; i < solid->rest.cols(); ++i) solid->state.velocities(0, i) = 0.3 * solid->rest(2, i);
    return solid;
  };
  const auto published = body(0.7);  // [1/s], its own damping on top
  const double highest = Pencil(*published).highest_frequency();
  const auto by_hand = body(0.7 + 0.1 * highest);
  Loads loads{gravity_forces(published->discretization, {0, 0, -9.81}), {}};
  Integrator one(published->system), other(by_hand->system);
  StepOptions options = tight(Method::published), central = tight(Method::central_difference);
  const double h = 10.3 * 0.4 * 2 / highest;  // eleven parts
  for (int i = 0; i < 20; ++i) {
    static_cast<void>(one.step(loads, published->state, h, options));
    for (int part = 0; part < 11; ++part) static_cast<void>(other.step(loads, by_hand->state, h / 11, central));
  }
  const double moved = (by_hand->state.positions - by_hand->rest).norm();
  ASSERT_GT(moved, 1e-3);
  // The frequency is known to 1e-3 of its square.
  EXPECT_LT((published->state.positions - by_hand->state.positions).norm(), 1e-3 * moved);
  EXPECT_NEAR(published->state.time, 20 * h, 1e-12);

  // A spring a hundred times stiffer than the body asks for shorter parts, and another method after it is as ever.
  loads.springs.push_back({{26}, {1.0}, published->rest.col(26), 1e5});
  for (int i = 0; i < 50; ++i) static_cast<void>(one.step(loads, published->state, h, options));
  EXPECT_LT((published->state.positions - published->rest).cwiseAbs().maxCoeff(), 0.05);
  const auto fresh = body(0.7);
  Integrator unused(fresh->system);
  fresh->state = published->state;
  static_cast<void>(one.step(loads, published->state, 1e-5, central));
  static_cast<void>(unused.step(loads, fresh->state, 1e-5, central));
  EXPECT_EQ(published->state.positions, fresh->state.positions);
}

TEST(Methods, PublishedSchemeRefusesStepsOfTooManyParts) {
  SimulatedSolid solid(test::box(1, 1, 1, {0.1, 0.1, 0.1}), 0, {1e9, 0.3, 1000, 0});
  solid.state.velocities.setConstant(0.1);
  const BodyState before = solid.state;
  Integrator integrator(solid.system);
  try {
    static_cast<void>(integrator.step({}, solid.state, 1, tight(Method::published)));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::limit_exceeded);
    EXPECT_THAT(error.what(), testing::HasSubstr("implicit"));
  }
  EXPECT_EQ(solid.state.positions, before.positions);
  EXPECT_EQ(solid.state.time, 0);
  // With nothing to move there is nothing to find.
  solid.fix([](const Eigen::Vector3d&) { return true; });
  Integrator held(solid.system);
  static_cast<void>(held.step({}, solid.state, 1, tight(Method::published)));
  EXPECT_EQ(solid.state.positions, before.positions);
}

TEST(Methods, MidpointAndForwardEulerGainEnergy) {
  // A mode gains (ωh)⁴/4 a step by the midpoint rule: METHODS §5 saw ×1.4 … ×429. Verlet of the same cost keeps it.
  const double gentle = energy_ratio(Method::midpoint, 0.15, 500), rough = energy_ratio(Method::midpoint, 0.3, 300);
  EXPECT_GT(gentle, 1.2);
  EXPECT_GT(rough, 10);
  EXPECT_GT(energy_ratio(Method::forward_euler, 0.02, 500), 1.4);
  EXPECT_NEAR(energy_ratio(Method::velocity_verlet, 0.3, 300), 1, 0.1);
  RecordProperty("midpoint_gentle", std::to_string(gentle));
  RecordProperty("midpoint_rough", std::to_string(rough));
}

TEST(Methods, VelocityVerletKeepsEnergyToSecondOrder) {
  const auto swing = [](int steps) {
    SimulatedSolid solid(test::box(3, 1, 1, {0.3, 0.1, 0.1}), 0, {1e4, 0.3, 1000, 0});
    for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
      solid.state.velocities.col(i) = Eigen::Vector3d(2 * solid.rest(0, i), solid.rest(0, i), 0);
    Integrator integrator(solid.system);
    const double begin = energy(solid.system, solid.state).kinetic;
    double worst = 0;
    for (int i = 0; i < steps; ++i) {
      static_cast<void>(integrator.step({}, solid.state, 1.0 / steps, tight(Method::velocity_verlet)));
      const Energy now = energy(solid.system, solid.state);
      worst = std::max(worst, std::abs(now.kinetic + now.elastic - begin) / begin);
    }
    return worst;
  };
  const double coarse = swing(400), fine = swing(800);
  EXPECT_LT(coarse, 0.05);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.15);  // of a maximum over the run, sampled at the steps
}

/// Share of the angular momentum that a bar keeps that spins at 10 rad/s for half a second (METHODS §5).
double kept_spin(Method method, double time_step, double young_modulus = 1e5) {
  SimulatedSolid solid(test::box(4, 1, 1, {0.4, 0.1, 0.1}), 1, {young_modulus, 0.3, 1000, 0});
  const Eigen::Vector3d centre(0.2, 0.05, 0.05), spin(0, 0, 10);
  for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
    solid.state.velocities.col(i) = spin.cross(solid.rest.col(i) - centre);
  const double start = momentum(solid.system, solid.state).angular.z();
  Integrator integrator(solid.system);
  StepOptions options;
  options.method = method;
  const int steps = static_cast<int>(std::lround(0.5 / time_step));
  for (int i = 0; i < steps; ++i) static_cast<void>(integrator.step({}, solid.state, time_step, options));
  return momentum(solid.system, solid.state).angular.z() / start;
}

TEST(Methods, FreeSpinTellsThemApart) {
  EXPECT_NEAR(kept_spin(Method::bdf2, 1.0 / 60), 0.96, 0.02);
  EXPECT_NEAR(kept_spin(Method::implicit_euler, 1.0 / 60), 0.65, 0.03);
  // One linear solve from where the body is stretches it along the tangent of its path and brakes it the more, the
  // stiffer it is: METHODS §5 says 0.10 and not for what; that is found between 1 and 2 MPa.
  EXPECT_NEAR(kept_spin(Method::semi_implicit, 1.0 / 60, 1e4), 0.61, 0.02);
  EXPECT_NEAR(kept_spin(Method::semi_implicit, 1.0 / 60, 1e5), 0.34, 0.02);
  EXPECT_NEAR(kept_spin(Method::semi_implicit, 1.0 / 60, 1e6), 0.12, 0.02);
  EXPECT_NEAR(kept_spin(Method::generalised_alpha, 1.0 / 60), 1.0, 0.02);
  // Internal forces have no moment, so that Verlet keeps it to rounding; below 2/ω_max ≈ 0.8 ms.
  EXPECT_NEAR(kept_spin(Method::velocity_verlet, 1.0 / 4000), 1.0, 1e-9);
}

/// Energy k (√(1 + s²) − 1) in the stretch s along x: from |s| > 1 a whole Newton step lands at −s³.
class SofteningSpring : public ForceModel {
 public:
  std::string_view name() const override { return "softening"; }
  Promises promises() const override { return {}; }
  double energy(const Eigen::Matrix3Xd& x) const override { return 4 * (std::sqrt(1 + square(x)) - 1); }
  void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const override {
    forces.setZero(3, 2);
    forces(0, 1) = -4 * stretch(x) / std::sqrt(1 + square(x));
    forces(0, 0) = -forces(0, 1);
  }
  std::unique_ptr<Tangent> tangent(const Eigen::Matrix3Xd& x, Projection) const override {
    return test::SpringModel(4 / std::pow(1 + square(x), 1.5), 1).tangent(x, Projection::none);
  }

 private:
  static double stretch(const Eigen::Matrix3Xd& x) { return x(0, 1) - x(0, 0) - 1; }
  static double square(const Eigen::Matrix3Xd& x) { return stretch(x) * stretch(x); }
};

TEST(Methods, WithoutLineSearchNewtonDiverges) {
  // Mass 1e-3 over 10 s: the potential is the spring's energy alone.
  const auto reached = [](bool line_search) {
    test::SpringBody body(1e-3, 4, 1);
    const SofteningSpring model;
    body.system.model = &model;
    body.state.positions(0, 1) = 1 + 1.5;
    StepOptions options = tight(Method::implicit_euler);
    options.line_search = line_search;
    options.newton_cap = 6;
    Integrator integrator(body.system);
    static_cast<void>(integrator.step({}, body.state, 10, options));
    return std::abs(body.state.positions(0, 1) - 1);
  };
  EXPECT_LT(reached(true), 1e-3);
  EXPECT_GT(reached(false), 100);
}

TEST(Methods, ExplicitOnesHoldPinsAndLeaveNoTraceInTheIntegrator) {
  SimulatedSolid solid(test::box(3, 1, 1, {0.3, 0.1, 0.1}), 1, {1000, 0.3, 1.25, 0.5});
  solid.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
  const Loads loads{gravity_forces(solid.discretization, {0, 0, -9.81}), {}};
  for (const MethodKind& kind : method_table()) {
    SCOPED_TRACE(kind.name);
    StepOptions options;
    options.method = kind.method;
    Integrator integrator(solid.system);
    BodyState state = solid.state;
    for (int i = 0; i < 5; ++i) static_cast<void>(integrator.step(loads, state, 2e-4, options));
    EXPECT_GT((state.positions - solid.rest).norm(), 1e-8);
    for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
      if (solid.system.fixed[static_cast<std::size_t>(i)]) {
        EXPECT_EQ(state.positions.col(i), solid.rest.col(i));
        EXPECT_EQ(state.velocities.col(i), Eigen::Vector3d::Zero());
      }
    const BodyState kept = state;
    const auto run = [&](Integrator& by) {
      BodyState next = kept;
      for (int i = 0; i < 3; ++i) static_cast<void>(by.step(loads, next, 2e-4, options));
      static_cast<void>(by.step(loads, next, 1e-4, options));
      return next;
    };
    Integrator fresh(solid.system);
    const BodyState first = run(integrator), again = run(integrator), other = run(fresh);
    EXPECT_EQ(first.positions, again.positions);
    EXPECT_EQ(first.velocities, again.velocities);
    EXPECT_EQ(first.positions, other.positions);
    EXPECT_EQ(first.velocities, other.velocities);
  }
}

TEST(Methods, ReportAnExplosionAndLeaveTheState) {
  SimulatedSolid solid(test::box(2, 1, 1, {0.2, 0.1, 0.1}), 0, {1e8, 0.3, 1, 0});
  shake(solid, 1e-3);
  Integrator integrator(solid.system);
  StepOptions options;
  options.method = Method::velocity_verlet;
  BodyState before = solid.state;
  try {
    for (int i = 0; i < 2000; ++i) {
      before = solid.state;
      static_cast<void>(integrator.step({}, solid.state, 1.0 / 60, options));
    }
    FAIL() << "a step of a thousand periods should diverge";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::not_converged);
  }
  EXPECT_EQ(solid.state.positions, before.positions);
}

}  // namespace
}  // namespace argil::fem
