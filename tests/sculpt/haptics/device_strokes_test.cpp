// Strokes with devices of every kind: the same poses give the same state, the same ticks the same forces for any
// number of threads, and the hand feels what the static solver says.

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstdio>
#include <functional>

#include "sculpt/haptics/mouse_device.h"
#include "sculpt/haptics/network_device.h"
#include "sculpt/haptics/recorded_device.h"
#include "sculpt/haptics/scripted_device.h"
#include "sculpt/haptics/servo.h"
#include "sculpt/haptics/simulated_hand.h"
#include "sculpt/hash.h"
#include "sculpt/stroke.h"
#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

using Eigen::Vector3d;

DevicePose at(const Vector3d& position) {
  return {position, Eigen::Quaterniond::Identity()};
}

const std::vector<std::string> k_block = {"new box 3 3 2 size 0.3 0.3 0.2", "levels 1", "pin where z < 0.01",
                                          "set damping 20", "tool pull radius 0.1 strength 300"};

StrokePose stroke_pose(const DeviceSample& sample) {
  return {sample.pose.position, sample.pose.orientation, sample.pressure};
}

/// Where a hand goes in 400 ms: round in the plane z = 0.25, in the numbers that a mouse gives back exactly.
std::vector<DevicePose> trace() {
  std::vector<DevicePose> poses;
  for (int i = 0; i <= 400; ++i)
    poses.push_back(at(Vector3d(0.15 + 0.05 * std::sin(0.01 * i), 0.15 + 0.03 * (1 - std::cos(0.02 * i)), 0.25)));
  return poses;
}

std::uint64_t hash_of(const std::function<DeviceSample(Tick)>& sample_at) {
  TestSession session(k_block);
  session.run({"tool pull radius 0.15"});
  Stroke stroke(session.session(), stroke_pose(sample_at(0)));
  for (Tick tick = 1; tick <= 400; ++tick) stroke.tick(stroke_pose(sample_at(tick)));
  (void)stroke.finish();
  return session.hash();
}

TEST(DeviceStrokes, OneTraceThroughEveryDeviceGivesOneHash) {
  const std::vector<DevicePose> poses = trace();
  ScriptedDevice script = ScriptedDevice::from_poses(poses);
  DeviceRecorder recorder(script);
  const std::uint64_t scripted = hash_of([&](Tick tick) { return recorder.exchange({}, tick); });

  RecordedDevice recorded(recorder.entries());
  EXPECT_EQ(hash_of([&](Tick tick) { return recorded.exchange({}, tick); }), scripted);

  MouseDevice mouse;
  mouse.grab(poses[0].position, -Vector3d::UnitZ());
  EXPECT_EQ(hash_of([&](Tick tick) {
              const Vector3d above = poses[static_cast<std::size_t>(tick)].position + Vector3d(0, 0, 4);
              mouse.point({above, -Vector3d::UnitZ()});
              return mouse.exchange({}, tick);
            }),
            scripted);

  SimulatedNetwork network({});
  ScriptedDevice far = ScriptedDevice::from_poses(poses);
  DeviceHost host(far, network.end(0), 1);
  NetworkDevice near(network.end(1), 2);
  EXPECT_EQ(hash_of([&](Tick tick) {
              network.advance(tick);
              (void)host.tick(tick);
              return near.exchange({}, tick);
            }),
            scripted);
}

TEST(DeviceStrokes, PressureGoesWithTheTrace) {
  const std::vector<DevicePose> poses = trace();
  const auto pressure_at = [](std::size_t i) { return 0.5 + 0.5 * std::sin(0.02 * static_cast<double>(i)); };
  std::vector<PoseSegment> segments{{poses[0], poses[0], 0, Ease::linear, 1, pressure_at(0), pressure_at(0)}};
  for (std::size_t i = 1; i < poses.size(); ++i)
    segments.push_back({poses[i - 1], poses[i], 1, Ease::linear, 1, pressure_at(i - 1), pressure_at(i)});
  ScriptedDevice script(segments);
  DeviceRecorder recorder(script);
  const std::uint64_t scripted = hash_of([&](Tick tick) { return recorder.exchange({}, tick); });
  ScriptedDevice unpressed = ScriptedDevice::from_poses(poses);
  EXPECT_NE(hash_of([&](Tick tick) { return unpressed.exchange({}, tick); }), scripted);

  RecordedDevice recorded(recorder.entries());
  EXPECT_EQ(hash_of([&](Tick tick) { return recorded.exchange({}, tick); }), scripted);
  MouseDevice mouse;
  mouse.grab(poses[0].position, -Vector3d::UnitZ());
  EXPECT_EQ(hash_of([&](Tick tick) {
              const auto i = static_cast<std::size_t>(tick);
              mouse.point({poses[i].position + Vector3d(0, 0, 4), -Vector3d::UnitZ()});
              mouse.set_pressure(pressure_at(i));
              return mouse.exchange({}, tick);
            }),
            scripted);
  // Between two poses it changes as the way does, and a hand that follows presses as is meant.
  ScriptedDevice slow({{poses[0], poses[400], 100, Ease::smooth, 1, 0.2, 0.6}});
  EXPECT_EQ(slow.sample(0).pressure, 0.2);
  EXPECT_EQ(slow.sample(50).pressure, 0.4);
  EXPECT_NEAR(slow.sample(25).pressure, 0.2 + 0.4 * 0.15625, 1e-15);  // s²(3 − 2s) at a quarter
  EXPECT_EQ(slow.sample(100).pressure, 0.6);
  SimulatedHand hand(slow);
  EXPECT_EQ(hand.exchange({}, 50).pressure, 0.4);
}

