#include "fem/dynamics/guard.h"

#include <gmock/gmock.h>

#include <cmath>

#include "fem/loads.h"
#include "fem/measure/energy.h"
#include "subdiv/error.h"
#include "tests/fem/simulated_solid.h"

namespace argil::fem {
namespace {

using test::SimulatedSolid;

constexpr Method k_explicit[] = {Method::central_difference, Method::forward_euler, Method::symplectic_euler,
                                 Method::velocity_verlet, Method::midpoint};

double total(const SimulatedSolid& solid) {
  const Energy parts = energy(solid.system, solid.state);
  return parts.kinetic + parts.elastic;
}

/// A model behind another, that can be told to misbehave.
class Faulty : public ForceModel {
 public:
  explicit Faulty(const ForceModel& model) : model_(model) {}
  std::string_view name() const override { return "faulty"; }
  Promises promises() const override {
    Promises promises = model_.promises();
    promises.inversion_is_error = inversion_is_error;
    promises.has_energy = has_energy;
    return promises;
  }
  double energy(const Eigen::Matrix3Xd& x) const override { return model_.energy(x); }
  void forces(const Eigen::Matrix3Xd& x, Eigen::Matrix3Xd& forces) const override {
    model_.forces(x, forces);
    if (broken || x.row(2).minCoeff() < floor) forces.setConstant(std::nan(""));
    forces *= sign;
  }
  std::unique_ptr<Tangent> tangent(const Eigen::Matrix3Xd& x, Projection projection) const override {
    return model_.tangent(x, projection);
  }
  bool broken = false, inversion_is_error = false, has_energy = true;
  double sign = 1, floor = -1e300;  // below it no force is known

