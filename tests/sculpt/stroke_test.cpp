#include "sculpt/stroke.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sessions.h"

namespace argil::sculpt {
namespace {

using testing::HasSubstr;

std::vector<std::string> block(const std::string& dt) {
  return {"new box 3 3 2 size 0.3 0.3 0.2", "levels 1", "pin where z < 0.01", "tool pull radius 0.1 strength 80",
          "step 1 dt " + dt};
}

// A hand that wanders: no line between stations would give its poses.
StrokePose wandering(int tick) {
  StrokePose pose;
  const double t = tick / 100.0;
  pose.position = {0.15 + 0.03 * std::sin(7 * t), 0.15 + 0.02 * std::sin(5 * t),
                   0.18 + 0.04 * t + 0.01 * std::sin(9 * t)};
  pose.orientation = Eigen::AngleAxisd(0.3 * t, Eigen::Vector3d(1, 2, 2).normalized());
  pose.pressure = 0.75 + 0.25 * std::cos(3 * t);
  return pose;
}

std::string run_live(TestSession& session, int ticks, const StrokeOptions& options = {}) {
  Stroke stroke(session.session(), wandering(0), options);
  for (int tick = 1; tick <= ticks; ++tick) stroke.tick(wandering(tick));
  std::string line = stroke.finish();
  session->adopt_line(line);
  return line;
}

class StrokeReplay : public testing::TestWithParam<const char*> {};
// Of steps that are whole ticks, that are not, and that are several in one tick.
INSTANTIATE_TEST_SUITE_P(TimeSteps, StrokeReplay, testing::Values("0.016", "1/60", "0.0137", "0.0004"));

TEST_P(StrokeReplay, LiveStrokesAreTheirLines) {
  const auto lines = block(GetParam());
  TestSession live(lines), replayed(lines);
  const std::string first = run_live(live, 59);
  const std::uint64_t after_first = live.hash();
  EXPECT_GT(live.state().tick_carry, 0) << "the second stroke is to begin between steps";
  const std::string second = run_live(live, 71, {.invert = true});
  EXPECT_THAT(second, HasSubstr(" invert"));
  replayed.run({first});
  EXPECT_EQ(replayed.hash(), after_first);
  replayed.run({second});
  EXPECT_EQ(replayed.hash(), live.hash());
  EXPECT_EQ(replayed->steps().size(), live->steps().size());
  // The journal is the session.
  TestSession from_journal;
  from_journal->run_text(live.folder().text_of("journal.argil"), "journal.argil");
  EXPECT_EQ(from_journal.hash(), live.hash());
  // One change each.
  live.run({"undo"});
  EXPECT_EQ(live.hash(), after_first);
  live.run({"redo"});
  EXPECT_EQ(live.hash(), replayed.hash());
}

TEST(Stroke, ALineNamesOnlyWhatStepsSaw) {
  TestSession session(block("0.02"));
  Stroke stroke(session.session(), {{0.15, 0.15, 0.18}, Eigen::Quaterniond::Identity(), 1});
  int steps = 0;
  for (int tick = 1; tick <= 45; ++tick)
    steps += stroke.tick({{0.15, 0.15, 0.18 + tick / 1024.0}, Eigen::Quaterniond::Identity(), 1});
  EXPECT_EQ(steps, 2);
  EXPECT_EQ(
      stroke.finish(),
      "stroke path 0 0.15 0.15 0.18 20 0.15 0.15 0.19953125 40 0.15 0.15 0.2190625 45 0.15 0.15 0.2239453125");
}

TEST(Stroke, CancelledItNeverWas) {
  TestSession session(block("1/60"));
  const std::uint64_t before = session.hash();
  const std::size_t depth = session->undo_depth(), steps = session->steps().size();
  {
    Stroke stroke(session.session(), wandering(0));
    for (int tick = 1; tick <= 60; ++tick) stroke.tick(wandering(tick));
    EXPECT_NE(session.hash(), before);
    stroke.cancel();
    EXPECT_EQ(session.hash(), before);
  }
  {
    Stroke forgotten(session.session(), wandering(0));
    for (int tick = 1; tick <= 60; ++tick) forgotten.tick(wandering(tick));
  }
  EXPECT_EQ(session.hash(), before);
  EXPECT_EQ(session->undo_depth(), depth);
  EXPECT_EQ(session->steps().size(), steps);
}

TEST(Stroke, WhatTouchesNothingChangesNothing) {
  TestSession session(block("1/60"));
  const std::uint64_t before = session.hash();
  EXPECT_THROW(Stroke(session.session(), {{0.15, 0.15, 0.5}, Eigen::Quaterniond::Identity(), 1}), Error);
  EXPECT_EQ(session.hash(), before);
}

TEST(Stroke, ADeviceThatLosesItselfStays) {
  TestSession lost(block("1/60")), still(block("1/60"));
  Stroke a(lost.session(), wandering(0)), b(still.session(), wandering(0));
  for (int tick = 1; tick <= 100; ++tick) {
    StrokePose pose = wandering(std::min(tick, 50));
    b.tick(pose);
    if (tick > 50) pose.position.y() = std::nan("");
    a.tick(pose);
  }
  EXPECT_EQ(a.finish(), b.finish());
  EXPECT_EQ(lost.hash(), still.hash());
}

TEST(Stroke, PressureMayScaleTheRadiusAndReplays) {
  for (const char* tool : {"inflate", "pinch", "smooth", "pull", "paint_stiffness scale 3", "pin_brush"}) {
    SCOPED_TRACE(tool);
    const auto lines = [&] {
      auto all = block("1/60");
      all.push_back("tool " + std::string(tool) + " radius 0.12 symmetry x");
      return all;
    }();
    const auto draw = [&](TestSession& session, bool radius) {
      StrokeOptions options;
      options.scales_radius = radius;
      Stroke stroke(session.session(), wandering(0), options);
      for (int tick = 1; tick <= 90; ++tick) stroke.tick(wandering(tick));
      return stroke.finish();
    };
    TestSession live(lines), strength(lines), replayed(lines);
    const std::string line = draw(live, true);
    EXPECT_THAT(line, HasSubstr(" scales radius"));
    replayed.run({line});
    EXPECT_EQ(replayed.hash(), live.hash());
    draw(strength, false);
    if (std::string(tool) != "pin_brush") {  // which has no strength, and here pins the same points
      EXPECT_NE(strength.hash(), live.hash());
    }
  }
}

TEST(Stroke, FullPressureIsAsNone) {
  for (const char* tool : {"pull", "inflate", "paint_mass scale 3"}) {
    auto lines = block("1/60");
    lines.push_back("tool " + std::string(tool));
    lines.push_back("stroke path 0 0.15 0.15 0.2 90 0.15 0.17 0.22");
    TestSession none(lines);
    lines.back() += " pressures 1 1";
    TestSession full(lines);
    lines.back() += " scales radius";
    TestSession radius(lines);
    EXPECT_EQ(full.hash(), none.hash());
    EXPECT_EQ(radius.hash(), none.hash());
  }
}

TEST(Stroke, PressuresOutOfRangeAreCut) {
  TestSession session(block("0.02"));
  const Eigen::Quaterniond straight = Eigen::Quaterniond::Identity();
  Stroke stroke(session.session(), {{0.15, 0.15, 0.18}, straight, 1e9});
  for (int tick = 1; tick <= 45; ++tick) stroke.tick({{0.15, 0.15, 0.18}, straight, tick < 30 ? -1 : std::nan("")});
  EXPECT_THAT(stroke.finish(), HasSubstr(" pressures 1 0 0 0"));
}

TEST(Stroke, PathsThatAreNoneAreRefused) {
  TestSession session(block("1/60"));
  const std::uint64_t before = session.hash();
  const auto refused = [&](const std::string& arguments) {
    return std::string(session.fault_of("stroke " + arguments).what());
  };
  EXPECT_THAT(refused("path 1 0.15 0.15 0.18 20 0.15 0.15 0.2"), HasSubstr("begin with 0"));
  EXPECT_THAT(refused("path 0 0.15 0.15 0.18 20 0.15 0.15 0.2 20 0 0 0"), HasSubstr("ascend"));
  EXPECT_THAT(refused("path 0 0.15 0.15 0.18 2.5 0.15 0.15 0.2"), HasSubstr("whole"));
  EXPECT_THAT(refused("path 0 0.15 0.15 0.18 9 0 0 0 turns 1 0 0 0"), HasSubstr("2 stations"));
  EXPECT_THAT(refused("path 0 0.15 0.15 0.18 9 0 0 0 turns 1 0 0 0 1 1 0 0"), HasSubstr("length 1"));
  EXPECT_THAT(refused("path 0 0.15 0.15 0.18 9 0 0 0 pressures 1"), HasSubstr("2 stations"));
  EXPECT_THAT(refused("path 0 0.15 0.15 0.18 9 0 0 0 ticks 5"), HasSubstr("leave out ticks"));
  EXPECT_THAT(refused("from 0.15 0.15 0.18 to 0 0 0"), HasSubstr("ticks is missing"));
  EXPECT_EQ(session.hash(), before);
}

TEST(Stroke, LinesThatCannotRunAreNotAdopted) {
  TestSession session(block("1/60"));
  const std::string before = session.folder().text_of("journal.argil");
  EXPECT_THROW(session->adopt_line("strike path 0 0 0 0"), Error);
  EXPECT_THROW(session->adopt_line("stroke path 0 0 0"), Error);
  EXPECT_EQ(session.folder().text_of("journal.argil"), before);
}

TEST(Stroke, AHandFeelsObstaclesBeforeItTouchesThem) {
  TestSession session({"new box 2 2 2 size 0.2 0.2 0.2", "levels 1", "obstacle floor plane at 0 0 -0.1",
                       "obstacle ball sphere at 0.5 0 0 radius 0.1"});
  ContactModel model;
  model.point = {0.42, 0, -0.05};
  add_obstacle_walls(model, session->document(), 0.1);
  ASSERT_EQ(model.plane_count, 2U);
  // The ball is nearer: its surface is where the line to its middle leaves it.
  const Eigen::Vector3d out = (model.point - Eigen::Vector3d(0.5, 0, 0)).normalized();
  EXPECT_LT((model.planes[0].normal - out).norm(), 1e-12);
  EXPECT_NEAR(model.planes[0].offset, out.dot(Eigen::Vector3d(0.5, 0, 0)) + 0.1, 1e-12);
  EXPECT_NEAR(model.planes[1].offset, -0.1, 1e-12);
  EXPECT_LT((model.planes[1].normal - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  // Above the floor nothing pushes, 1 mm inside 1 N does.
  EXPECT_EQ(contact_force(model, {0.3, 0, -0.09}).norm(), 0);
  EXPECT_NEAR(contact_force(model, {0.3, 0, -0.101}).z(), 1, 1e-9);
  ContactModel far;
  far.point = {0, 0, 5};
  add_obstacle_walls(far, session->document(), 0.1);
  EXPECT_EQ(far.plane_count, 0U);
}

}  // namespace
}  // namespace argil::sculpt