/// The hash of what a hand meets in each tick of a minute of strokes with pauses.
std::vector<std::uint64_t> minute_of_ticks(int threads) {
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
  TestSession session({"new box 2 2 1 size 0.3 0.3 0.2", "levels 1", "pin where z < 0.01", "set damping 5",
                       "tool pull radius 0.15 strength 200"});
  std::vector<std::uint64_t> hashes;
  Hash hash;
  const auto add = [&](const Vector3d& v) {
    for (int i = 0; i < 3; ++i) hash.add(v[i]);
  };
  const Vector3d top(0.15, 0.15, 0.2);
  for (int part = 0; part < 12; ++part) {
    const Vector3d side(0.03 * std::sin(part), 0.03 * std::cos(part), 0.04);
    ScriptedDevice intention({{at(top), at(top + side), 2000, Ease::smooth}, {at(top + side), at(top), 3000}});
    SimulatedHand hand(intention);
    ContactChannel channel;
    Servo servo(hand, channel);
    Stroke stroke(session.session(), {top});
    channel.publish(stroke.felt(60));
    for (Tick tick = 1; tick <= 5000; ++tick) {
      const ServoTick served = servo.tick(tick);
      if (stroke.tick(stroke_pose(served.sample))) channel.publish(stroke.felt(tick + 60));
      add(served.sample.pose.position);
      add(served.safety.force);
      hashes.push_back(hash.value());
    }
    (void)stroke.finish();
  }
  hashes.push_back(session.hash());
  return hashes;
}

TEST(DeviceStrokesSlow, AMinuteHasTheSameTicksForAnyThreads) {
  const std::vector<std::uint64_t> one = minute_of_ticks(1);
  EXPECT_EQ(one.size(), 60'001u);
  EXPECT_TRUE(one == minute_of_ticks(2));
}

TEST(DeviceStrokes, TheHandFeelsTheStiffnessOfTheStaticSolver) {
  for (const double strength : {100.0, 300.0}) {
    TestSession session(k_block);
    session.run({"set young_modulus 5e3", "tool pull radius 0.1 strength " + std::to_string(strength)});
    const Vector3d top(0.15, 0.15, 0.2);
    ScriptedDevice intention({{at(top), at(top + Vector3d(0, 0, 0.03)), 600, Ease::smooth},
                              {at(top + Vector3d(0, 0, 0.03)), at(top + Vector3d(0, 0, 0.03)), 2400}});
    SimulatedHand hand(intention);
    ContactChannel channel;
    Servo servo(hand, channel);
    ServoTick served;
    {
      Stroke stroke(session.session(), {top});
      channel.publish(stroke.felt(50));
      for (Tick tick = 1; tick <= 3000; ++tick) {
        served = servo.tick(tick);
        if (stroke.tick(stroke_pose(served.sample))) channel.publish(stroke.felt(tick + 50));
      }
      stroke.cancel();
    }
    const Vector3d held = served.sample.pose.position;
    const double felt = -served.safety.force.z() / (held - top).z();

    // The same hold and pull on the body at rest, by Newton's method without time.
    const Document& document = session.document();
    const auto tool = take_hold(document, document.state().tool, {top}, {});
    fem::BodyState body = *document.state().motion;
    fem::Loads loads = document.loads();
    add_loads(loads, tool->loads({held}, body.positions));
    fem::StepOptions options;
    options.linear_tolerance = 1e-9;
    options.newton_tolerance = 1e-8;
    (void)document.integrator().solve_static(loads, body, options);
    const double still = tool->force({held}, body.positions).z() / (held - top).z();
    std::printf("strength %g N/m: felt %.2f N/m, static %.2f N/m\n", strength, felt, still);
    EXPECT_NEAR(felt, still, 0.1 * still);
    EXPECT_LT(still, 0.95 * strength);  // the body gives way as well
  }
}

}  // namespace
}  // namespace argil::sculpt