 private:
  const ForceModel& model_;
};

TEST(Guard, LeavesGentleMotionAlone) {
  for (const MethodKind& kind : method_table()) {
    SCOPED_TRACE(kind.name);
    SimulatedSolid solid(test::box(4, 1, 1, {0.4, 0.1, 0.1}), 0, {1e4, 0.3, 1000, 0});
    solid.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
    SimulatedSolid bare(test::box(4, 1, 1, {0.4, 0.1, 0.1}), 0, {1e4, 0.3, 1000, 0});
    bare.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
    const Loads loads{gravity_forces(solid.discretization, {0, 0, -9.81}), {}};
    Integrator integrator(solid.system), other(bare.system);
    StepOptions options;
    options.method = kind.method;
    GuardState guard;
    // The highest frequency is some 170 rad/s; forward Euler's modes grow by exp(ω² h t/2) = e^0.9.
    const double h = kind.is_implicit ? 1.0 / 60 : (kind.method == Method::forward_euler ? 2e-4 : 2e-3);
    for (int i = 0; i < 150; ++i) {
      const GuardedReport report = guarded_step(integrator, loads, solid.state, guard, h, options);
      ASSERT_EQ(report.remedy, GuardRemedy::none) << "step " << i << " " << word(report.finding);
      static_cast<void>(other.step(loads, bare.state, h, options));
    }
    EXPECT_EQ(solid.state.positions, bare.state.positions);
    EXPECT_EQ(guard.failures, 0);
  }
}

TEST(Guard, KeepsExplicitMethodsBoundedAtTenTimesTheirLimit) {
  for (const Method method : k_explicit) {
    SCOPED_TRACE(method_kind(method).name);
    SimulatedSolid solid(test::box(3, 1, 1, {0.3, 0.1, 0.1}), 0, {1e6, 0.3, 1000, 0});
    solid.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
    const Loads loads{gravity_forces(solid.discretization, {0, 0, -9.81}), {}};
    Integrator integrator(solid.system);
    StepOptions options;
    options.method = method;
    GuardState guard;
    int helped = 0;
    // The limit is 2/1700 s; the substeps are stable from an eighth on, or implicit Euler takes over.
    for (int i = 0; i < 200; ++i) {
      const GuardedReport report = guarded_step(integrator, loads, solid.state, guard, 1.0 / 100, options);
      helped += report.remedy == GuardRemedy::substeps || report.remedy == GuardRemedy::implicit_euler;
      ASSERT_TRUE(solid.state.positions.allFinite() && solid.state.velocities.allFinite());
    }
    EXPECT_GT(helped, 10);
    EXPECT_FALSE(guard.frozen);
    EXPECT_NEAR(solid.state.time, 2, 1e-9);
    // The tip hangs ρ g A L⁴/(8EI) = 12 mm down and a little for shear, and swings to twice that; forward Euler may
    // hold twice the energy.
    EXPECT_LT((solid.state.positions - solid.rest).cwiseAbs().maxCoeff(), 0.035);
    EXPECT_GT((solid.state.positions - solid.rest).cwiseAbs().maxCoeff(), 1e-3);
  }
}

TEST(Guard, EnergyFromNowhereStaysBelowWhatWasPutIn) {
  // Without a load all energy is that of the start; the guard lets it double at most, and a method that gains a
  // little at every step is caught as well as one that explodes.
  for (const Method method : k_explicit) {
    SCOPED_TRACE(method_kind(method).name);
    SimulatedSolid solid(test::box(2, 2, 2, {0.2, 0.2, 0.2}), 0, {1e5, 0.3, 1000, 0});
    for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
      solid.state.velocities.col(i) = Eigen::Vector3d(2 * std::sin(5.0 * static_cast<double>(i)),
                                                      2 * std::cos(3.0 * static_cast<double>(i)), 1);
    const double begin = total(solid);
    Integrator integrator(solid.system);
    StepOptions options;
    options.method = method;
    GuardState guard;
    double most = 0;
    bool acted = false;
    for (int i = 0; i < 2000; ++i) {
      acted |= guarded_step(integrator, {}, solid.state, guard, 1e-3, options).remedy != GuardRemedy::none;
      most = std::max(most, total(solid));
    }
    EXPECT_FALSE(guard.frozen);
    EXPECT_LE(most, 2.05 * begin);
    EXPECT_EQ(acted, method == Method::midpoint || method == Method::forward_euler);
  }
}

TEST(Guard, TakesBackWhatIsNotFiniteThenFreezesAndThaws) {
  SimulatedSolid solid(test::box(2, 1, 1, {0.2, 0.1, 0.1}), 0, {1e4, 0.3, 1000, 0});
  Faulty model(*solid.model);
  solid.system.model = &model;
  solid.state.velocities.row(0).setConstant(0.5);
  Integrator integrator(solid.system);
  GuardState guard;
  static_cast<void>(guarded_step(integrator, {}, solid.state, guard, 0.01, {}));
  model.broken = true;
  const Eigen::Matrix3Xd good = solid.state.positions;
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(guard.frozen);
    const GuardedReport report = guarded_step(integrator, {}, solid.state, guard, 0.01, {});
    EXPECT_EQ(report.finding, GuardFinding::not_finite);
    EXPECT_EQ(report.remedy, i < 2 ? GuardRemedy::restored : GuardRemedy::frozen);
    EXPECT_EQ(solid.state.positions, good);
    EXPECT_EQ(solid.state.velocities.norm(), 0);
  }
  EXPECT_TRUE(guard.frozen);
  EXPECT_EQ(guard.cause, GuardFinding::not_finite);
  model.broken = false;
  EXPECT_EQ(guarded_step(integrator, {}, solid.state, guard, 0.01, {}).remedy, GuardRemedy::frozen);
  EXPECT_NEAR(solid.state.time, 0.05, 1e-12);
  guard = {};
  solid.state.velocities.row(0).setConstant(0.5);
  EXPECT_EQ(guarded_step(integrator, {}, solid.state, guard, 0.01, {}).remedy, GuardRemedy::none);
  EXPECT_NE(solid.state.positions, good);
}

TEST(Guard, AnUntroubledStepForgetsFailures) {
  SimulatedSolid solid(test::box(2, 1, 1, {0.2, 0.1, 0.1}), 0, {1e4, 0.3, 1000, 0});
  Faulty model(*solid.model);
  solid.system.model = &model;
  Integrator integrator(solid.system);
  GuardState guard;
  const Loads loads{gravity_forces(solid.discretization, {0, 0, -9.81}), {}};
  for (int i = 0; i < 8; ++i) {
    model.broken = i % 2 == 0;
    // The integrator remembers nothing of a model that is wrong: forces are asked anew.
    static_cast<void>(guarded_step(integrator, loads, solid.state, guard, 0.01, {}));
    EXPECT_EQ(guard.failures, i % 2 == 0 ? 1 : 0);
  }
  EXPECT_FALSE(guard.frozen);
}

TEST(Guard, TakesBackInversionWhereItIsAnError) {
  // Thrown through itself by a push of 60 m/s² on one side, a soft cube turns inside out in one long step.
  for (const bool is_error : {false, true}) {
    SimulatedSolid solid(test::box(2, 2, 2, {0.1, 0.1, 0.1}), 0, {200, 0.3, 1000, 0});
    solid.fix([](const Eigen::Vector3d& x) { return x.z() < 1e-9; });
    Faulty model(*solid.model);
    model.inversion_is_error = is_error;
    solid.system.model = &model;
    const Loads loads{gravity_forces(solid.discretization, {0, 0, -60}), {}};
    Integrator integrator(solid.system);
    GuardState guard;
    std::size_t most = 0;
    int found = 0;
    for (int i = 0; i < 30; ++i) {
      found += guarded_step(integrator, loads, solid.state, guard, 1.0 / 30, {}).finding == GuardFinding::inversion;
      most = std::max(most, inverted_points(solid.system, solid.state.positions));
    }
    if (is_error) {
      EXPECT_GT(found, 0);
      EXPECT_EQ(most, 0U);
    } else {
      EXPECT_EQ(found, 0);
      EXPECT_GT(most, 0U);
    }
  }
}

TEST(Guard, BoundsForcesThatAreNotThoseOfTheirEnergy) {
  // Forces that push away from rest gain energy at any step, by any method.
  SimulatedSolid solid(test::box(2, 1, 1, {0.2, 0.1, 0.1}), 0, {1e4, 0.3, 1000, 0});
  Faulty model(*solid.model);
  model.sign = -1;
  solid.system.model = &model;
  solid.state.positions.row(0) *= 1.2;
  const double begin = total(solid);
  Integrator integrator(solid.system);
  StepOptions options;
  options.method = Method::velocity_verlet;
  GuardState guard;
  double most = 0;
  int troubled = 0;
  for (int i = 0; i < 500; ++i) {
    troubled += guarded_step(integrator, {}, solid.state, guard, 2e-3, options).finding == GuardFinding::energy;
    most = std::max(most, total(solid));
  }
  EXPECT_GT(troubled, 1);
  EXPECT_LE(most, 2.05 * begin);
}

/// A soft cube on the ground that minds being turned inside out, and a tool that holds a patch of its upper face.
struct HeldCube {
  HeldCube() : solid(test::box(2, 2, 2, {0.1, 0.1, 0.1}), 0, {1000, 0.3, 1000, 0}), model(*solid.model) {
    solid.fix([](const Eigen::Vector3d& x) { return x.z() < 1e-9; });
    model.inversion_is_error = true;
    solid.system.model = &model;
    tool.stiffness = 1e5;  // a thousand times the cube's
    for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
      if (solid.rest(2, i) > 0.099 && solid.rest(0, i) > 0.049 && solid.rest(1, i) > 0.049)
        tool.control_points.push_back(static_cast<std::uint32_t>(i));
    tool.weights.assign(tool.control_points.size(), 1.0 / static_cast<double>(tool.control_points.size()));
    tool.target = held_point(tool, solid.rest);
  }
  Loads loads() const { return {{}, {tool}}; }
  double from_target() const { return (held_point(tool, solid.state.positions) - tool.target).norm(); }
  double spring_energy() const { return 0.5 * tool.stiffness * from_target() * from_target(); }

