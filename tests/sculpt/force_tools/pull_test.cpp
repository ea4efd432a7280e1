#include "sculpt/force_tools/pull.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "tests/sculpt/force_tools/held_block.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

class Pull : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Spaces, Pull, testing::Values("default", "cubic"));

TEST_P(Pull, HalfThePressureIsHalfTheForce) {
  TestSession session(held_block(GetParam()));
  const Eigen::Matrix3Xd& p = session.document().positions();
  Tool tool;
  tool.radius = 0.09;
  tool.strength = 50;
  const Eigen::Vector3d at(0.15, 0.15, 0.2);
  const PullGrip grip(session.document(), tool, at);
  for (const double pressure : {1.0, 0.5, 0.1, 0.0}) {
    StrokePose pose{at + Eigen::Vector3d(0.02, -0.01, 0.05)};
    pose.pressure = pressure;
    const Eigen::Vector3d expected = pressure * 50 * Eigen::Vector3d(0.02, -0.01, 0.05);
    // Analytic; the solid gets by virtual work what the device gives.
    EXPECT_LT((grip.force(pose, p) - expected).norm(), 1e-12);
    EXPECT_LT((grip.wrench(pose, p).force - expected).norm(), 1e-10);
    EXPECT_LT((grip.felt(pose, p).force + expected).norm(), 1e-12);
    // What the device feels changes with its way by so much: by differences, of which the force is linear.
    for (int axis = 0; axis < 3; ++axis) {
      StrokePose moved = pose;
      moved.position[axis] += 1e-3;
      const Eigen::Vector3d slope = (grip.felt(moved, p).force - grip.felt(pose, p).force) / 1e-3;
      EXPECT_LT((slope - grip.felt(pose, p).derivative.col(axis)).norm(), 1e-9);
    }
  }
}

TEST_P(Pull, ItsForceIsSpreadOverWhatItTouches) {
  TestSession session(held_block(GetParam()));
  const Eigen::Matrix3Xd& p = session.document().positions();
  for (const char* falloff : {"smooth", "linear", "constant"}) {
    Tool tool = tool_of("pull");
    tool.falloff = falloff;
    const Eigen::Vector3d at(0.15, 0.15, 0.2), device = at + Eigen::Vector3d(0.02, 0, 0.05);
    const PullGrip grip(session.document(), tool, at);
    const fem::AnchorSpring spring = grip.spring({device}, p);
    EXPECT_GE(spring.control_points.size(), 4U);
    EXPECT_TRUE(std::is_sorted(spring.control_points.begin(), spring.control_points.end()));
    EXPECT_NEAR(std::accumulate(spring.weights.begin(), spring.weights.end(), 0.0), 1, 1e-14);
    EXPECT_LT(*std::max_element(spring.weights.begin(), spring.weights.end()), 0.5);
    // The forces on the control points add up to the pull, stiffness times the way from where hold was taken.
    Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, p.cols());
    fem::add_spring_forces({spring}, p, forces);
    EXPECT_LT((forces.rowwise().sum() - 50 * (device - at)).norm(), 1e-12);
    EXPECT_LT((grip.force({device}, p) - 50 * (device - at)).norm(), 1e-12);
    // Nothing pulls before the device has moved, and the touched region is about it by symmetry.
    EXPECT_LT(grip.force({at}, p).norm(), 1e-12);
    EXPECT_NEAR(grip.held(p).x(), 0.15, 1e-12);
    EXPECT_NEAR(grip.held(p).y(), 0.15, 1e-12);
  }
}

TEST_P(Pull, TheLargestForceCutsIt) {
  TestSession session(held_block(GetParam()));
  Tool tool;
  tool.strength = 100;
  tool.largest_force = 2;
  const Eigen::Vector3d at(0.15, 0.15, 0.2);
  const PullGrip grip(session.document(), tool, at);
  const Eigen::Vector3d way(0.3, -0.1, 0.5);
  EXPECT_LT((grip.force({at + way}, session.document().positions()) - 2 * way.normalized()).norm(), 1e-12);
  EXPECT_LT((grip.force({at + 0.01 * way}, session.document().positions()) - way).norm(), 1e-12);
}

