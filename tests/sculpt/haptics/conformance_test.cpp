#include "tests/sculpt/haptics/conformance.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>

#include "sculpt/haptics/fault_injector.h"
#include "sculpt/haptics/mouse_device.h"
#include "sculpt/haptics/network_device.h"
#include "sculpt/haptics/rate_device.h"
#include "sculpt/haptics/recorded_device.h"
#include "sculpt/haptics/scripted_device.h"
#include "sculpt/haptics/simulated_hand.h"

namespace argil::sculpt {

using Eigen::Vector3d;

void expect_conforming(Device& device) {
  const DeviceCapabilities can = device.capabilities();
  EXPECT_TRUE(can.sensed_axes == 3 || can.sensed_axes == 6);
  EXPECT_TRUE(can.actuated_axes == 0 || can.actuated_axes == 3 || can.actuated_axes == 6);
  EXPECT_TRUE((can.workspace_low.array() < can.workspace_high.array()).all());
  EXPECT_GE(can.max_force, 0);
  EXPECT_GE(can.max_stiffness, 0);
  EXPECT_GT(can.rate, 0);
  EXPECT_EQ(can.max_force > 0, can.actuated_axes > 0);

  std::mt19937_64 random(5);
  Tick tick = 0, last_sample = std::numeric_limits<Tick>::min();
  for (int i = 0; i < 3000; ++i) {
    ForceCommand command{Vector3d::Zero(), tick + 10};
    const auto kind = random() % 16;
    if (kind < 8) command.force = can.max_force / 2 * Vector3d(1, -1, 0.5).normalized();
    if (kind == 8) command.force.setConstant(1e9);
    if (kind == 9) command.valid_until = tick - 5;
    // A fault may be the answer to what is not a number, so that comes last.
    if (i > 2500 && kind == 10) command.force.setConstant(std::numeric_limits<double>::quiet_NaN());
    if (i > 2500 && kind == 11) command.force.setConstant(std::numeric_limits<double>::infinity());
    const DeviceSample sample = device.exchange(command, tick);
    EXPECT_LE(sample.tick, tick) << "a pose from the future";
    EXPECT_GE(sample.tick, last_sample) << "time falls";
    last_sample = sample.tick;
    EXPECT_TRUE(sample.pressure >= 0 && sample.pressure <= 1) << sample.pressure;
    if (sample.mode == DeviceMode::idle || sample.mode == DeviceMode::force || sample.mode == DeviceMode::brake) {
      EXPECT_TRUE(sample.pose.position.allFinite());
      EXPECT_NEAR(sample.pose.orientation.norm(), 1, 1e-9);
      EXPECT_TRUE((sample.pose.position.array() >= can.workspace_low.array()).all() &&
                  (sample.pose.position.array() <= can.workspace_high.array()).all())
          << sample.pose.position.transpose();
    }
    tick += random() % 32 == 0 ? static_cast<Tick>(random() % 300) + 1 : 1;
    if (testing::Test::HasFailure()) return;
  }
}

namespace {

/// Sticks that go round, are nonsense at times, and are unplugged for a while.
class Sticks : public RateSource {
 public:
  std::optional<RateInput> poll() override {
    ++polls_;
    if (polls_ / 500 % 3 == 2) return std::nullopt;
    RateInput input;
    for (std::size_t i = 0; i < 6; ++i)
      input.axes[i] = 1.5 * std::sin(0.01 * static_cast<double>(polls_ * (i + 1)));
    if (polls_ % 50 == 7) input.axes[polls_ % 6] = std::numeric_limits<double>::quiet_NaN();
    return input;
  }
  void rumble(double share) override {
    EXPECT_GE(share, 0);
    EXPECT_LE(share, 1);
    shaken = share;
  }
  double shaken = 0;