  SimulatedSolid solid;
  Faulty model;
  AnchorSpring tool;
};

TEST(Guard, EasesAToolThatWouldTurnCellsInsideOut) {
  for (const bool moving : {false, true}) {
    SCOPED_TRACE(moving);
    HeldCube cube;
    cube.tool.target += Eigen::Vector3d(0, 0, -0.12);  // below the ground
    if (moving)
      for (Eigen::Index i = 0; i < cube.solid.rest.cols(); ++i)
        cube.solid.state.velocities(2, i) = -0.1 * cube.solid.rest(2, i);
    Integrator integrator(cube.solid.system);
    GuardState guard;
    const double begin = total(cube.solid) + cube.spring_energy(), away = cube.from_target();
    const GuardedReport report = guarded_step(integrator, cube.loads(), cube.solid.state, guard, 0.01, {});
    EXPECT_EQ(report.finding, GuardFinding::inversion);
    EXPECT_EQ(report.remedy, moving ? GuardRemedy::eased : GuardRemedy::eased_from_rest);
    EXPECT_LT(report.share, 1);
    EXPECT_EQ(guard.failures, 0);
    EXPECT_EQ(inverted_points(cube.solid.system, cube.solid.state.positions), 0U);
    // The tool has drawn the body some way, and what held it back has given no energy.
    EXPECT_LT(cube.from_target(), 0.99 * away);
    EXPECT_LT(total(cube.solid) + cube.spring_energy(), begin);
  }
}

TEST(Guard, HoldsCellsOnTheVergeOfTurning) {
  // Pressed flat by its own weight, a soft column cannot bear its lowest cells; the upper ones settle on them.
  SimulatedSolid solid(test::box(1, 1, 6, {0.1, 0.1, 0.6}), 0, {300, 0.3, 1000, 0});
  solid.fix([](const Eigen::Vector3d& x) { return x.z() < 1e-9; });
  Faulty model(*solid.model);
  model.inversion_is_error = true;
  solid.system.model = &model;
  const Loads loads{gravity_forces(solid.discretization, {0, 0, -9.81}), {}};
  Integrator integrator(solid.system);
  const std::vector<std::uint8_t> fixed = integrator.system().fixed;
  GuardState guard;
  int held = 0;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3Xd before = solid.state.positions;
    const GuardedReport report = guarded_step(integrator, loads, solid.state, guard, 1.0 / 60, {});
    EXPECT_EQ(integrator.system().fixed, fixed);
    EXPECT_EQ(inverted_points(solid.system, solid.state.positions), 0U);
    if (report.remedy != GuardRemedy::held) continue;
    ++held;
    int still = 0, moved = 0;
    for (Eigen::Index c = 0; c < before.cols(); ++c) {
      if (fixed[static_cast<std::size_t>(c)]) continue;
      ++(before.col(c) == solid.state.positions.col(c) ? still : moved);
    }
    EXPECT_GT(still, 0);
    EXPECT_GT(moved, 0);
  }
  EXPECT_GT(held, 0);
  EXPECT_FALSE(guard.frozen);
}

