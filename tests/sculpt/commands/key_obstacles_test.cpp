// Obstacles that keys lead: where they are in a step and how fast, and what they do to bodies.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sculpt/obstacles.h"
#include "tests/sculpt/sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

/// A block of 4 kg at rest on a rough floor.
std::vector<std::string> block(std::vector<std::string> more) {
  std::vector<std::string> lines{"new box 2 2 1 size 0.2 0.2 0.1",
                                 "select edges angle 30",
                                 "sharpen",
                                 "levels 1",
                                 "set young_modulus 1e5",
                                 "obstacle floor plane friction 0.5",
                                 "gravity 0 0 -9.81",
                                 "set stiffness_damping 0.02",
                                 "step 60 dt 1/60"};
  lines.insert(lines.end(), more.begin(), more.end());
  return lines;
}

TEST(KeyedObstacles, WereAtTheBeginningOfAStepWhereTheStepBeforeLeftThem) {
  TestSession test({"new box 1 1 1 size 0.1 0.1 0.1", "levels 1",
                    "obstacle paddle box size 0.2 0.02 0.1 at 0.5 0 0 axis 0 1 0 rotate 20",
                    "key obstacle paddle move 0.3 -0.1 0.2 rotate 400 axis 1 2 3 at 1 interpolation linear",
                    "key obstacle paddle move 0 0.1 0 rotate 100 axis 1 0 0 at 1.5"});
  const NamedObstacle& paddle = *find_obstacle(test.state(), "paddle");
  for (const double begin : {0.0, 0.2, 0.95, 1.3, 1.6}) {
    State state = test.state();
    auto motion = std::make_shared<fem::BodyState>(*state.motion);
    motion->time = begin;
    state.motion = motion;
    const double h = 0.01;
    const fem::Obstacle now = moving_obstacles(state, begin + h).front();
    const fem::Obstacle wanted = standing_obstacle(paddle, begin + h), before = standing_obstacle(paddle, begin);
    const fem::ObstaclePose there = fem::pose_at(now, begin), here = fem::pose_at(now, begin + h);
    EXPECT_LT((here.position - wanted.position).norm(), 1e-12);
    EXPECT_LT((here.rotation - wanted.orientation.toRotationMatrix()).norm(), 1e-12);
    EXPECT_LT((there.position - before.position).norm(), 1e-12) << begin;
    EXPECT_LT((there.rotation - before.orientation.toRotationMatrix()).norm(), 1e-12) << begin;
    // Standing at one time it has the speed that it comes with.
    const fem::Obstacle at_once = moving_obstacles(state, begin).front();
    const double e = 1e-6;
    if (begin == 0) continue;
    const Eigen::Vector3d speed = (before.position - standing_obstacle(paddle, begin - e).position) / e;
    EXPECT_LT((at_once.velocity - speed).norm(), 1e-4) << begin;  // from the left
  }
}

// Friction holds what goes with less than μ g: it follows the floor, and rides on it up and round.
TEST(KeyedObstacles, CarryWhatLiesOnThem) {
  TestSession test(block({"key obstacle floor move 0.4 0 0 at 2.2"}));
  const double x = test.measure("position_x at 0.1 0.1 0.05"), z = test.measure("position_z at 0.1 0.1 0.05");
  test.run({"step 90"});  // the way of 0.4 m in 1.2 s asks for at most 1.7 m/s²; μ g is 4.9
  EXPECT_NEAR(test.measure("position_x at 0.1 0.1 0.05") - x, 0.4, 1e-3);
  EXPECT_NEAR(test.measure("position_z at 0.1 0.1 0.05"), z, 1e-4);
  EXPECT_LT(test.measure("max_speed"), 1e-3);
  test.run({"key obstacle floor move 0.4 0 0.1 at 3.5", "step 90"});
  EXPECT_NEAR(test.measure("position_z at 0.1 0.1 0.05") - z, 0.1, 1e-4);
  // The guard counts the work of obstacles as if they stood where they are at the end of a step: what Newton's
  // tolerance leaves of a weight that is lifted may look like energy from nowhere, which a step in two parts puts
  // right.
  int mended = 0;
  for (const StepRecord& step : test->steps()) {
    EXPECT_LE(step.remedy, fem::GuardRemedy::substeps);
    mended += step.remedy != fem::GuardRemedy::none;
  }
  EXPECT_LE(mended, 6);
}

TEST(KeyedObstacles, TurnWhatLiesOnThem) {
  TestSession test(block({"key obstacle floor rotate 90 about 0.1 0.1 0 at 2", "step 90"}));
  // The corner (0.2, 0.1) has gone a quarter round the middle.
  EXPECT_NEAR(test.measure("position_x at 0.19 0.1 0.05"), 0.1, 2e-3);
  EXPECT_NEAR(test.measure("position_y at 0.19 0.1 0.05"), 0.19, 2e-3);
}

TEST(KeyedObstacles, SlideAwayUnderWhatTheyCannotHold) {
  // 0.5 m in 0.25 s asks for far more than μ g, which is all that the block gets.
  TestSession test(block({"key obstacle floor move 0.5 0 0 at 1.25", "step 15"}));
  const double speed = test.measure("momentum_x") / test.measure("mass");
  EXPECT_GT(speed, 0.2);
  EXPECT_LT(speed, 0.5 * 9.81 * 0.25 + 0.02);
}

TEST(KeyedObstacles, PushABodyThatIsFree) {
  TestSession test({"new box 2 2 2 size 0.1 0.1 0.1", "levels 1", "set stiffness_damping 0.02",
                    "obstacle piston sphere radius 0.1 at -0.1 0.05 0.05",
                    "key obstacle piston path 0 0 0 0 1 0.5 0 0 interpolation linear", "step 60 dt 1/60"});
  // Never slower than the piston, once it has been met; a body that is damped does not bounce far ahead.
  const double speed = test.measure("momentum_x") / test.measure("mass");
  EXPECT_GT(speed, 0.499);
  EXPECT_LT(speed, 1.0);
}

TEST(KeyedObstacles, AreHashedUndoneAndStayWhereTheyAreWithoutKeys) {
  TestSession test(block({}));
  const std::uint64_t before = test.hash();
  test.run({"key obstacle floor move 0 0 0.05 at 2"});
  EXPECT_NE(test.hash(), before);
  test.run({"undo"});
  EXPECT_EQ(test.hash(), before);
  test.run({"redo", "step 30", "key obstacle floor remove"});
  const NamedObstacle& floor = *find_obstacle(test.state(), "floor");
  EXPECT_TRUE(floor.track.empty());
  EXPECT_NEAR(floor.body.position.z(), 0.025, 1e-12);  // half way
  EXPECT_THAT(test.fault_of("key obstacle flor move 0 0 1").what(), HasSubstr("did you mean `floor`"));
  EXPECT_THAT(test.fault_of("key obstacle floor 0 0 1").what(), HasSubstr("an obstacle moves"));
  EXPECT_THAT(test.fault_of("key obstacle").what(), HasSubstr("which obstacle"));
  EXPECT_THAT(test.fault_of("key obstacle floor remove").what(), HasSubstr("has no keys"));
}

}  // namespace
}  // namespace argil::sculpt