 private:
  std::size_t polls_ = 0;
};

ScriptedDevice to_and_fro() {
  return ScriptedDevice({{{Vector3d(-0.1, 0, 0), Eigen::Quaterniond::Identity()},
                          {Vector3d(0.1, 0, 0.05), Eigen::Quaterniond::Identity()},
                          1000,
                          Ease::smooth},
                         {{Vector3d(0.1, 0, 0.05), Eigen::Quaterniond::Identity()},
                          {Vector3d(-0.1, 0, 0), Eigen::Quaterniond::Identity()},
                          2000}});
}

TEST(Conformance, ScriptedAndRecorded) {
  ScriptedDevice script = to_and_fro();
  DeviceRecorder recorder(script);
  expect_conforming(recorder);
  RecordedDevice recorded(recorder.entries());
  expect_conforming(recorded);
}

TEST(Conformance, SimulatedHand) {
  ScriptedDevice script = to_and_fro();
  SimulatedHand hand(script);
  expect_conforming(hand);
}

TEST(Conformance, Mouse) {
  MouseDevice mouse;
  mouse.grab(Vector3d(0, 0, 0.1), Vector3d(0, 0, -2));
  mouse.point({Vector3d(0.2, 0.1, 5), Vector3d(0, 0, -3)});
  for (const double pressure : {0.3, 7.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    mouse.set_pressure(pressure);
    expect_conforming(mouse);
  }
  EXPECT_EQ(mouse.exchange({}, 1'000'000).pressure, 0) << "as it was before what is no number";
}

TEST(Conformance, Rates) {
  Sticks sticks;
  RateDevice device(sticks);
  expect_conforming(device);
}

TEST(Conformance, NetworkInBadWeather) {
  /// The host and the weather go on with every exchange of the program's end.
  class Whole : public Device {
   public:
    DeviceCapabilities capabilities() const override { return program_.capabilities(); }
    DeviceSample exchange(const ForceCommand& command, Tick tick) override {
      for (; now_ <= tick; ++now_) {
        network_.advance(now_);
        (void)host_.tick(now_);
      }
      return program_.exchange(command, tick);
    }

   private:
    ScriptedDevice script_ = to_and_fro();
    SimulatedNetwork network_{{.delay = 20, .jitter = 10, .loss = 0.2, .cut_first = 1000, .cut_last = 2000}};
    DeviceHost host_{script_, network_.end(0), 1};
    NetworkDevice program_{network_.end(1), 2};
    Tick now_ = 0;
  };
  Whole device;
  expect_conforming(device);
}

TEST(Conformance, FaultsOfTheInjectorAreSeenForWhatTheyAre) {
  ScriptedDevice script = to_and_fro();
  FaultInjector late(script, {{DeviceFault::delay, 0, 10000, 7}});
  expect_conforming(late);
}

TEST(Mouse, FollowsThePointerInThePlaneAndTheWheelAcrossIt) {
  MouseDevice mouse;
  mouse.grab(Vector3d(1, 2, 3), Vector3d(0, 0, -4));
  EXPECT_EQ(mouse.exchange({}, 0).pose.position, Vector3d(1, 2, 3));
  mouse.push(0.5);
  EXPECT_EQ(mouse.exchange({}, 1).pose.position, Vector3d(1, 2, 2.5));
  mouse.point({Vector3d(0, 0, 10), Vector3d(0.1, 0.2, -1)});
  EXPECT_LT((mouse.exchange({}, 2).pose.position - Vector3d(0.75, 1.5, 2.5)).norm(), 1e-14);
  mouse.push(-0.5);
  EXPECT_LT((mouse.exchange({}, 3).pose.position - Vector3d(0.7, 1.4, 3)).norm(), 1e-14);
  // Along the plane, and away from it: it stays.
  mouse.point({Vector3d(0, 0, 10), Vector3d(1, 0, 0)});
  mouse.point({Vector3d(0, 0, 10), Vector3d(0, 0, 1)});
  mouse.point({Vector3d(0, 0, -10), Vector3d(0, 0, -1)});
  EXPECT_LT((mouse.exchange({}, 4).pose.position - Vector3d(0.7, 1.4, 3)).norm(), 1e-14);
}

TEST(Rates, AddUpAndShakeByTheForce) {
  class Still : public RateSource {
   public:
    std::optional<RateInput> poll() override { return input; }
    void rumble(double share) override { shaken = share; }
    RateInput input;
    double shaken = -1;
  };
  Still sticks;
  RateOptions options;
  options.exponent = 1;
  RateDevice device(sticks, options);
  sticks.input.axes[1] = 1;
  for (Tick t = 0; t <= 1000; ++t) (void)device.exchange({}, t);
  EXPECT_NEAR(device.exchange({}, 1000).pose.position.y(), 0.3, 1e-12);  // a second at 0.3 m/s
  sticks.input.axes[1] = 0.55;  // half of what is beyond the dead zone of 0.1
  for (Tick t = 1001; t <= 2000; ++t) (void)device.exchange({}, t);
  EXPECT_NEAR(device.exchange({}, 2000).pose.position.y(), 0.45, 1e-12);
  sticks.input.axes[1] = 0.09;
  (void)device.exchange({Vector3d(0, 0, 4), 2002}, 2001);
  EXPECT_EQ(sticks.shaken, 0.5);
  EXPECT_NEAR(device.exchange({}, 3000).pose.position.y(), 0.45, 1e-12);
  sticks.input.axes = {0, 0, 0, 0, 0, 1};
  for (Tick t = 3001; t <= 4000; ++t) (void)device.exchange({}, t);
  EXPECT_NEAR(Eigen::AngleAxisd(device.exchange({}, 4000).pose.orientation).angle(), 1.5, 1e-9);
}

}  // namespace
}  // namespace argil::sculpt