TEST(Guard, KeepsTheGoodBeginningOfAStep) {
  SimulatedSolid solid(test::box(2, 1, 1, {0.2, 0.1, 0.1}), 0, {1e4, 0.3, 1000, 0});
  Faulty model(*solid.model);
  solid.system.model = &model;
  const double h = 0.01, fall = 9.81 * h * h;
  // From rest a share s falls s/64 of `fall` in the first of 8 substeps and 36 times as far in all: ½ has no good
  // substep, 1/8 has one, and 1/256 fails at its end.
  model.floor = -0.00205 * fall;
  const Loads loads{gravity_forces(solid.discretization, {0, 0, -9.81}), {}};
  Integrator integrator(solid.system);
  GuardState guard;
  const GuardedReport report = guarded_step(integrator, loads, solid.state, guard, h, {});
  EXPECT_EQ(report.finding, GuardFinding::not_finite);
  EXPECT_EQ(report.remedy, GuardRemedy::eased_from_rest);
  EXPECT_EQ(report.share, 1.0 / 64);
  EXPECT_EQ(guard, GuardState{});
  EXPECT_EQ(solid.state.velocities.norm(), 0);
  EXPECT_EQ(solid.state.time, h);
  for (Eigen::Index i = 0; i < solid.rest.cols(); ++i)
    EXPECT_NEAR(solid.state.positions(2, i), solid.rest(2, i) - fall / 512, 1e-6 * fall);
}

TEST(Guard, MovesAFreeBodyAsAWholeWhereNothingElseHelps) {
  // Forces that push away from rest, and an account that is full: every deformation makes energy of nothing.
  for (const bool pinned : {false, true}) {
    SCOPED_TRACE(pinned);
    SimulatedSolid solid(test::box(2, 1, 1, {0.2, 0.1, 0.1}), 0, {1e4, 0.3, 1000, 0});
    if (pinned) solid.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
    Faulty model(*solid.model);
    model.sign = -1;
    model.has_energy = false;
    solid.system.model = &model;
    solid.state.positions.row(0) *= 1.2;
    const Loads loads{gravity_forces(solid.discretization, {0, 0, -9.81}), {}};
    Integrator integrator(solid.system);
    StepOptions options;
    options.method = Method::velocity_verlet;
    GuardState guard{.surplus = 1e3};
    int whole = 0;
    const double h = 2e-3;
    const auto momentum = [&] { return (solid.state.velocities * *solid.system.mass).rowwise().sum().eval(); };
    for (int i = 0; i < 10; ++i) {
      const BodyState before = solid.state;
      const Eigen::Vector3d expected = momentum() + h * loads.forces.rowwise().sum();
      if (guarded_step(integrator, loads, solid.state, guard, h, options).remedy != GuardRemedy::as_a_whole)
        continue;
      ++whole;
      const Eigen::Matrix3Xd moved = solid.state.positions - before.positions;
      EXPECT_LT((moved.colwise() - moved.col(0)).cwiseAbs().maxCoeff(), 1e-14);
      // The body weighs 20 N.
      EXPECT_LT((momentum() - expected).norm(), 1e-12);
    }
    // Once it moves, what is eased to nothing lets it coast.
    EXPECT_EQ(whole > 0, !pinned);
    EXPECT_EQ(guard.frozen, pinned);
  }
}

