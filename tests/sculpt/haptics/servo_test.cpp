#include "sculpt/haptics/servo.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cstdio>
#include <limits>
#include <string>

#include "sculpt/haptics/fault_injector.h"
#include "sculpt/haptics/scripted_device.h"
#include "sculpt/haptics/simulated_hand.h"

namespace argil::sculpt {
namespace {

using Eigen::Vector3d;

constexpr double k_wall_stiffness = 1000;  // [N/m]

DevicePose at(double z) {
  return {Vector3d(0, 0, z), Eigen::Quaterniond::Identity()};
}

/// The hand comes down on a floor at z = 0, presses 2 cm into it, holds, and lifts again.
ScriptedDevice press() {
  return ScriptedDevice({{at(0.02), at(-0.02), 300, Ease::smooth},
                         {at(-0.02), at(-0.02), 1000},
                         {at(-0.02), at(0.04), 300, Ease::smooth},
                         {at(0.04), at(0.04), 400}});
}
constexpr Tick k_press_ticks = 2000;

enum class Message { planes_ahead, held_force };

/// What a simulation at 60 steps a second, which sees the hand where it last was, publishes.
ContactModel message_of(Message kind, const Vector3d& hand, Tick now) {
  ContactModel model;
  model.valid_until = now + 50;
  const ContactPlane floor{Vector3d::UnitZ(), 0, k_wall_stiffness};
  if (kind == Message::planes_ahead) {
    model.planes[0] = floor;
    model.plane_count = 1;
  } else {
    model.force = Vector3d(0, 0, k_wall_stiffness * std::max(0.0, -hand.z()));
  }
  return model;
}

struct Pressed {
  double most_work = 0;  // largest sum of work on the hand [J]
  double end_work = 0;
  double largest_force = 0;
  double deepest = 0;
};

Pressed press_on_floor(Message kind, const SafetyLimits& limits, const HandOptions& hand_options) {
  ScriptedDevice intention = press();
  SimulatedHand hand(intention, hand_options);
  ContactChannel channel;
  ServoOptions options;
  options.limits = limits;
  Servo servo(hand, channel, options);
  Pressed pressed;
  Vector3d position(0, 0, 0.02);
  for (Tick t = 0; t <= k_press_ticks; ++t) {
    if (t * 60 / 1000 != (t - 1) * 60 / 1000) channel.publish(message_of(kind, position, t));
    const ServoTick tick = servo.tick(t);
    position = tick.sample.pose.position;
    pressed.most_work = std::max(pressed.most_work, hand.work_received());
    pressed.largest_force = std::max(pressed.largest_force, tick.safety.force.norm());
    pressed.deepest = std::min(pressed.deepest, position.z());
  }
  pressed.end_work = hand.work_received();
  return pressed;
}

SafetyLimits wide_limits() {
  SafetyLimits limits;
  limits.max_force = 40;
  limits.max_slew = std::numeric_limits<double>::infinity();
  limits.start_energy = limits.max_energy = std::numeric_limits<double>::infinity();
  return limits;
}

HandOptions light_hand() {
  HandOptions options;
  options.mass = 0.1;
  options.stiffness = 100;
  options.damping = 4;
  options.max_force = 40;
  return options;
}

TEST(Servo, PlanesSentAheadArePassiveWhereAHeldForceMakesEnergy) {
  // DESIGN.md found 0.07 and 580 mJ with another hand; the size of the ratio is what counts.
  const Pressed ahead = press_on_floor(Message::planes_ahead, wide_limits(), light_hand());
  const Pressed held = press_on_floor(Message::held_force, wide_limits(), light_hand());
  RecordProperty("planes_ahead_mJ", std::to_string(1e3 * ahead.most_work));
  RecordProperty("held_force_mJ", std::to_string(1e3 * held.most_work));
  std::printf("work on the hand: planes ahead %.3f mJ, held force %.0f mJ\n", 1e3 * ahead.most_work,
              1e3 * held.most_work);
  EXPECT_LT(ahead.most_work, 0.5e-3);
  EXPECT_GT(held.most_work, 500 * ahead.most_work);
}

TEST(Servo, TheSafetyChainKeepsEvenAHeldForcePassive) {
  const SafetyLimits limits;
  const Pressed held = press_on_floor(Message::held_force, limits, light_hand());
  std::printf("held force through the safety chain: %.3f mJ\n", 1e3 * held.most_work);
  // What may be given out before any is taken in, half of it again for gentleness, and one tick's mistake.
  EXPECT_LE(held.most_work, 1.5 * limits.start_energy + 0.02e-3);
  EXPECT_LE(held.largest_force, limits.max_force);
}

TEST(Servo, APassiveWallIsNotWeakenedByTheSafetyChain) {
  const Pressed safe = press_on_floor(Message::planes_ahead, SafetyLimits{}, light_hand());
  const Pressed wide = press_on_floor(Message::planes_ahead, wide_limits(), light_hand());
  // Springs in series stand at 2 cm · 100 / (100 + 1000); the deepest point passes it by the overshoot of the
  // landing, the same with and without the chain to 1 %.
  EXPECT_LT(safe.deepest, -0.02 * 100 / 1100);
  EXPECT_NEAR(safe.deepest, wide.deepest, 0.01 * 0.02 * 100 / 1100);
}

class ServoFaults : public testing::Test {
 protected:
  // The hand is carried along by 2.5 mm, which the default does not pay for.
  static ServoOptions unbounded_energy() {
    ServoOptions options;
    options.limits.start_energy = options.limits.max_energy = std::numeric_limits<double>::infinity();
    return options;
  }

