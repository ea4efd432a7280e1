#include "sculpt/haptics/safety.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <random>

namespace argil::sculpt {
namespace {

using Eigen::Vector3d;

constexpr double k_infinity = std::numeric_limits<double>::infinity();

SafetyLimits without_passivity() {
  SafetyLimits limits;
  limits.start_energy = limits.max_energy = k_infinity;
  return limits;
}

TEST(Safety, PassesASmallSteadyForceUnchanged) {
  SafetyChain chain;
  const Vector3d force(0.3, -0.2, 0.1);
  const SafetyReport report = chain.apply(force, Vector3d::Zero(), true);
  EXPECT_EQ(report.force, force);
  EXPECT_FALSE(report.clamped || report.slewed || report.damped || report.stale || report.not_finite);
}

TEST(Safety, NotANumberGivesZeroAndAFaultThatLasts) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), k_infinity})
    for (const bool in_force : {true, false}) {
      SafetyChain chain;
      (void)chain.apply(Vector3d(0.5, 0, 0), Vector3d::Zero(), true);
      const Vector3d good(0.1, 0, 0), broken(0, bad, 0);
      const SafetyReport report = chain.apply(in_force ? broken : good, in_force ? good : broken, true);
      EXPECT_TRUE(report.not_finite);
      EXPECT_EQ(report.force, Vector3d::Zero());
      EXPECT_TRUE(chain.fault());
      EXPECT_EQ(chain.apply(good, Vector3d::Zero(), true).force, Vector3d::Zero());
      chain.reset();
      EXPECT_EQ(chain.apply(good, Vector3d::Zero(), true).force, good);
    }
}

TEST(Safety, WhatIsStaleFallsToZeroAndRecovers) {
  SafetyChain chain(without_passivity());
  for (int i = 0; i < 10; ++i) (void)chain.apply(Vector3d(5, 0, 0), Vector3d::Zero(), true);
  for (int i = 1; i <= 12; ++i) {
    const SafetyReport report = chain.apply(Vector3d(5, 0, 0), Vector3d::Zero(), false);
    EXPECT_TRUE(report.stale);
    EXPECT_EQ(report.force, Vector3d(std::max(0.0, 5 - 0.5 * i), 0, 0));
  }
  EXPECT_FALSE(chain.fault());
  // Back again, the force grows from zero at the rate of the slew limit.
  EXPECT_EQ(chain.apply(Vector3d(5, 0, 0), Vector3d::Zero(), true).force, Vector3d(0.5, 0, 0));
}

TEST(Safety, APoseThatJumpedGetsNoForceAndLeavesNoDebt) {
  SafetyLimits limits;
  limits.start_energy = 1;
  SafetyChain chain(limits);
  for (int i = 0; i < 4; ++i) (void)chain.apply(Vector3d(2, 0, 0), Vector3d::Zero(), true);
  const SafetyReport report = chain.apply(Vector3d(2, 0, 0), Vector3d(1e9, 0, 0), true);
  EXPECT_TRUE(report.jumped);
  EXPECT_EQ(report.force, Vector3d(1.5, 0, 0));
  EXPECT_EQ(chain.energy(), limits.start_energy);
  EXPECT_EQ(chain.apply(Vector3d(2, 0, 0), Vector3d(1e9, 0, 0), true).force, Vector3d(2, 0, 0));
}

TEST(Safety, NoInputMakesAForceOrAStepTooLarge) {
  // Wanted forces and poses of any size, numbers that are none, silence, resets: 10⁶ ticks.
  for (const bool passive : {true, false}) {
    const SafetyLimits limits = passive ? SafetyLimits{} : without_passivity();
    SafetyChain chain(limits);
    std::mt19937_64 random(11);
    const auto number = [&] {
      const double sizes[] = {0, 1e-300, 1e-6, 1e-3, 1, 10, 1e9, 1e308};
      const std::uint64_t draw = random() % 4000;
      if (draw == 0) return k_infinity;
      if (draw == 1) return -k_infinity;
      if (draw == 2) return std::numeric_limits<double>::quiet_NaN();
      return sizes[random() % 8] * (static_cast<double>(random() % 2001) - 1000) / 1000;
    };
    const auto vector = [&] { return Vector3d(number(), number(), number()); };
    Vector3d last = Vector3d::Zero(), position = Vector3d::Zero(), last_position = position, steady = position;
    double largest = 0, largest_step = 0;
    long faults = 0;
    for (long i = 0; i < 500'000; ++i) {
      position = random() % 16 == 0 ? vector() : Vector3d(position + 1e-4 * vector().cwiseMin(1).cwiseMax(-1));
      if (chain.fault() && random() % 64 == 0) {
        ++faults;
        chain.reset();
        position.setZero();
      }
      if (i % 200 == 0) steady = vector();
      const bool at_rest = i / 200 % 2 == 0;  // every other fifth of a second something is pushed for long
      const Vector3d force = at_rest ? chain.apply(steady, position = last_position, true).force
                                     : chain.apply(vector(), position, random() % 32 != 0).force;
      last_position = position;
      ASSERT_TRUE(force.allFinite());
      largest = std::max(largest, force.norm());
      largest_step = std::max(largest_step, (force - last).norm());
      last = force;
    }
    std::printf("half a million inputs: %ld faults, force at most %.4f N, step at most %.4f N/ms\n", faults,
                largest, largest_step);
    EXPECT_LE(largest, limits.max_force * (1 + 1e-14));
    EXPECT_LE(largest_step, 0.5 + 1e-12);
    EXPECT_GT(largest, passive ? 0.5 : 0.9 * limits.max_force);  // it did push
    EXPECT_GT(faults, 100);
  }
}

