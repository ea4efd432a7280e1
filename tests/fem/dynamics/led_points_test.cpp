// Bodies whose fixed control points are led: the order of every method, and the work that they take.

#include "fem/dynamics/led_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fem/dynamics/guard.h"
#include "tests/fem/dynamics/tight_steps.h"
#include "tests/fem/simulated_solid.h"

namespace argil::fem {
namespace {

using test::tight;

/// A bar shaken at its end, as a smooth function of time that begins at rest.
struct Shaken {
  Shaken() : solid(test::box(4, 1, 1, {0.4, 0.1, 0.1}), 0, {1000, 0.3, 1.25, 0.5}) {
    solid.fix([](const Eigen::Vector3d& x) { return x.x() < 1e-9; });
    for (std::uint32_t i = 0; i < solid.system.fixed.size(); ++i)
      if (solid.system.fixed[i]) held.push_back(i);
  }
  static double way(double time) { return 0.02 * std::pow(std::sin(4 * time), 4); }
  static double speed(double time) { return 0.32 * std::pow(std::sin(4 * time), 3) * std::cos(4 * time); }

  [[nodiscard]] Loads loads(double time) const {
    Loads result;
    result.led.control_points = held;
    result.led.time = time;
    result.led.velocities = Eigen::Vector3d(0, 0, speed(time)).replicate(1, static_cast<Eigen::Index>(held.size()));
    result.led.positions = led_columns(result.led, solid.rest).colwise() + Eigen::Vector3d(0, 0, way(time));
    return result;
  }
  /// Takes `count` steps to `end`; returns the work of what leads it.
  double run(const StepOptions& options, double end, int count) {
    Integrator integrator(solid.system);
    double work = 0;
    for (int step = 1; step <= count; ++step) {
      const BodyState before = solid.state;
      integrator.step(loads(end * step / count), solid.state, end / count, options);
      work += led_work(solid.system, loads(end * step / count), before, solid.state);
    }
    return work;
  }

  test::SimulatedSolid solid;
  std::vector<std::uint32_t> held;
};

class LedOrder : public testing::TestWithParam<Method> {};

TEST_P(LedOrder, IsThatOfTheMethod) {
  const double end = 0.25;
  Shaken exact;
  exact.run(tight(Method::velocity_verlet), end, 4000);  // errs by 1/6 at most of what the finest below does
  const auto error = [&](int count) {
    Shaken shaken;
    shaken.run(tight(GetParam()), end, count);
    return (shaken.solid.state.positions - exact.solid.state.positions).norm();
  };
  const bool is_implicit = method_kind(GetParam()).is_implicit;
  const int count = is_implicit ? 400 : 800;  // which resolves the slow modes; explicit ones below their limit
  const double rate = std::log2(error(count) / error(2 * count));
  EXPECT_GT(rate, method_kind(GetParam()).order - 0.25) << error(count);
  EXPECT_LT(error(2 * count), 0.05 * exact.way(end));
}

INSTANTIATE_TEST_SUITE_P(Methods, LedOrder,
                         testing::Values(Method::bdf2, Method::implicit_euler, Method::generalised_alpha,
                                         Method::symplectic_euler, Method::central_difference),
                         [](const auto& test) { return std::string(method_kind(test.param).name); });

TEST(LedPoints, TakeTheWorkThatTheBodyGains) {
  const auto gap = [](int count) {
    Shaken shaken;
    const double start = shaken.solid.model->energy(nodes(shaken.solid.system, shaken.solid.state.positions));
    shaken.solid.discretization.damping *= 0;  // what it would lose is another account
    const double work = shaken.run(tight(Method::velocity_verlet), 0.25, count);
    const double energy = kinetic_energy(shaken.solid.system, shaken.solid.state.velocities) +
                          shaken.solid.model->energy(nodes(shaken.solid.system, shaken.solid.state.positions)) -
                          start;
    EXPECT_GT(energy, 1e-6);
    return std::abs(work - energy) / energy;
  };
  EXPECT_LT(gap(1600), 0.02);
  EXPECT_LT(gap(3200), 0.6 * gap(1600));  // at least the first order
}

TEST(LedPoints, GoAPartOfTheStraightWayInAPartOfTheStep) {
  Shaken shaken;
  const Loads loads = shaken.loads(0.1);
  const LedStep half = led_step(loads.led, shaken.solid.state, 0.05),
                whole = led_step(loads.led, shaken.solid.state, 0.1);
  EXPECT_NEAR(half.positions(2, 0) - shaken.solid.rest(2, shaken.held[0]), 0.5 * Shaken::way(0.1), 1e-15);
  EXPECT_NEAR(half.velocities(2, 0), Shaken::way(0.1) / 0.1, 1e-15);
  EXPECT_EQ(whole.positions, loads.led.positions);
  EXPECT_EQ(whole.velocities, loads.led.velocities);
  EXPECT_NEAR(whole.accelerations(2, 0), Shaken::speed(0.1) / 0.1, 1e-14);
}

}  // namespace
}  // namespace argil::fem
