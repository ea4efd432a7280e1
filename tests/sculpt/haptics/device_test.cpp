// Clocks, mapping, scripted and recorded devices, fault injector: what needs no force.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "sculpt/haptics/clock.h"
#include "sculpt/haptics/fault_injector.h"
#include "sculpt/haptics/mapping.h"
#include "sculpt/haptics/recorded_device.h"
#include "sculpt/haptics/scripted_device.h"

namespace argil::sculpt {
namespace {

using Eigen::Vector3d;

DevicePose at(double x, double y, double z) {
  return {Vector3d(x, y, z), Eigen::Quaterniond::Identity()};
}

TEST(Clock, VirtualTimeMovesOnlyWhenTold) {
  VirtualClock clock;
  EXPECT_EQ(clock.now(), 0);
  clock.advance();
  clock.advance(16);
  EXPECT_EQ(clock.now(), 17);
}

TEST(Clock, RealTimeIsWholeMillisecondsAndNeverFalls) {
  double seconds = 1234.5;
  RealClock clock([&] { return seconds; });
  EXPECT_EQ(clock.now(), 0);
  for (int tick = 1; tick < 2000; ++tick) {
    seconds = 1234.5 + tick / 1000.0;
    EXPECT_EQ(clock.now(), tick);
  }
  seconds = 1234.5 + 1.9999;
  EXPECT_EQ(clock.now(), 1999);
  seconds = 0;
  EXPECT_EQ(clock.now(), 1999);
}

TEST(Mapping, ForcesTurnBackAndTheClutchHoldsThePlace) {
  WorldFromDevice mapping;
  mapping.rotation = Eigen::AngleAxisd(std::acos(-1.0) / 2, Vector3d::UnitZ());
  mapping.scale = 4;
  mapping.translation = Vector3d(1, 2, 3);
  mapping.force_scale = 0.5;
  // A quarter turn in doubles is exact to a few units in the last place.
  EXPECT_LT((mapping.position(Vector3d(0.1, 0, 0)) - Vector3d(1, 2.4, 3)).norm(), 1e-15);
  EXPECT_LT((mapping.device_force(Vector3d(0, 2, 0)) - Vector3d(1, 0, 0)).norm(), 1e-15);
  const Vector3d held = mapping.position(Vector3d(0.1, 0.2, 0.3));
  const WorldFromDevice moved = mapping.clutched(Vector3d(-0.2, 0, 0), held);
  EXPECT_LT((moved.position(Vector3d(-0.2, 0, 0)) - held).norm(), 1e-15);
}

TEST(ScriptedDevice, EndsAreExactAndTheWayIsStraight) {
  const Vector3d from(0.3, 0.3, 0.1), to(0.3, 0.3, -0.05);
  ScriptedDevice device({{{from, Eigen::Quaterniond::Identity()}, {to, Eigen::Quaterniond::Identity()}, 500}}, 100);
  EXPECT_EQ(device.exchange({}, 100).pose.position, from);
  EXPECT_EQ(device.exchange({}, 600).pose.position, to);
  EXPECT_EQ(device.sample(350).pose.position, 0.5 * from + 0.5 * to);
  EXPECT_EQ(device.sample(99).pose.position, from);
  EXPECT_EQ(device.sample(10000).pose.position, to);
  EXPECT_EQ(device.sample(99).buttons, 0U);
  EXPECT_EQ(device.sample(100).buttons, 1U);
  EXPECT_EQ(device.sample(600).buttons, 1U);
  EXPECT_EQ(device.sample(601).buttons, 0U);
  EXPECT_EQ(device.sample(345).tick, 345);
  for (Tick t = 100; t < 600; ++t) {  // equal steps to the rounding of the sums
    const Vector3d step = device.sample(t + 1).pose.position - device.sample(t).pose.position;
    EXPECT_NEAR(step.z(), -0.15 / 500, 1e-16);
  }
}

TEST(ScriptedDevice, SmoothEaseStartsAndEndsAtRest) {
  ScriptedDevice device({{at(0, 0, 0), at(1, 0, 0), 1000, Ease::smooth}});
  EXPECT_EQ(device.sample(0).pose.position.x(), 0);
  EXPECT_EQ(device.sample(500).pose.position.x(), 0.5);
  EXPECT_EQ(device.sample(1000).pose.position.x(), 1);
  EXPECT_LT(device.sample(1).pose.position.x(), 3.1e-6);  // 3 s² at s = 1e-3
  EXPECT_GT(device.sample(999).pose.position.x(), 1 - 3.1e-6);
  EXPECT_NEAR(device.sample(250).pose.position.x(), 0.15625, 1e-15);  // 3/16 − 2/64
}

TEST(ScriptedDevice, SegmentsFollowOneAnotherAndTurn) {
  const Eigen::Quaterniond quarter(Eigen::AngleAxisd(std::acos(-1.0) / 2, Vector3d::UnitX()));
  ScriptedDevice device({{at(0, 0, 0), at(1, 0, 0), 10, Ease::linear, 1},
                         {at(5, 0, 0), {Vector3d(6, 0, 0), quarter}, 10, Ease::linear, 2}});
  EXPECT_EQ(device.sample(9).buttons, 1U);
  EXPECT_EQ(device.sample(10).pose.position.x(), 5);
  EXPECT_EQ(device.sample(10).buttons, 2U);
  EXPECT_EQ(device.sample(20).pose.orientation.coeffs(), quarter.coeffs());
  // Half-way of a quarter turn is an eighth; acos in the angle loses half the digits near 1.
  EXPECT_NEAR(device.sample(15).pose.orientation.angularDistance(Eigen::Quaterniond::Identity()),
              std::acos(-1.0) / 4, 1e-7);
  EXPECT_EQ(device.end(), 20);
}

TEST(ScriptedDevice, PlaysAListOfPoses) {
  std::vector<DevicePose> poses;
  for (int i = 0; i < 20; ++i) poses.push_back(at(0.1 * i * i, 1.0 / (i + 1), -i));
  const ScriptedDevice device = ScriptedDevice::from_poses(poses, 1, 7);
  for (int i = 0; i < 20; ++i) EXPECT_EQ(device.sample(7 + i).pose.position, poses[i].position);
  EXPECT_EQ(device.sample(100).pose.position, poses[19].position);
}

TEST(RecordedDevice, SaysWhatTheDeviceSaid) {
  ScriptedDevice scripted({{at(0, 0, 0), at(1, 2, 3), 37, Ease::smooth}}, 2);
  FaultInjector faulty(scripted, {{DeviceFault::stall, 10, 15}});
  DeviceRecorder recorder(faulty);
  std::vector<DeviceSample> said;
  for (Tick t = 0; t < 60; t += 1 + t % 3) said.push_back(recorder.exchange({}, t));
  RecordedDevice replayed(recorder.entries());
  EXPECT_EQ(replayed.exchange({}, -1).mode, DeviceMode::closed);
  std::size_t i = 0;
  for (Tick t = 0; t < 60; t += 1 + t % 3, ++i) {
    const DeviceSample sample = replayed.exchange({}, t);
    EXPECT_EQ(sample.pose.position, said[i].pose.position);
    EXPECT_EQ(sample.tick, said[i].tick);
    EXPECT_EQ(sample.buttons, said[i].buttons);
    EXPECT_EQ(sample.mode, said[i].mode);
  }
  EXPECT_EQ(replayed.exchange({}, 1000).mode, DeviceMode::closed);
}

TEST(FaultInjector, DelaysStallsAndSpoils) {
  ScriptedDevice scripted({{at(0, 0, 0), at(1, 0, 0), 100}});
  FaultInjector device(
      scripted,
      {{DeviceFault::delay, 20, 29, 5}, {DeviceFault::stall, 40, 49}, {DeviceFault::not_a_number, 60, 60}});
  for (Tick t = 0; t <= 100; ++t) {
    const DeviceSample sample = device.exchange({}, t);
    const Tick expected = t >= 20 && t <= 29 ? t - 5 : t >= 40 && t <= 49 ? 39 : t;
    EXPECT_EQ(sample.tick, expected) << t;
    if (t == 60)
      EXPECT_TRUE(std::isnan(sample.pose.position.x()));
    else
      EXPECT_EQ(sample.pose.position, scripted.sample(expected).pose.position) << t;
  }
}

}  // namespace
}  // namespace argil::sculpt