TEST_P(Pull, ABrushFinerThanTheMeshStillTakesHold) {
  TestSession session(held_block(GetParam()));
  session.run({"tool pull radius 0.001 strength 40"});
  for (const char* line :
       {"stroke from 0.15 0.15 0.2 to 0.15 0.15 0.22 ticks 20", "stroke from 0.13 0.17 0.2 to 0 0 0 ticks 20"}) {
    session.run({line, "undo"});
  }
}

TEST_P(Pull, AwayFromTheSurfaceItTouchesNothing) {
  TestSession session(held_block(GetParam()));
  session.run({"tool pull radius 0.03"});
  for (const char* from : {"0.15 0.15 0.24", "-0.05 0.15 0.1", "0.15 5 0.2"}) {
    const Error error = session.fault_of(std::string("stroke from ") + from + " to 0 0 0 ticks 20");
    EXPECT_EQ(error.code(), ErrorCode::bad_input);
    EXPECT_THAT(error.what(), HasSubstr("touches nothing"));
  }
  EXPECT_THAT(session.fault_of("stroke from 0.15 0.15 0.24 to 0 0 0 ticks 20").what(), HasSubstr("0.04 m away"));
  session.run({"stroke from 0.15 0.15 0.225 to 0.15 0.15 0.25 ticks 20"});
  // The surface is where it is now, not where it was at rest.
  session.run({"pin off where z < 0.01", "gravity 0 0 -10", "step 20", "gravity 0 0 0"});
  EXPECT_THAT(session.fault_of("stroke from 0.15 0.15 0.2 to 0 0 0 ticks 20").what(), HasSubstr("touches nothing"));
}

TEST_P(Pull, ASimulatedHandFeelsTheForceAndReplaysToTheSameState) {
  auto lines = held_block(GetParam());
  lines.insert(lines.end(), {"set damping 10", "tool pull radius 0.1 strength 400"});
  const std::string stroke = "stroke from 0.15 0.15 0.2 to 0.15 0.15 0.3 ticks 300 hold 200";
  TestSession scripted(lines), hand(lines), again(lines);
  scripted.run({stroke});
  hand.run({stroke + " device hand"});
  again.run({stroke + " device hand"});
  EXPECT_EQ(hand.hash(), again.hash());
  TestSession replayed;
  replayed->run_text(hand.folder().text_of("journal.argil"), "journal.argil");
  EXPECT_EQ(replayed.hash(), hand.hash());
  // The spring of 400 N/m draws the hand of 200 N/m back: it gets clearly less far than a device that feels
  // nothing.
  const double stiff = scripted.measure("max_displacement"), soft = hand.measure("max_displacement");
  EXPECT_GT(soft, 0.1 * stiff);
  EXPECT_LT(soft, 0.9 * stiff);
}

TEST_P(Pull, ItsWorkGoesIntoTheSolid) {
  TestSession session(held_block(GetParam()));
  session.run({"set damping 10", "tool pull radius 0.1 strength 100",
               "stroke from 0.15 0.15 0.2 to 0.15 0.15 0.25 ticks 400 hold 600"});
  // At the end it is all but at rest: the reaction balances the spring, which lifts the middle of the top.
  const double lifted = session.measure("displacement_z at 0.15 0.15 0.1999");
  EXPECT_GT(lifted, 0);
  EXPECT_LT(lifted, 0.05);
  EXPECT_LT(session.measure("reaction_z"), 0);
  EXPECT_GT(session.measure("elastic_energy"), 0);
  session.run({"step 300"});
  EXPECT_LT(session.measure("max_displacement"), 0.01 * lifted);
}

}  // namespace
}  // namespace argil::sculpt