  void publish(double force, Tick valid_until) {
    ContactModel model;
    model.force = Vector3d(force, 0, 0);
    model.valid_until = valid_until;
    channel_.publish(model);
  }

  ScriptedDevice intention_ = ScriptedDevice::from_poses({DevicePose{}});
  SimulatedHand hand_{intention_};
  ContactChannel channel_;
};

TEST_F(ServoFaults, NoForceWithoutAModelOrAfterItsTime) {
  Servo servo(hand_, channel_, unbounded_energy());
  for (Tick t = 0; t < 10; ++t) EXPECT_EQ(servo.tick(t).safety.force, Vector3d::Zero());
  publish(0.5, 30);
  for (Tick t = 10; t < 60; ++t) {
    const ServoTick tick = servo.tick(t);
    EXPECT_EQ(tick.model_valid, t <= 30);
    // From then on it fades in 100 ticks.
    EXPECT_NEAR(tick.safety.force.x(), t <= 30 ? 0.5 : 0.5 * (1 - static_cast<double>(t - 30) / 100), 1e-15) << t;
  }
  for (Tick t = 60; t < 180; ++t) {
    const Vector3d force = servo.tick(t).safety.force;
    if (t >= 130) {
      EXPECT_EQ(force, Vector3d::Zero()) << t;
    }
  }
  publish(0.5, 1000);
  for (Tick t = 180; t < 1000; ++t)
    EXPECT_NEAR(servo.tick(t).safety.force.x(), 0.5 * std::min(1.0, static_cast<double>(t - 179) / 800), 1e-14);
}

TEST_F(ServoFaults, AStalledSimulationLetsGoWithin150Milliseconds) {
  // Models at 60 a second, each good for 50 ms; the simulation stalls at tick 500 with the hand pressed in.
  ScriptedDevice intention = press();
  SimulatedHand hand(intention, light_hand());
  Servo servo(hand, channel_);
  Vector3d last = Vector3d::Zero();
  double before = 0, largest_step = 0;
  for (Tick t = 0; t < 1000; ++t) {
    if (t <= 500 && t * 60 / 1000 != (t - 1) * 60 / 1000)
      channel_.publish(message_of(Message::planes_ahead, Vector3d::Zero(), t));
    const Vector3d force = servo.tick(t).safety.force;
    if (t == 500) before = force.norm();
    if (t > 500) largest_step = std::max(largest_step, (force - last).norm());
    if (t > 500 && t < 540) {
      EXPECT_NEAR(force.norm(), before, 0.02 * before);
    }
    if (t >= 650) {
      EXPECT_LT(force.norm(), 0.01);
    }
    last = force;
  }
  EXPECT_GT(before, 1);
  EXPECT_LE(largest_step, 0.12);
  std::printf("stalled simulation: %.2f N let go by at most %.4f N/ms\n", before, largest_step);
}

TEST_F(ServoFaults, APoseThatIsNotANumberStopsTheForceForGood) {
  FaultInjector device(hand_, {{DeviceFault::not_a_number, 20, 20}});
  Servo servo(device, channel_, unbounded_energy());
  publish(0.5, 1000);
  for (Tick t = 0; t < 100; ++t) {
    const ServoTick tick = servo.tick(t);
    EXPECT_EQ(tick.safety.force, Vector3d(t >= 1 && t <= 20 ? 0.5 : 0, 0, 0)) << t;
  }
  EXPECT_TRUE(servo.safety().fault());
}

TEST_F(ServoFaults, AModelThatIsNotANumberStopsTheForceForGood) {
  Servo servo(hand_, channel_, unbounded_energy());
  publish(0.5, 1000);
  for (Tick t = 0; t < 10; ++t) (void)servo.tick(t);
  publish(std::numeric_limits<double>::quiet_NaN(), 1000);
  EXPECT_EQ(servo.tick(10).safety.force, Vector3d::Zero());
  publish(0.5, 1000);
  EXPECT_EQ(servo.tick(11).safety.force, Vector3d::Zero());
  EXPECT_EQ(servo.tick(12).sample.mode, DeviceMode::force);  // the device itself never heard of it
}

TEST_F(ServoFaults, AStalledDeviceGetsNoForceAndComesBack) {
  FaultInjector device(hand_, {{DeviceFault::stall, 50, 99}});
  Servo servo(device, channel_, unbounded_energy());
  publish(0.5, 1000);
  for (Tick t = 0; t < 150; ++t) {
    const bool silent = servo.tick(t).safety.force.isZero(0);
    // The pose of tick 49 may be answered until it is 2 ticks old; the one of tick 100 is seen in tick 101.
    EXPECT_EQ(silent, t == 0 || (t > 51 && t <= 100)) << t;
  }
}

TEST_F(ServoFaults, DroppedCommandsExpireInTheDevice) {
  FaultInjector device(hand_, {{DeviceFault::drop, 50, 199}});
  Servo servo(device, channel_, unbounded_energy());
  publish(0.5, 1000);
  for (Tick t = 0; t < 100; ++t)
    // The command of tick 49 lives for 10 ticks more.
    EXPECT_EQ(servo.tick(t).sample.mode, t > 59 ? DeviceMode::idle : DeviceMode::force) << t;
}

TEST_F(ServoFaults, ALateDeviceGetsNoForceThatThePassivityObserverCouldNotCount) {
  // A wall felt 5 ms late pumps, unseen by an observer that is as late; so such poses are refused by default.
  const auto work = [](Tick delay, Tick max_sample_age) {
    ScriptedDevice intention = press();
    SimulatedHand hand(intention, light_hand());
    FaultInjector device(hand, {{DeviceFault::delay, 0, k_press_ticks, delay}});
    ContactChannel channel;
    ServoOptions options;
    options.max_sample_age = max_sample_age;
    Servo servo(device, channel, options);
    ContactModel model;
    model.planes[0] = {Vector3d::UnitZ(), 0, k_wall_stiffness};
    model.plane_count = 1;
    model.valid_until = k_press_ticks;
    channel.publish(model);
    double most = 0;
    for (Tick t = 0; t <= k_press_ticks; ++t) {
      (void)servo.tick(t);
      most = std::max(most, hand.work_received());
    }
    return most;
  };
  std::printf("1 ms late %.2f mJ, 5 ms late but answered %.0f mJ\n", 1e3 * work(1, 2), 1e3 * work(5, 10));
  EXPECT_EQ(work(5, 2), 0);
  EXPECT_GT(work(5, 10), 0.05);
  EXPECT_LT(work(1, 2), 0.01);
}

TEST_F(ServoFaults, MissedTicksAreCounted) {
  Servo servo(hand_, channel_, unbounded_energy());
  for (const Tick t : {5, 6, 7, 10, 11, 20}) (void)servo.tick(t);
  EXPECT_EQ(servo.missed(), 10);
}

TEST_F(ServoFaults, TheMappingLeadsToTheWorldAndBack) {
  ServoOptions options;
  options.world_from_device.scale = 10;
  options.world_from_device.translation = Vector3d(0, 0, -0.5);
  options.world_from_device.force_scale = 0.25;
  Servo servo(hand_, channel_, options);
  ContactModel model;
  model.planes[0] = {Vector3d::UnitZ(), -0.498, 1000};  // the device's origin is 2 mm inside it
  model.plane_count = 1;
  model.valid_until = 1000;
  channel_.publish(model);
  (void)servo.tick(0);
  // 1000 N/m · 2 mm / 4, to the rounding of 0.5 − 0.498.
  EXPECT_LT((servo.tick(1).wanted - Vector3d(0, 0, 0.5)).norm(), 1e-12);
}

}  // namespace
}  // namespace argil::sculpt