TEST(Safety, ClampsTheSizeAndKeepsTheDirection) {
  SafetyLimits limits = without_passivity();
  limits.max_slew = k_infinity;
  SafetyChain chain(limits);
  SafetyReport report = chain.apply(Vector3d(30, 40, 0), Vector3d::Zero(), true);
  EXPECT_TRUE(report.clamped);
  EXPECT_LT((report.force - Vector3d(4.8, 6.4, 0)).norm(), 1e-14);
  report = chain.apply(Vector3d(0, 1e300, 0), Vector3d::Zero(), true);
  EXPECT_LT((report.force - Vector3d(0, 8, 0)).norm(), 1e-14);
}

TEST(Safety, SlewBoundsEveryChange) {
  SafetyChain chain(without_passivity());
  Vector3d last = Vector3d::Zero();
  bool always_arrived = true;
  for (int i = 0; i < 180; ++i) {
    // The ways are 7 N, then 14.3 N: at 0.5 N a tick, they are done within 30 ticks.
    const Vector3d wanted = i % 60 < 30 ? Vector3d(7, 0, 0) : Vector3d(-7, 3, 0);
    const SafetyReport report = chain.apply(wanted, Vector3d::Zero(), true);
    EXPECT_LE((report.force - last).norm(), 0.5 + 1e-14);
    last = report.force;
    if (i % 30 == 29) always_arrived = always_arrived && last == wanted;
    EXPECT_EQ(report.slewed, last != wanted);
  }
  EXPECT_TRUE(always_arrived);
}

TEST(Safety, ObserverCountsWorkAndRemembersABoundedAmount) {
  SafetyLimits limits;
  limits.start_energy = 4e-3;
  limits.max_energy = 0.01;
  limits.max_slew = k_infinity;
  SafetyChain chain(limits);
  (void)chain.apply(Vector3d(-2, 0, 0), Vector3d::Zero(), true);
  (void)chain.apply(Vector3d(-2, 0, 0), Vector3d(1e-3, 0, 0), true);  // pushed in against 2 N by 1 mm
  EXPECT_NEAR(chain.energy(), 6e-3, 1e-15);
  for (int i = 2; i < 100; ++i) (void)chain.apply(Vector3d(-2, 0, 0), Vector3d(i * 1e-3, 0, 0), true);
  EXPECT_NEAR(chain.energy(), 0.01, 1e-15);
}

TEST(Safety, ControllerStopsAForceThatAlwaysPushesAlongTheMotion) {
  // Negative damping, the worst environment: it wants 20 N s/m times the velocity. The hand is a free mass of 0.2
  // kg with 10 cm/s, 1 mJ. Without the controller its energy grows a hundredfold in 50 ms.
  for (const bool controlled : {true, false}) {
    SafetyLimits limits = controlled ? SafetyLimits{} : without_passivity();
    SafetyChain chain(limits);
    constexpr double k_mass = 0.2;
    Vector3d position = Vector3d::Zero(), velocity(0.1, 0, 0);
    double work = 0, most = 0;
    for (int i = 0; i < 50; ++i) {
      const Vector3d force = chain.apply(20 * velocity, position, true).force;
      velocity += force / k_mass * 1e-3;
      position += velocity * 1e-3;
      work += force.dot(velocity) * 1e-3;
      most = std::max(most, work);
    }
    if (controlled)
      // The reserve and half of it again, which pays for gentleness, and what one tick takes beyond the motion
      // foreseen: a force of up to 2 N over the change of the step, 2 N / m · dt², 0.02 mJ.
      EXPECT_LE(most, 1.5 * SafetyLimits{}.start_energy + 0.02e-3);
    else
      EXPECT_GT(most, 0.1);
  }
}

}  // namespace
}  // namespace argil::sculpt