TEST(Guard, TriesAFrozenBodyAgainWhenHalfOfWhatPulledIsGone) {
  HeldCube cube;
  Integrator integrator(cube.solid.system);
  GuardState guard;
  cube.tool.stiffness = 10;
  cube.tool.target += Eigen::Vector3d(0, 0, 0.04);
  const Loads pull = cube.loads();
  Loads more = pull, less = pull;
  more.springs[0].target.z() -= 0.0199;
  less.springs[0].target.z() -= 0.0201;
  cube.model.broken = true;
  for (int i = 0; i < 3; ++i) static_cast<void>(guarded_step(integrator, pull, cube.solid.state, guard, 0.01, {}));
  ASSERT_TRUE(guard.frozen);
  EXPECT_NEAR(guard.pull, 0.4, 1e-12);
  cube.model.broken = false;
  for (const Loads& still : {pull, more}) {
    EXPECT_EQ(guarded_step(integrator, still, cube.solid.state, guard, 0.01, {}).remedy, GuardRemedy::frozen);
    EXPECT_EQ(cube.solid.state.positions, cube.solid.rest);
  }
  // Tried again in vain it freezes at once, and the lesser load is what counts from then on.
  cube.model.broken = true;
  EXPECT_EQ(guarded_step(integrator, less, cube.solid.state, guard, 0.01, {}).finding, GuardFinding::not_finite);
  EXPECT_TRUE(guard.frozen);
  EXPECT_NEAR(guard.pull, 0.199, 1e-12);
  cube.model.broken = false;
  EXPECT_EQ(guarded_step(integrator, less, cube.solid.state, guard, 0.01, {}).remedy, GuardRemedy::frozen);
  less.springs.clear();
  less.forces = gravity_forces(cube.solid.discretization, {0, 0, -1});
  EXPECT_EQ(guarded_step(integrator, less, cube.solid.state, guard, 0.01, {}).remedy, GuardRemedy::none);
  EXPECT_EQ(guard, GuardState{.cause = GuardFinding::not_finite});
  EXPECT_NE(cube.solid.state.positions, cube.solid.rest);
}

TEST(Guard, AToolTooStrongIsFollowedAndLetGoWithoutHarm) {
  // Dragged about for a second far out of reach, by every model of motion, the body is back at rest afterwards.
  for (const Method method : {Method::bdf2, Method::implicit_euler, Method::central_difference}) {
    SCOPED_TRACE(method_kind(method).name);
    HeldCube cube;
    Integrator integrator(cube.solid.system);
    StepOptions options;
    options.method = method;
    GuardState guard;
    int eased = 0;
    for (int i = 0; i < 60; ++i) {
      cube.tool.target += Eigen::Vector3d(0.002, 0.001, -0.004);
      const GuardedReport report =
          guarded_step(integrator, cube.loads(), cube.solid.state, guard, 1.0 / 60, options);
      eased += report.remedy == GuardRemedy::eased || report.remedy == GuardRemedy::eased_from_rest;
      ASSERT_EQ(inverted_points(cube.solid.system, cube.solid.state.positions), 0U);
      ASSERT_LT((cube.solid.state.positions - cube.solid.rest).cwiseAbs().maxCoeff(), 0.3);
    }
    EXPECT_GT(eased, 0);
    cube.solid.state.velocities.setZero();
    for (int i = 0; i < 300; ++i) {
      StepOptions damped;
      damped.method = Method::implicit_euler;
      static_cast<void>(guarded_step(integrator, {}, cube.solid.state, guard, 1.0 / 60, damped));
    }
    EXPECT_FALSE(guard.frozen);
    // The lowest frequency is some 7 rad/s, which implicit Euler damps by ω²h/2 = 0.4 a second.
    EXPECT_LT((cube.solid.state.positions - cube.solid.rest).cwiseAbs().maxCoeff(), 0.02);
  }
}

TEST(Guard, PassesOnWhatIsWrongWithTheArguments) {
  SimulatedSolid solid(test::box(1, 1, 1, {1, 1, 1}), 0);
  Integrator integrator(solid.system);
  GuardState guard;
  EXPECT_THROW(guarded_step(integrator, {}, solid.state, guard, -1, {}), Error);
}

TEST(Guard, CountsPointsThatAreInsideOut) {
  SimulatedSolid solid(test::box(2, 1, 1, {2, 1, 1}), 0);
  EXPECT_EQ(inverted_points(solid.system, solid.rest), 0U);
  Eigen::Matrix3Xd mirrored = solid.rest;
  mirrored.row(1) *= -1;
  EXPECT_EQ(inverted_points(solid.system, mirrored), 16U);
}

}  // namespace
}  // namespace argil::fem
