#include "sculpt/haptics/simulated_hand.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "sculpt/haptics/scripted_device.h"

namespace argil::sculpt {
namespace {

using Eigen::Vector3d;

ScriptedDevice path(const Vector3d& from, const Vector3d& to, Tick ticks) {
  return ScriptedDevice(
      {{{from, Eigen::Quaterniond::Identity()}, {to, Eigen::Quaterniond::Identity()}, ticks, Ease::smooth}});
}

TEST(SimulatedHand, ConvergesToItsPath) {
  ScriptedDevice intention = path(Vector3d(0, 0, 0), Vector3d(0.2, -0.1, 0.05), 500);
  SimulatedHand hand(intention);
  for (Tick t = 0; t <= 3000; ++t) (void)hand.exchange({}, t);
  // 2.5 s at a decay of b/2m = 20 /s leave e^-50.
  EXPECT_LT((hand.exchange({}, 3001).pose.position - Vector3d(0.2, -0.1, 0.05)).norm(), 1e-14);
  EXPECT_EQ(hand.work_received(), 0);
}

TEST(SimulatedHand, YieldsByForceOverStiffness) {
  ScriptedDevice intention = path(Vector3d::Zero(), Vector3d::Zero(), 0);
  SimulatedHand hand(intention);
  DeviceSample sample;
  for (Tick t = 0; t <= 3000; ++t) sample = hand.exchange({Vector3d(0, 2, 0), t}, t);
  EXPECT_LT((sample.pose.position - Vector3d(0, 2.0 / 200, 0)).norm(), 1e-14);
  EXPECT_EQ(sample.mode, DeviceMode::force);
  // At rest the work is that of a constant force over its way.
  EXPECT_NEAR(hand.work_received(), 2 * 2.0 / 200, 1e-14);
}

TEST(SimulatedHand, FreeOscillationFollowsItsSpring) {
  // Undamped, released from 1 cm: backward Euler shrinks the amplitude by 1/sqrt(1 + ω²dt²) a tick, and keeps the
  // period to second order.
  DevicePose start;
  start.position.x() = 0.01;
  ScriptedDevice intention = ScriptedDevice::from_poses({start, DevicePose{}});
  HandOptions options;
  options.mass = 0.5;
  options.stiffness = 20;
  options.damping = 0;
  SimulatedHand hand(intention, options);
  const double omega = std::sqrt(options.stiffness / options.mass), dt = 1e-3;
  const auto period = static_cast<Tick>(std::round(2 * std::acos(-1.0) / omega / dt));
  DeviceSample sample = hand.exchange({}, 0);
  ASSERT_EQ(sample.pose.position.x(), 0.01);
  sample = hand.exchange({}, period);
  const double kept = std::exp(-omega * omega * dt * static_cast<double>(period) * dt / 2);
  EXPECT_LT(kept, 0.99);  // so that the loss shows
  // The phase is off by up to half a tick and the first tick's start: cos of 2 ticks of omega, 1e-4; twice that.
  EXPECT_NEAR(sample.pose.position.x(), 0.01 * kept, 0.01 * 2e-4);
}

TEST(SimulatedHand, IsStableForAnyStiffnessAndBounded) {
  ScriptedDevice intention = path(Vector3d::Zero(), Vector3d(100, 0, 0), 50);
  HandOptions options;
  options.mass = 1e-3;
  options.stiffness = 1e9;
  options.damping = 1e4;
  SimulatedHand hand(intention, options);
  for (Tick t = 0; t <= 300; ++t) {
    const Vector3d kick = 1e6 * Vector3d(std::sin(t * 1.7), std::cos(t * 2.3), t % 2 == 0 ? 1 : -1);
    const Vector3d position = hand.exchange({kick, t}, t).pose.position;
    EXPECT_TRUE(position.allFinite());
    EXPECT_LE(position.cwiseAbs().maxCoeff(), 2.0);
  }
  // 20 N at most over a box of 4 m, whatever is commanded.
  EXPECT_LT(std::abs(hand.work_received()), 20 * 4 * 3 * 300);
}

TEST(SimulatedHand, CommandsExpire) {
  ScriptedDevice intention = path(Vector3d::Zero(), Vector3d::Zero(), 0);
  SimulatedHand hand(intention), other(intention);
  (void)hand.exchange({}, 0);
  (void)hand.exchange({Vector3d(3, 0, 0), 30}, 10);
  // Nothing is heard until tick 5000: the force ruled to tick 30 and then let go.
  const DeviceSample sample = hand.exchange({Vector3d(3, 0, 0), 4999}, 5000);
  EXPECT_EQ(sample.mode, DeviceMode::idle);
  EXPECT_LT(sample.pose.position.norm(), 1e-14);
  // The same, heard tick by tick.
  for (Tick t = 0; t <= 5000; ++t) (void)other.exchange({Vector3d(t >= 10 ? 3 : 0, 0, 0), 30}, t);
  EXPECT_EQ(hand.work_received(), other.work_received());
}

TEST(SimulatedHand, RefusesWhatIsNotANumber) {
  ScriptedDevice intention = path(Vector3d::Zero(), Vector3d::Zero(), 0);
  SimulatedHand hand(intention);
  (void)hand.exchange({}, 0);
  const Vector3d bad(0, std::numeric_limits<double>::quiet_NaN(), 0);
  EXPECT_EQ(hand.exchange({bad, 1000}, 1).mode, DeviceMode::fault);
  const DeviceSample sample = hand.exchange({Vector3d(5, 0, 0), 1000}, 2);
  EXPECT_EQ(sample.mode, DeviceMode::fault);
  EXPECT_EQ(sample.pose.position, Vector3d::Zero());
}

}  // namespace
}  // namespace argil::sculpt
